"""From one sample rate to another."""

from skinsource.resampling.between import FINER, finer
from skinsource.resampling.conversion import MAX_RATE_HZ, by_ratio, resample, stretch_of
from skinsource.resampling.kernel import PASSED_SHARE

__all__ = [
    "FINER",
    "MAX_RATE_HZ",
    "PASSED_SHARE",
    "by_ratio",
    "finer",
    "resample",
    "stretch_of",
]
