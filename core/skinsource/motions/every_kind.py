"""Every kind of motion."""

from skinsource.motions.alternation import Alternation
from skinsource.motions.apparent_motion import ApparentMotion
from skinsource.motions.motion import Motion
from skinsource.motions.phantom import Phantom
from skinsource.motions.sweep import Sweep
from skinsource.motions.tap_sequence import TapSequence
from skinsource.motions.travelling_phase import TravellingPhase

#: Every kind of motion, in the order in which a user meets them.
MOTIONS: tuple[type[Motion], ...] = (
    Sweep,
    ApparentMotion,
    Alternation,
    TapSequence,
    TravellingPhase,
    Phantom,
)
