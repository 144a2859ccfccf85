"""How far above the threshold of detection a vibration of the skin is.

The thresholds are of glabrous skin; most outputs lie on hairy or bony skin.  Masses and glue of
accelerometers, temperature, age and force are not in the model, people differ by 6 to 10 dB, and
what lies below 25 Hz is not measured: only differences between designs on one limb are safe.
"""

from skinsource.perception.sensation import (
    LIMITS,
    LIMITS_IN_SHORT,
    sensation_levels_db,
    sensation_magnitude,
    site_offsets_db,
)
from skinsource.perception.thresholds import CHANNELS, Channel, threshold_rms

__all__ = [
    "CHANNELS",
    "LIMITS",
    "LIMITS_IN_SHORT",
    "Channel",
    "sensation_levels_db",
    "sensation_magnitude",
    "site_offsets_db",
    "threshold_rms",
]
