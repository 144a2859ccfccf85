"""Recipes of what is done to samples of a waveform.

An effect is a frozen dataclass with fields from `skinsource.specs.fields`, among them the switch
`on`, and everything that `Effect` names; what keeps the time takes that from `KeepsTime`.  To add
one: write a file beside these, and name its class in `EFFECTS`.
"""

from skinsource.design.effects.effect import ON, Effect, KeepsTime, own_duration_s
from skinsource.design.effects.level import BandLimit, Envelope, Fade, Rectify, SoftClip
from skinsource.design.effects.playing import placed, played, played_s
from skinsource.design.effects.time import Repeat, Reverse, Stretch, Trim, stretched_by

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
