"""Designs that are kept to be looked at side by side."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from skinsource import fields
from skinsource.design import Design
from skinsource.fields import NumberSpec, RecipeSpec

#: Numbers that the user stores under.
NUMBERS = (1, 2, 3, 4)
#: Stands for the design that was edited and not stored when another one was shown.
EDITED = 0

NUMBER = NumberSpec(label="Number", minimum=0, maximum=max(NUMBERS), whole=True)
GAIN = NumberSpec(label="Gain", minimum=1e-12, maximum=1e12)


@dataclass(frozen=True, slots=True, kw_only=True)
class Snapshot:
    """A design under a number.

    Attributes
    ----------
    number
        1 to 4; 0 is what was edited when a snapshot was shown.
    design
        As it was stored.
    gain
        Factor on all amplitudes with which it was shown last, so that its level matched.
    """

    number: int = fields.number(EDITED, NUMBER)
    design: Design = fields.field(RecipeSpec(label="Design", kinds=lambda: (Design,)))
    gain: float = fields.number(1.0, GAIN)

    def __post_init__(self) -> None:
        fields.check(self)
        # Whoever looks at it asks for this, and must get it.
        louder(self.design, self.gain)

    @property
    def played(self) -> Design:
        """The design as it was shown last."""
        return louder(self.design, self.gain)


def louder(design: Design, gain: float) -> Design:
    """Return ``design`` with all amplitudes times ``gain``; every level rises by 20 log10(gain).

    Raises
    ------
    InvalidInputError
        An amplitude would be larger than any input may have.
    """
    if gain == 1.0:
        return design
    inputs = tuple(replace(one, amplitude=one.amplitude * gain) for one in design.inputs)
    return replace(design, inputs=inputs)


def shown(snapshots: Sequence[Snapshot], design: Design) -> Snapshot | None:
    """Return the snapshot that ``design`` is; None where it is none of them."""
    # The one that was shown last stands last.
    return next((one for one in reversed(snapshots) if one.played == design), None)


def other_than(snapshots: Sequence[Snapshot], design: Design) -> Snapshot | None:
    """Return the snapshot that was shown last and is not ``design``; None: there is none.

    From a design that is no snapshot the way leads to a stored one: it takes the place of what was
    edited before.
    """
    stored_only = shown(snapshots, design) is None
    others = (one for one in reversed(snapshots) if one.played != design)
    return next((one for one in others if not stored_only or one.number != EDITED), None)


def reference(snapshots: Sequence[Snapshot]) -> Snapshot | None:
    """Return the snapshot whose level the others take on: that of the lowest number.

    What was edited is never changed, therefore.
    """
    return min(snapshots, key=lambda one: one.number, default=None)
