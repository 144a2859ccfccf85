"""From one sample rate to another."""

from skinsource.resampling.conversion import MAX_RATE_HZ, by_ratio, resample, stretch_of

__all__ = ["MAX_RATE_HZ", "by_ratio", "resample", "stretch_of"]
