"""What the tests of wavelets, trains and glides share: two rates, and a fine spectrum."""

import numpy as np

RATE_HZ = 1300.0
FINE_HZ = 48000.0


def at_all_frequencies(samples: np.ndarray, rate_hz: float) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies in steps below 0.1 Hz, and the spectrum there."""
    n = max(2**20, samples.size)
    return np.fft.rfftfreq(n, 1 / rate_hz), np.abs(np.fft.rfft(samples, n))
