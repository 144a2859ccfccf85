import pytest
from hypothesis import given
from hypothesis import strategies as st

from skinsource.base.errors import InvalidInputError
from skinsource.lab.playing.devices import Output, output_from_text


def test_a_place_without_an_output_of_its_own_takes_the_next_free_one():
    output = Output(outputs=((7, 2),))
    assert output.outputs_of([3, 7, 18]) == {3: 1, 7: 2, 18: 3}
    assert output.outputs_of([7]) == {7: 2}
    assert Output().outputs_of([12, 5, 12]) == {12: 1, 5: 2}


def test_an_output_that_another_place_is_wired_to_is_not_free():
    assert Output(outputs=((9, 1),)).outputs_of([3]) == {3: 2}


@given(
    st.lists(st.integers(1, 72), unique=True, max_size=20),
    st.lists(st.tuples(st.integers(1, 72), st.integers(1, 30)), max_size=20),
)
def test_no_two_places_share_an_output(places, pairs):
    outputs = tuple({place: (place, output) for place, output in pairs}.values())
    outputs = tuple({output: (place, output) for place, output in outputs}.values())
    numbers = Output(outputs=outputs).outputs_of(places)
    assert set(numbers) == set(places)
    assert len(set(numbers.values())) == len(numbers)


def test_what_is_written_down_is_read_again():
    output = Output(
        device="USB: 8 × out",
        host_api="ALSA",
        sample_rate_hz=96_000,
        latency_s=0.01,
        outputs=((7, 3), (2, 1)),
        stand_in=True,
        shift_hz=250.0,
    )
    assert output_from_text(output.to_text()) == output
    assert output_from_text(Output().to_text()) == Output()


@pytest.mark.parametrize(
    "text",
    ["", "[]", "7", '{"device": 7}', '{"sample_rate_hz": 0}', '{"other": 1}', "[" * 9999,
     '{"outputs": [[1, 2, 3]]}', '{"outputs": [[1, 0]]}', '{"outputs": 5}', '{"latency_s": "x"}',
     '{"stand_in": "no"}', '{"latency_s": NaN}', '{"outputs": [[1, 2], [3, 2]]}'],
)  # fmt: skip
def test_anything_else_is_refused(text):
    with pytest.raises(InvalidInputError):
        output_from_text(text)
