"""The lines of a spectrum, as the tests of periodic waveforms look at them."""

import numpy as np


def spectrum(samples: np.ndarray) -> np.ndarray:
    """Amplitudes of the lines, the mean with its sign."""
    lines = np.fft.rfft(samples) / samples.size
    amplitudes = 2 * np.abs(lines)
    amplitudes[0] = lines[0].real
    return amplitudes
