"""When samples lie, and what a signal is between them."""

from skinsource.sampling.band_limited_delay import band_limited_delay
from skinsource.sampling.turns import shift_of, turns

__all__ = ["band_limited_delay", "shift_of", "turns"]
