"""What `help` and the prompt show of the library."""

import dataclasses
import doctest
import inspect

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from tests.core.frozen.read_frozen import public

PUBLIC = public()
EVERYWHERE = {name: value for name, value in PUBLIC.items() if inspect.isroutine(value)}
MODELS = {name: value for name, value in PUBLIC.items() if dataclasses.is_dataclass(value)}
CALLED = EVERYWHERE | {name: value for name, value in MODELS.items() if inspect.isclass(value)}
#: They need files of a lab, or its devices.
NEED_A_LAB = ("measuring.open_response", "recordings.taken", "rig_measuring")
WITH_EXAMPLES = [name for name in EVERYWHERE if not name.startswith(NEED_A_LAB)]


@pytest.mark.parametrize("name", CALLED)
def test_signatures_are_short_and_name_types(name):
    signature = str(inspect.signature(CALLED[name]))
    assert len(signature) <= 400
    assert "numpy." not in signature


@pytest.mark.parametrize("name", WITH_EXAMPLES)
def test_each_function_has_an_example_that_draws_or_prints(name):
    examples = doctest.DocTestParser().get_examples(inspect.getdoc(EVERYWHERE[name]) or "")
    assert any(example.want or "figure = " in example.source for example in examples)


def test_only_what_is_public_is_listed():
    assert dir(ss) == sorted(ss.__all__)


def test_a_map_of_a_limb_is_one_line_and_its_places_are_in_millimetres(limb):
    assert repr(limb.map) == "<LimbMap: 72 outputs, 20 inputs, outline of 720 points>"
    mm_per_px = limb.hand_length_mm / limb.map.hand_length_px
    np.testing.assert_array_equal(limb.output_positions_mm, limb.map.output_positions * mm_per_px)
    np.testing.assert_array_equal(limb.input_positions_mm, limb.map.input_positions * mm_per_px)


def test_windows_have_the_names_that_scipy_has_too():
    np.testing.assert_array_equal(ss.window("boxcar", 5), ss.window("none", 5))
    np.testing.assert_array_equal(ss.window("hann", 5), ss.window("hanning", 5))
    burst = ss.sinusoid(100.0, window_name="hann")
    np.testing.assert_array_equal(burst, ss.sinusoid(100.0, window_name="hanning"))
    assert ss.waveforms.Tone(window="hann") == ss.waveforms.Tone(window="hanning")
    with pytest.raises(InvalidInputError, match="choose from none, tukey, hanning"):
        ss.window("kaiser", 5)
