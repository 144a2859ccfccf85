"""Bounds of samples: nothing exceeds them."""

import numpy as np
import pytest

from skinsource.base.conventions import N_TAPS
from skinsource.engine.gains import channel_bounds
from skinsource.engine.spectra import ResponseSpectrum
from skinsource.engine.transforms import forward, transform_length
from skinsource.signals.generators import sinusoid, white_noise

DRIVES = {
    "low tone": sinusoid(30.0, duration_s=0.5),
    "high tone": sinusoid(590.0, duration_s=0.5),
    "long tone": sinusoid(100.0, duration_s=1.5),
    "short tone": sinusoid(250.0, duration_s=0.02),
    "noise": white_noise(0.4, 3),
    "short noise": white_noise(0.03, 4),
    "steady": np.ones(700),
    "one sample": np.ones(1),
    "pulse": -np.eye(1, 300, 120)[0],
    "last sample": -np.eye(1, 300, 299)[0],
}


@pytest.mark.parametrize("drive", DRIVES)
@pytest.mark.parametrize("seed", range(3))
def test_no_sample_of_random_responses_exceeds_its_bound(drive, seed):
    samples, random = DRIVES[drive], np.random.default_rng(seed)
    taps = random.standard_normal((72, 3, N_TAPS)) * 0.5 ** (np.arange(N_TAPS) / 40)
    n_fft = transform_length(samples.size + N_TAPS - 1)
    response = ResponseSpectrum(taps, n_fft, forward(taps, n_fft))
    [bounds] = channel_bounds(samples[None], forward(samples[None], n_fft), [response])
    for bound, row in zip(bounds, taps.reshape(-1, N_TAPS), strict=True):
        assert bound >= np.abs(np.convolve(samples, row)).max()
