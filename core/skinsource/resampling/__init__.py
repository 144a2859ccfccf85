"""From one sample rate to another."""

from skinsource.resampling.between import FINER, finer
from skinsource.resampling.conversion import MAX_RATE_HZ, by_ratio, resample, stretch_of
from skinsource.resampling.extremes import EXTREMES_ERROR, Extremes, extremes_between
from skinsource.resampling.kernel import PASSED_SHARE
from skinsource.resampling.passed import passed

__all__ = [
    "EXTREMES_ERROR",
    "FINER",
    "MAX_RATE_HZ",
    "PASSED_SHARE",
    "Extremes",
    "by_ratio",
    "extremes_between",
    "finer",
    "passed",
    "resample",
    "stretch_of",
]
