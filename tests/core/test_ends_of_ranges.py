"""Ends that belong to what they end: that of what a sweep moves."""

import pytest

from skinsource.design.motions import Sweep
from skinsource.design.waveforms.tones import Tone


def test_the_last_part_of_a_sweep_ends_with_what_moves():
    sweep = Sweep(path=(16, 18, 20), waveform=Tone(200.0, duration_s=0.6))
    [last] = sweep.tracks()[-1].clips
    trim = last.effects[0]
    assert trim.start_s + trim.duration_s == pytest.approx(0.6, abs=1e-15)
    [first] = sweep.tracks()[0].clips
    assert first.effects[0].start_s == 0.0
