"""Names and lists where limbs and tuples are expected, and lists of names that exist."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError

DESIGN = ss.Design(limb="synthetic-1", inputs=(ss.track(7),))
LIMB = ss.load_limb("synthetic-1")


def test_lists_are_stored_as_tuples():
    curve = [[0.0, 1.0], [0.1, 0.5]]
    listed = ss.Design(
        limb="synthetic-1", inputs=[ss.Input(location=7, clips=[ss.Clip()], gain_curve=curve)]
    )
    plain = ss.Input(location=7, clips=(ss.Clip(),), gain_curve=tuple(map(tuple, curve)))
    assert listed == ss.Design(limb="synthetic-1", inputs=(plain,))
    assert hash(listed) == hash(ss.Design(limb="synthetic-1", inputs=(plain,)))
    assert ss.View(outputs=[19, 21], time_range_s=[0.0, 0.1]).outputs == (19, 21)
    endless: list = []
    endless.append(endless)
    with pytest.raises(InvalidInputError, match=r"Design\.inputs is .* expected a tuple"):
        ss.Design(limb="synthetic-1", inputs=endless)


@pytest.mark.parametrize(
    "result",
    [
        lambda limb: ss.predict(limb, [[1.0, 2.0]], [7]),
        lambda limb: ss.extent(np.arange(72.0), limb, 7).d90_mm,
        lambda limb: ss.surface_operator(limb, 4.0).interpolate(np.arange(72.0)),
        lambda limb: ss.stimulus_of(DESIGN, limb=limb).samples,
    ],
)
def test_the_name_of_a_limb_stands_for_it(result):
    np.testing.assert_array_equal(result("synthetic-1"), result(LIMB))
    with pytest.raises(InvalidInputError, match="'synthetic-9' is not available here"):
        result("synthetic-9")
    with pytest.raises(InvalidInputError, match=r"limb is 3\.5, expected a Limb or the name"):
        result(3.5)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("frequency", "'frequency'; perhaps 'frequency_hz' is meant; a sweep can vary limb, "),
        ("1.durations", "'1.durations'; perhaps '1.duration_s' is meant"),
        ("1.limb", "nothing in the design has '1.limb'"),
        ("2.frequency_hz", "names input '2', expected 1 to 1"),
    ],
)
def test_a_sweep_refuses_unknown_variables_before_it_begins(tmp_path, name, message):
    with pytest.raises(InvalidInputError, match=message):
        ss.sweep(DESIGN, {"amplitude": [1.0], name: [50, 100]}, out=tmp_path / "sweep")
    assert not (tmp_path / "sweep").exists()


def test_a_variable_of_one_design_among_several_can_be_varied():
    tap = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Tap()),))
    table = ss.sweep([DESIGN, tap], {"frequency_hz": [50.0]})
    assert list(table.failed) == [2]
