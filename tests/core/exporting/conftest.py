"""Designs that are exported, and what the engine predicts with."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.engine import stimulus


def silence_after(end_s: float) -> ss.Clip:
    """A clip that makes a track last until ``end_s`` and plays nothing."""
    tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.01)
    return ss.Clip(waveform=tone, onset_s=end_s - 0.01, gain=0.0)


@pytest.fixture
def design():
    """Two places, three tracks; silent for the first and for the last 50 ms and more."""
    noise = ss.Clip(waveform=ss.waveforms.Noise(seed=4, duration_s=0.1), onset_s=0.0712)
    tap = ss.Clip(waveform=ss.waveforms.Tap(), onset_s=0.1203, gain=-0.7)
    tone = ss.waveforms.Tone(frequency_hz=250.0, duration_s=0.1, window="none")
    return ss.Design(
        limb="synthetic-1",
        title="Two places",
        inputs=(
            ss.Input(location=7, amplitude=0.5, clips=(tap, silence_after(0.25))),
            ss.Input(location=12, amplitude=-1.7, clips=(noise,)),
            ss.track(7, tone, onset_s=0.0655, amplitude=0.2),
            ss.track(3, muted=True),
        ),
    )


@pytest.fixture
def path(tmp_path):
    """A name for what is exported."""
    return tmp_path / "a.wav"


@pytest.fixture
def many():
    """Sixteen places."""
    tones = [ss.waveforms.Tone(frequency_hz=40.0 + 20.0 * k, duration_s=0.02) for k in range(16)]
    return ss.Design(
        limb="synthetic-1", inputs=tuple(ss.track(k + 1, tone) for k, tone in enumerate(tones))
    )


@pytest.fixture
def expected():
    """Give the samples that a file holds by default, (n_times, n_channels)."""

    def samples_of(design: ss.Design, rate_hz: int | None = None) -> np.ndarray:
        whole = stimulus.stimulus_of(design, rate_hz)
        return (whole.samples / np.abs(whole.samples).max()).T

    return samples_of
