"""By what the effects of a clip divide its frequencies."""

import numpy as np
import pytest

from skinsource.design.clips import Clip
from skinsource.design.effects.time import Reverse, Stretch, Trim, stretched_by
from skinsource.design.waveforms.tones import Tone

TONE = Tone(frequency_hz=100.0, duration_s=0.5)


@pytest.mark.parametrize(
    ("effects", "factor"),
    [
        ((), 1.0),
        ((Stretch(factor=2.0),), 2.0),
        ((Stretch(factor=2.0, on=False),), 1.0),
        ((Stretch(factor=2.0, pitch="stays"),), 1.0),
        ((Stretch(to_s=2.0),), 4.0),
        ((Trim(duration_s=0.25), Stretch(to_s=0.5)), 2.0),
        ((Stretch(factor=4.0), Reverse(), Stretch(factor=0.5)), 2.0),
    ],
)
def test_the_frequency_that_sounds_is_that_of_the_waveform_over_the_factor(effects, factor):
    assert stretched_by(effects, TONE.duration_s) == pytest.approx(factor)
    _, samples = Clip(waveform=TONE, effects=effects).sampled(1300.0)
    spectrum = np.abs(np.fft.rfft(samples, 2**16))
    sounds_hz = np.argmax(spectrum) * 1300.0 / 2**16
    assert sounds_hz == pytest.approx(100.0 / factor, rel=0.02)
