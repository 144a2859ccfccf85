"""From one sample rate to another."""

from skinsource.resampling.conversion import MAX_RATE_HZ, by_ratio, resample, stretch_of
from skinsource.resampling.kernel import PASSED_SHARE

__all__ = ["MAX_RATE_HZ", "PASSED_SHARE", "by_ratio", "resample", "stretch_of"]
