"""Designs that are kept to be looked at side by side."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from skinsource import fields
from skinsource.design import Design
from skinsource.fields import NumberSpec, RecipeSpec

#: Numbers that the user stores under.
NUMBERS: tuple[int, ...] = (1, 2, 3, 4)
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
        Factor on what is predicted and played with which it was shown last, so that its level
        matched; the design itself never has it.
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
        """A design that is as loud as this one was when it was shown last."""
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


def alike(design: Design, other: Design) -> bool:
    """Whether they are the same, but for the rounding of amplitudes."""
    if len(design.inputs) != len(other.inputs):
        return False
    pairs = list(zip(design.inputs, other.inputs, strict=True))
    taken = tuple(replace(one, amplitude=than.amplitude) for one, than in pairs)
    return replace(design, inputs=taken) == other and all(
        math.isclose(one.amplitude, than.amplitude, rel_tol=1e-9) for one, than in pairs
    )


def shown(snapshots: Sequence[Snapshot], design: Design) -> Snapshot | None:
    """Return the snapshot that ``design`` is; None where it is none of them."""
    # The one that was shown last stands last.
    return next((one for one in reversed(snapshots) if one.design == design), None)


def together(snapshots: Sequence[Snapshot], design: Design) -> tuple[Snapshot, ...]:
    """Return all snapshots, and ``design`` as what is edited if it is none of them."""
    if shown(snapshots, design) is not None:
        return tuple(snapshots)
    stored = (one for one in snapshots if one.number != EDITED)
    return (*stored, Snapshot(number=EDITED, design=design))


def other_than(snapshots: Sequence[Snapshot], design: Design) -> Snapshot | None:
    """Return the snapshot that was shown last and is not ``design``; None: there is none.

    From a design that is no snapshot the way leads to a stored one: it takes the place of what was
    edited before.  Where all others are the same as ``design``, it leads to one of these.
    """
    here = shown(snapshots, design)
    without = EDITED if here is None else here.number
    others = [one for one in reversed(snapshots) if one.number != without]
    differing = (one for one in others if one.design != design)
    equal = (one for one in others if one.number != EDITED)
    return next(differing, None) or next(equal, None)


def name_of(number: int) -> str:
    """What the design under a number is called in a sentence."""
    return "what was edited" if number == EDITED else f"snapshot {number}"


def nothing_to_compare(snapshots: Sequence[Snapshot]) -> str:
    """Say why `other_than` found nothing, and what can be done."""
    if not snapshots:
        return "Store the design with Ctrl+1 to Ctrl+4, change it, and press X to go to and fro."
    name = name_of(snapshots[-1].number)
    return (
        f"The design in the window is {name}, and nothing else is stored. Change it, or store a "
        "second one with Ctrl+1 to Ctrl+4, and press X to go to and fro."
    )


def reference(snapshots: Sequence[Snapshot]) -> Snapshot | None:
    """Return the snapshot whose level the others take on: that of the lowest number.

    What was edited is never changed, therefore.
    """
    return min(snapshots, key=lambda one: one.number, default=None)


def brought_back(
    wanted: Sequence[Snapshot], other: Sequence[Snapshot], present: Sequence[Snapshot]
) -> tuple[Snapshot, ...]:
    """Return ``present`` with that in place of which an edit had changed ``wanted`` to ``other``.

    What was stored since then stays, also under a number that the edit had made free.  The order is
    that of ``wanted``, the one that was shown last stands last; what it does not hold comes after.
    """
    then, gone, now = ({one.number: one for one in each} for each in (wanted, other, present))
    for number in {*then, *gone}:
        if then.get(number) == gone.get(number) or now.get(number) != gone.get(number):
            continue
        now.pop(number, None)
        if number in then:
            now[number] = then[number]
    numbers = [*(one for one in then if one in now), *(one for one in now if one not in then)]
    return tuple(now[number] for number in numbers)
