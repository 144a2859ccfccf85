"""When samples lie, and what a signal is between them."""

from skinsource.sampling.at_instant import values_at
from skinsource.sampling.band_limited_delay import band_limited_delay
from skinsource.sampling.between import values_between
from skinsource.sampling.positions import NEAR, on_grid, parted
from skinsource.sampling.turns import shift_of, turns

__all__ = [
    "NEAR",
    "band_limited_delay",
    "on_grid",
    "parted",
    "shift_of",
    "turns",
    "values_at",
    "values_between",
]
