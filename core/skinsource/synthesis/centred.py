"""Wavelets about the middle of their samples."""

from fractions import Fraction

import numpy as np

from skinsource.arrays import Floats
from skinsource.sampling import turns


def about_middle(n: int, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
    """Times from the middle of ``n`` samples, in s, (n_times,).

    (k - (n - 1) / 2) / rate, less the shift; with one, there is one sample more.
    """
    place: Floats = np.arange(n + (shift_s > 0.0)) - np.float64((n - 1) / 2)
    return place / sample_rate_hz - shift_s


def turns_about_middle(
    frequency_hz: float, n: int, sample_rate_hz: float, shift_s: float = 0.0
) -> Floats:
    """Turns of a tone at the times `about_middle`, (n_times,), less whole ones."""
    found = turns(frequency_hz, n + (shift_s > 0.0), sample_rate_hz, shift_s)
    # Exact, as the turns themselves.
    until_middle = Fraction(frequency_hz) * (n - 1) / (2 * Fraction(sample_rate_hz))
    found -= float(until_middle % 1)
    return found


def begun(samples: Floats, shift_s: float) -> Floats:
    """Silence what lies before the beginning: of a shifted recipe the first sample, in place."""
    if shift_s > 0.0:
        samples[:1] = 0.0
    return samples
