"""One upper limb: its impulse responses, its map, and how large all of it is."""

from skinsource.limb.axes import ALL_AXES, AXES, Axes, axes_of, axis_numbers, words
from skinsource.limb.band import Band
from skinsource.limb.facts import LIVE_INPUTS, LIVE_OUTPUTS, PUBLISHED, LimbFacts
from skinsource.limb.limb import Limb
from skinsource.limb.limb_map import LimbMap
from skinsource.limb.places import check_input_location
from skinsource.limb.published import (
    BAND_HZ,
    HAND_LENGTHS_MM,
    LIMB_NAMES,
    MOST_PLACES,
    N_AXES,
    N_INPUTS,
    N_OUTPUTS,
    N_TAPS,
    PRE_TRIGGER_DELAY_S,
    SAMPLE_RATE_HZ,
    VOLAR_OUTPUTS,
)
from skinsource.limb.skin import LARGEST_VELOCITY_M_PER_S

__all__ = [
    "ALL_AXES",
    "AXES",
    "BAND_HZ",
    "HAND_LENGTHS_MM",
    "LARGEST_VELOCITY_M_PER_S",
    "LIMB_NAMES",
    "LIVE_INPUTS",
    "LIVE_OUTPUTS",
    "MOST_PLACES",
    "N_AXES",
    "N_INPUTS",
    "N_OUTPUTS",
    "N_TAPS",
    "PRE_TRIGGER_DELAY_S",
    "PUBLISHED",
    "SAMPLE_RATE_HZ",
    "VOLAR_OUTPUTS",
    "Axes",
    "Band",
    "Limb",
    "LimbFacts",
    "LimbMap",
    "axes_of",
    "axis_numbers",
    "check_input_location",
    "words",
]
