"""Parts of waveforms: what was cut fits together again, wherever the cuts and the samples lie."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from skinsource.design.clips import Clip
from skinsource.design.effects.playing import played, played_s
from skinsource.design.effects.time import Trim
from skinsource.design.waveforms.pulses import Impulse, Noise, Tap
from skinsource.design.waveforms.tones import Tone
from tests.core.clips_bench import total

RATE_HZ = 1300.0
TONE = Tone(frequency_hz=77.0, duration_s=0.1, window="none")
WAVEFORMS = [TONE, Noise(seed=2, duration_s=0.0996), Tap(), Impulse()]


def cut(clip: Clip, *times_s: float) -> list[Clip]:
    """Parts of a clip, cut at times of its own."""
    ends = [0.0, *times_s, clip.duration_s]
    return [
        replace(
            clip,
            onset_s=clip.onset_s + start,
            effects=(*clip.effects, Trim(start_s=start, duration_s=end - start)),
        )
        for start, end in pairwise(ends)
    ]


@pytest.mark.parametrize("waveform", WAVEFORMS)
@pytest.mark.parametrize("onset_s", [0.0, 0.1, 13 / 1300])
def test_on_samples_every_bit_is_as_it_was(waveform, onset_s):
    whole = Clip(waveform=waveform, onset_s=onset_s)
    parts = cut(whole, *(k / RATE_HZ for k in (1, 7, 20) if k / RATE_HZ < whole.duration_s))
    np.testing.assert_array_equal(total(*parts), total(whole))


@pytest.mark.parametrize("start_s", [0.0, 0.0123, 0.05, 0.0999, 0.3])
@pytest.mark.parametrize("duration_s", [0.0, 0.0004, 0.0307, 600.0])
@pytest.mark.parametrize("shift", [0.0, 0.3])
def test_a_part_shows_the_waveform_at_its_own_instants(start_s, duration_s, shift):
    trim = Trim(start_s=start_s, duration_s=duration_s)
    samples = played(TONE, (trim,), RATE_HZ, shift / RATE_HZ)
    own_s = (np.arange(samples.size) - shift) / RATE_HZ
    inside = (own_s >= -1e-12) & (own_s < trim.length(0.1) - 1e-12)
    expected = np.where(inside, np.sin(2 * np.pi * 77.0 * (own_s + start_s)), 0.0)
    np.testing.assert_allclose(samples, expected, rtol=0, atol=1e-9)
    # Nothing is missing at the end.
    last_s = played_s(TONE, (trim,))
    assert (samples.size + 1e-6 - shift) / RATE_HZ >= last_s or samples.size == 0


def test_a_trim_of_everything_changes_nothing():
    whole = TONE.samples(RATE_HZ, 0.0002)
    for part in (Trim(), Trim(duration_s=0.1)):
        np.testing.assert_array_equal(part.applied(whole, RATE_HZ, 0.0002, 0.1), whole)
    assert Trim().length(0.1) == 0.1
    assert Trim(start_s=0.2).length(0.1) == 0.0
