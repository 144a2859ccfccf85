"""Bounds of samples: nothing exceeds them, and where they are met nothing is left to lose."""

import numpy as np
import pytest

from skinsource.base.conventions import N_TAPS
from skinsource.engine.gains import channel_bounds
from skinsource.engine.spectra import SECTIONS, ResponseSpectrum
from skinsource.engine.transforms import forward, transform_length
from skinsource.signals.generators import sinusoid, white_noise

RATE_HZ = 1300.0
EDGES = (*SECTIONS, N_TAPS)


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


def response_of(taps: np.ndarray, n_times: int) -> ResponseSpectrum:
    n_fft = transform_length(n_times + N_TAPS - 1)
    return ResponseSpectrum(taps, n_fft, forward(taps, n_fft))


def bounds_of(samples: np.ndarray, taps: np.ndarray) -> np.ndarray:
    """What bounds each channel of one drive, (216,)."""
    response = response_of(taps, samples.size)
    return channel_bounds(samples[None], forward(samples[None], response.n_fft), [response])[0]


def largest_of(samples: np.ndarray, taps: np.ndarray) -> np.ndarray:
    """Largest magnitude of each channel, (216,), by plain convolution."""
    rows = taps.reshape(-1, taps.shape[-1])
    return np.array([np.abs(np.convolve(samples, row)).max() for row in rows])


@pytest.mark.parametrize("drive", DRIVES)
@pytest.mark.parametrize("seed", range(3))
def test_no_sample_of_random_responses_exceeds_its_bound(drive, seed):
    random = np.random.default_rng(seed)
    taps = random.standard_normal((72, 3, N_TAPS)) * 0.5 ** (np.arange(N_TAPS) / 40)
    assert (bounds_of(DRIVES[drive], taps) >= largest_of(DRIVES[drive], taps)).all()


@pytest.mark.parametrize("section", range(len(SECTIONS)))
@pytest.mark.parametrize("before", [0, 1, 77])
def test_a_drive_that_matches_a_section_of_a_response_reaches_its_bound(section, before):
    """Cauchy and Schwarz: equal where the drive is the response, reversed."""
    begin, end = EDGES[section], EDGES[section + 1]
    # Few values differ much in size, none is near zero: each sample of the window counts.
    piece = np.random.default_rng(section).choice([-1.0, 1.0], end - begin)
    samples = np.concatenate((np.zeros(before), piece[::-1]))
    taps = np.zeros((72, 3, N_TAPS))
    taps[..., begin:end] = piece
    bound, largest = bounds_of(samples, taps), largest_of(samples, taps)
    assert largest == pytest.approx(end - begin)
    assert (bound >= largest).all()
    assert (bound <= largest * 1.00001).all()
