"""Maxima and gains where the field is never positive."""

import numpy as np
import pytest

from skinsource.base.measurement_conditions import N_TAPS
from skinsource.design.signal_path import drive_of
from skinsource.engine.gains import exact_gains, peaks_of, unit_gains
from skinsource.engine.spectra import ResponseSpectrum
from skinsource.engine.transforms import BLOCK_FFT, Blocks, forward, transform_length

LENGTHS = (1, 300, 2000, 2 * Blocks(N_TAPS).n_samples - N_TAPS + 1, 5000)
ALL_NEGATIVE = np.broadcast_to(-0.1 - np.exp(-np.arange(N_TAPS) / 100), (72, 3, N_TAPS)).copy()


def loud(n_times: int) -> np.ndarray:
    return 3.0 + np.random.default_rng(n_times).uniform(size=n_times)


def ways(samples: np.ndarray, taps: np.ndarray):
    """Arguments of a search of the whole, and of one block by block."""
    drive, n_fft = drive_of(samples), transform_length(samples.size + N_TAPS - 1)
    whole = ResponseSpectrum(taps, forward(taps, n_fft), n_fft)
    blocks = ResponseSpectrum(taps, forward(taps, BLOCK_FFT), BLOCK_FFT)
    return ([drive], [forward(drive.samples, n_fft)], [whole]), ([drive], [], [blocks])


@pytest.mark.parametrize("n_times", LENGTHS)
def test_a_field_that_is_never_positive_is_not_divided(n_times):
    for arguments in ways(loud(n_times), ALL_NEGATIVE):
        assert unit_gains(*arguments) == [2.0]  # the power of two that the drive was divided by
        assert exact_gains(*arguments, stop=lambda: False) == [2.0]


@pytest.mark.parametrize("n_times", LENGTHS)
def test_a_field_that_is_never_positive_is_not_divided_however_small(n_times):
    for arguments in ways(loud(n_times) * 1e-200, ALL_NEGATIVE * 1e-30):
        assert unit_gains(*arguments) == [arguments[0][0].factor]


@pytest.mark.parametrize("n_times", LENGTHS)
def test_a_field_that_is_hardly_positive_is_divided_by_its_maximum(n_times):
    taps = ALL_NEGATIVE.copy()
    taps[40, 2] *= -1e-6
    largest = np.convolve(loud(n_times), taps[40, 2]).max()
    for arguments in ways(loud(n_times), taps):
        # The gain is that of the scaled samples: so many times as large.
        assert unit_gains(*arguments)[0] * largest == pytest.approx(2.0, rel=1e-6)
        assert exact_gains(*arguments, stop=lambda: False)[0] * largest == pytest.approx(
            2.0, rel=1e-6
        )


def test_the_maximum_of_blocks_that_are_all_negative_is_their_largest_sample():
    samples = loud(2 * Blocks(N_TAPS).n_samples - N_TAPS + 1)  # no silence after the response
    drive = drive_of(samples)
    blocks = ResponseSpectrum(ALL_NEGATIVE, forward(ALL_NEGATIVE, BLOCK_FFT), BLOCK_FFT)
    (peak,) = peaks_of([drive.samples], [], [blocks])
    expected = np.convolve(drive.samples, ALL_NEGATIVE[0, 0])
    assert peak.value == pytest.approx(expected.max(), rel=1e-9)
    assert peak.time == expected.argmax()
