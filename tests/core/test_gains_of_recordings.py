"""An amplitude is a plain factor on what does not peak at 1, such as a recording."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.design.amplitudes import amplitude_text, is_gain, peak_text
from skinsource.design.effects.level import Fade
from skinsource.specs.samples import Samples

RATE_HZ = 1300.0
RECORDED = Samples(values=4.88 * np.hanning(301), sample_rate_hz=RATE_HZ, unit="m/s²")
SCALED = Samples(values=0.9998 * np.hanning(301), sample_rate_hz=RATE_HZ)
QUIET = replace(SCALED, values=0.25 * SCALED.values)


def design_of(*clips, scaling="probe", **changes):
    track = ss.Input(location=7, clips=clips, **changes)
    return ss.Design(limb="synthetic-1", inputs=(track,), scaling=scaling)


def clip(samples, **changes):
    return ss.Clip(waveform=ss.waveforms.Recording(samples), **changes)


@pytest.mark.parametrize(
    ("clips", "expected"),
    [
        ((clip(QUIET),), True),
        ((clip(replace(SCALED, unit="m/s²")),), True),
        ((ss.Clip(waveform=ss.waveforms.Layers((clip(RECORDED),))),), True),
        ((ss.Clip(), clip(RECORDED)), True),
        ((ss.Clip(), clip(RECORDED, muted=True)), False),
        ((clip(RECORDED, muted=True),), True),
        ((ss.Clip(), clip(SCALED, onset_s=1.0)), False),
        ((ss.Clip(gain=0.5),), True),
    ],
)
def test_it_is_one_where_something_that_sounds_has_its_own_size(clips, expected):
    for scaling in ("probe", "relative"):
        design = design_of(*clips, scaling=scaling)
        assert is_gain(design, design.inputs[0]) is expected
    # There an amplitude is the peak on the skin, whatever is played.
    skin = design_of(*clips, scaling="upstream")
    assert amplitude_text(skin, skin.inputs[0]) == "1 m/s²"


@pytest.mark.parametrize(
    ("clips", "changes", "expected"),
    [
        ((clip(RECORDED),), {}, 4.88),
        ((clip(RECORDED, gain=0.5),), {"amplitude": -3.0}, 7.32),
        ((clip(RECORDED), clip(RECORDED)), {}, 9.76),
        ((clip(RECORDED, effects=(Fade(in_s=0.2, out_s=0.0),)),), {}, None),
        ((clip(RECORDED),), {"gain_curve": ((0.0, 0.1), (1.0, 0.1))}, 0.488),
    ],
)
def test_the_peak_is_the_largest_number_of_what_is_exported(clips, changes, expected):
    design = design_of(*clips, **changes)
    (drive,) = ss.stimulus_of(design).samples
    peak = np.abs(drive).max()
    if expected is not None:
        assert peak == pytest.approx(expected)
    assert peak_text(design, design.inputs[0]) == f"{peak:.3g} m/s²"


def test_the_peak_of_a_tone_is_no_smaller_for_the_instants_of_its_samples():
    tone = ss.waveforms.Tone(frequency_hz=325.0, phase_rad=np.pi / 4, duration_s=0.6)
    design = design_of(ss.Clip(waveform=tone), amplitude=0.8436)
    assert amplitude_text(design, design.inputs[0]) == "0.8436 m/s²"
    quieter = design_of(ss.Clip(waveform=tone, gain=0.5))
    assert amplitude_text(quieter, quieter.inputs[0]) == "gain 1, peak 0.5 m/s²"


def test_it_is_said_in_the_unit_of_the_drive():
    coil = ss.ActuatorAt(model=ss.actuators.load("example-voice-coil"))
    design = replace(design_of(clip(RECORDED)), actuation=ss.Actuation(actuators=(coil,)))
    assert amplitude_text(design, design.inputs[0]) == "gain 1, peak 4.88 V"
