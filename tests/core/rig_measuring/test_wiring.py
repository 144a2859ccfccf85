"""A check of the wiring says what is not as the rig says."""

import json
from types import SimpleNamespace

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.base.errors import InvalidInputError
from skinsource.lab.rig_measuring import Loopback, save_wiring_check, wiring_check

PLACES = {1: 7, 2: 8, 3: 9}
RIG = Rig(
    title="Bench",
    channels=tuple(RigChannel(place=place, output=output) for output, place in PLACES.items()),
)


@pytest.fixture
def check():
    return wiring_check(RIG)


def came(*later_s):
    return Loopback(round_trips_s=np.array(later_s), behind_s=None)


def test_nothing_is_said_of_what_is_right_or_not_checked(check):
    assert check.sentences == ()
    for output, place in PLACES.items():
        check = check.felt(output, place).looped(output, came(0.02, 0.02 + 1e-5 * output))
    assert check.sentences == ()
    assert check.corrected(RIG) == RIG


def test_places_that_are_swapped_are_said_and_put_right(check):
    check = check.felt(1, 8).felt(2, 7)
    assert check.sentences == (
        "Output 1 moves place 8, and the rig says place 7.",
        "Output 2 moves place 7, and the rig says place 8.",
    )
    corrected = check.corrected(RIG)
    assert [(each.output, each.place) for each in corrected.channels] == [(1, 8), (2, 7), (3, 9)]
    with pytest.raises(InvalidInputError):
        check.felt(1, 9).corrected(RIG)


@pytest.mark.parametrize("polarity", ["normal", "inverted"])
def test_a_sensor_tells_polarity_and_gain(polarity):
    rig = Rig(channels=(RigChannel(place=7, output=1, polarity=polarity),))
    response = MeasuredResponse(((20.0, 50.0, 0.0), (1000.0, 50.0, 0.0)))
    check = wiring_check(rig)
    agreeing = check.measured(1, SimpleNamespace(response=response, inverted=False))
    assert agreeing.channels[0].gain == pytest.approx(50.0)
    assert agreeing.corrected(rig) == rig
    opposite = check.measured(1, SimpleNamespace(response=response, inverted=True))
    assert opposite.sentences == ("Output 1 (place 7) moves against its polarity.",)
    assert opposite.corrected(rig).channels[0].polarity != polarity


def test_a_channel_that_is_not_within_a_tenth_of_a_millisecond_has_a_sentence(check):
    check = check.looped(1, came(0.02)).looped(2, came(0.02)).looped(3, came(0.0205, 0.0205))
    assert check.sentences == (
        "Output 3 is 0.50 ms later than the others, and focusing needs 0.1 ms: set Delay in the "
        "rig.",
    )
    assert check.channels[2].jitter_s == 0.0


def test_a_reference_is_what_delays_are_told_against(check):
    found = Loopback(round_trips_s=np.array([0.02]), behind_s=None, later_s=np.array([2e-4]))
    channel = check.looped(2, found, against=1).channels[1]
    assert (channel.delay_s, channel.against) == (2e-4, 1)
    assert "after output 1" in channel.cells[5]


@pytest.mark.parametrize("later_s", [(0.0, 1.5e-4), (0.0, 0.0, 1.8e-4), (-9e-5, 0.0, 9e-5)])
def test_what_has_no_sentence_is_within_a_tenth_of_a_millisecond_of_each_other(check, later_s):
    for output, delay_s in enumerate(later_s, start=1):
        check = check.looped(output, came(0.02 + delay_s))
    (said,) = check.sentences
    kept = [delay_s for output, delay_s in enumerate(later_s, 1) if f"Output {output}" not in said]
    assert max(kept) - min(kept) <= 1e-4


def test_delays_against_a_reference_are_not_compared_with_round_trips(check):
    check = check.looped(1, came(0.02))
    for output, later_s in ((2, 0.0), (3, 3e-4)):
        found = Loopback(round_trips_s=np.array([0.5]), behind_s=None, later_s=np.array([later_s]))
        check = check.looped(output, found, against=1)
    (said,) = check.sentences
    assert said.startswith("Output 3 is 0.30 ms later than the others")


def test_jitter_beyond_a_tenth_of_a_millisecond_has_a_sentence(check):
    (said,) = check.looped(2, came(0.02, 0.0205)).sentences
    assert said.startswith("Output 2 varies by 0.25 ms")


def test_once_the_rig_is_corrected_what_changed_is_open_and_the_rest_is_kept(check):
    response = MeasuredResponse(((20.0, 50.0, 0.0), (1000.0, 50.0, 0.0)))
    check = check.felt(1, 8).felt(2, 7).felt(3, 9).looped(3, came(0.02))
    check = check.measured(3, SimpleNamespace(response=response, inverted=True))
    assert check.wrong
    again = check.opened(check.corrected(RIG))
    assert [each.place for each in again.channels] == [8, 7, 9]
    assert [each.reported_place for each in again.channels] == [None, None, 9]
    third = again.channels[2]
    assert (third.inverted, third.gain, third.delay_s) == (None, pytest.approx(50.0), 0.02)
    assert not again.wrong


def test_a_check_is_written_for_programs_and_for_the_wall(check, tmp_path):
    check = check.felt(1, 8)
    save_wiring_check(check, tmp_path / "wiring.json")
    written = json.loads((tmp_path / "wiring.json").read_text())
    assert written["channels"][0]["reported_place"] == 8
    assert written["sentences"] == list(check.sentences)
    save_wiring_check(check, tmp_path / "wiring.svg")
    page = (tmp_path / "wiring.svg").read_text()
    assert "moves place 8" in page
    assert "not checked" in page
    with pytest.raises(InvalidInputError, match="not the name of a page"):
        save_wiring_check(check, tmp_path / "wiring.doc")


def test_a_rig_without_channels_and_an_unwired_output_are_refused(check):
    with pytest.raises(InvalidInputError, match="no channel"):
        wiring_check(Rig())
    with pytest.raises(InvalidInputError, match="one that the rig wires"):
        check.felt(9, 7)
    assert ss.rig_measuring.WiringCheck is type(check)
