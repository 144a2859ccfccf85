"""Effects on the samples of a waveform.

An effect is a frozen dataclass with fields from `skinsource.specs.fields`, among them the switch
`on`, and everything that `Effect` names; effects that do not change the time inherit `KeepsTime`.
To add one, write its class in a module of this package and name it in `EFFECTS`.
"""

from skinsource.design.effects.effect import ON, Effect, KeepsTime, own_duration_s
from skinsource.design.effects.level import BandLimit, Envelope, Fade, Rectify, SoftClip
from skinsource.design.effects.playing import placed, played, played_s
from skinsource.design.effects.time import Repeat, Reverse, Stretch, Trim, stretched_by

#: Every effect, in the order of the menu.
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
    """Return every effect; a function, so that tests can add effects.

    Examples
    --------
    >>> import skinsource as ss
    >>> print([kind.__name__ for kind in ss.effects.effect_kinds()][:3])
    ['Envelope', 'Fade', 'Trim']
    """
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
