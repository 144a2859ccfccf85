"""The gain by which a snapshot matches another one is the skin's, not that of any drive."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource import Design, View, track
from skinsource.design.waveforms import Tap, Tone
from skinsource.engine.quantities import new_graph, sources

GAIN = 0.3
DESIGN = Design(
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Tone(frequency_hz=100.0)),
        track(location=18, waveform=Tap(), onset_s=0.1, amplitude=-2.0),
    ),
)
VIEW = View(outputs=(29, 52))
SCALED = ("output_rms", "selected_traces", "axis_spectra", "axis_traces")
NOT_SCALED = ("input_waveforms", "place_drives", "contact_weighted_rms", "validity")


def values_of(names, gain=1.0, view=VIEW, graph=None):
    graph = graph or new_graph()
    return graph.evaluate(names, sources(DESIGN, view, match_gain=gain))


def flat(value):
    """All numbers in nested tuples of arrays, one after another."""
    if isinstance(value, tuple):
        return np.concatenate([flat(part) for part in value])
    return np.ravel(np.asarray(value, float))


@pytest.mark.parametrize("selected", [(), (1,), (2,)])
def test_all_that_the_skin_does_has_the_gain(selected):
    view = replace(VIEW, selected_inputs=selected)
    as_stored, scaled = values_of(SCALED, view=view), values_of(SCALED, GAIN, view=view)
    for name in SCALED:
        expected = GAIN * as_stored[name]
        least = 1e-13 * np.abs(expected).max()
        np.testing.assert_allclose(scaled[name], expected, rtol=1e-12, atol=least)


def test_no_drive_has_it_and_nothing_that_is_judged_by_drives():
    as_stored, scaled = values_of(NOT_SCALED), values_of(NOT_SCALED, GAIN)
    for name in NOT_SCALED[:-1]:
        np.testing.assert_array_equal(flat(scaled[name]), flat(as_stored[name]))
    assert scaled["validity"] == as_stored["validity"]


def test_what_is_too_long_to_be_transformed_at_once_has_it_too():
    late = replace(DESIGN.inputs[1], clips=(replace(DESIGN.inputs[1].clips[0], onset_s=60.0),))
    design = replace(DESIGN, inputs=(DESIGN.inputs[0], late))
    names = ("streamed", "output_rms", "selected_traces")
    stored, scaled = (
        new_graph().evaluate(names, sources(design, VIEW, match_gain=gain)) for gain in (1.0, GAIN)
    )
    assert stored["streamed"]
    for name in names[1:]:
        least = 1e-12 * np.abs(stored[name]).max()
        np.testing.assert_allclose(scaled[name], GAIN * stored[name], rtol=1e-9, atol=least)
