"""Motions: recipes that write ordinary tracks, so that something seems to move over the skin.

A motion is a frozen dataclass with fields from `skinsource.fields`, and everything that `Motion`
names.  To add one: write a file beside these, and name its class in `every_kind.MOTIONS`.
"""

from skinsource.motions.alternation import Alternation
from skinsource.motions.apparent_motion import ApparentMotion
from skinsource.motions.every_kind import MOTIONS
from skinsource.motions.motion import Motion
from skinsource.motions.phantom import Phantom
from skinsource.motions.sweep import Sweep
from skinsource.motions.tap_sequence import TapSequence
from skinsource.motions.travelling_phase import TravellingPhase

__all__ = [
    "MOTIONS",
    "Alternation",
    "ApparentMotion",
    "Motion",
    "Phantom",
    "Sweep",
    "TapSequence",
    "TravellingPhase",
]
