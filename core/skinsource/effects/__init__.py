"""Recipes of what is done to samples of a waveform.

An effect is a frozen dataclass with fields from `skinsource.fields`, among them the switch `on`,
and everything that `Effect` names; what keeps the time takes that from `KeepsTime`.  To add one:
write a file beside these, and name its class in `EFFECTS`.
"""

from skinsource.effects.band_limit import BandLimit
from skinsource.effects.effect import ON, Effect, KeepsTime, own_duration_s
from skinsource.effects.envelope import Envelope
from skinsource.effects.fade import Fade
from skinsource.effects.playing import placed, played, played_s
from skinsource.effects.rectify import Rectify
from skinsource.effects.repeat import Repeat
from skinsource.effects.reverse import Reverse
from skinsource.effects.soft_clip import SoftClip
from skinsource.effects.stretch import Stretch, stretched_by
from skinsource.effects.trim import Trim

#: Every effect, in the order in which a user meets them.
EFFECTS: tuple[type[Effect], ...] = (
    Envelope,
    Fade,
    Trim,
    Reverse,
    Stretch,
    Repeat,
    BandLimit,
    Rectify,
    SoftClip,
)


def effect_kinds() -> tuple[type[Effect], ...]:
    """Every effect that there is now; whoever needs them asks when he does."""
    return EFFECTS


__all__ = [
    "EFFECTS",
    "ON",
    "BandLimit",
    "Effect",
    "Envelope",
    "Fade",
    "KeepsTime",
    "Rectify",
    "Repeat",
    "Reverse",
    "SoftClip",
    "Stretch",
    "Trim",
    "effect_kinds",
    "own_duration_s",
    "placed",
    "played",
    "played_s",
    "stretched_by",
]
