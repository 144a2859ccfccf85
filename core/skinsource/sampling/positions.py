"""Where something lies between samples, on a grid far finer than any clock."""

from math import floor

#: Parts of a sample.  Sums of decimal times miss their exact values by some last digits: what
#: differs by less is at one place, so that it is drawn once wherever it is moved by whole samples.
_PER_SAMPLE = 2**32
#: As near to a sample is on it: less than a nanosecond at 1300 Hz.
NEAR = 1e-6


def on_grid(position: float) -> tuple[int, float]:
    """Sample at or before a position, and how far behind it the position lies, 0 to less than 1.

    Parameters
    ----------
    position
        In samples.
    """
    whole, behind = parted(position)
    return whole, round(behind * _PER_SAMPLE) / _PER_SAMPLE


def parted(position: float) -> tuple[int, float]:
    """The same to the last digit of the position: for what is added to others."""
    nearest = round(position)
    if abs(position - nearest) < NEAR:
        return nearest, 0.0
    whole = floor(position)
    return whole, position - whole
