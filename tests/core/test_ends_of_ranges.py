"""Ends that belong to what they end: of the measured band, and of what a sweep moves."""

import numpy as np
import pytest

from skinsource.design.motions import Sweep
from skinsource.design.waveforms.tones import Tone
from skinsource.signals.drawing import bounded_to_band


@pytest.mark.parametrize(("frequency_hz", "stays"), [(20, 0), (25, 1), (600, 1), (605, 0)])
def test_both_ends_of_the_band_stay(frequency_hz, stays):
    samples = np.sin(2.0 * np.pi * frequency_hz * np.arange(1300) / 1300.0)
    bounded = bounded_to_band(samples, 1300.0)
    assert bounded.removed == pytest.approx(1 - stays, abs=1e-12)
    np.testing.assert_allclose(bounded.samples, stays * samples, atol=1e-10)


def test_the_last_part_of_a_sweep_ends_with_what_moves():
    sweep = Sweep(path=(16, 18, 20), waveform=Tone(200.0, duration_s=0.6))
    [last] = sweep.tracks()[-1].clips
    trim = last.effects[0]
    assert trim.start_s + trim.duration_s == pytest.approx(0.6, abs=1e-15)
    [first] = sweep.tracks()[0].clips
    assert first.effects[0].start_s == 0.0
