"""Designs side by side: snapshots, alike in level, and how their levels differ."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from skinsource.base.arguments import finite_array, positive_number, real_array
from skinsource.base.arrays import Floats
from skinsource.base.decibels import FLOOR_DB, decibels
from skinsource.base.errors import InvalidInputError
from skinsource.base.published import N_OUTPUTS
from skinsource.design.design import Design
from skinsource.limbs.limb import PUBLISHED
from skinsource.limbs.locations import DIGITS, OUTPUTS
from skinsource.limbs.own_limbs import facts_of, own_limb_names
from skinsource.specs import fields
from skinsource.specs.numbers import ModelSpec, NumberSpec

# How levels of two designs differ, and what makes them alike.

#: Levels farther below the loudest output count as so far below: what cannot be felt beside it
#: makes no difference.
DEPTH_DB = 60.0
#: Ends of scales of differences, dB.
ENDS_DB = (1.0, 2.0, 3.0, 5.0, 6.0, 10.0, 15.0, 20.0, 30.0, 40.0, 60.0)
#: A scale of differences tells this share of them, and all that are a third of the largest.
_TOLD, _OF_LARGEST = 0.95, 1.0 / 3.0


def loudest_db(levels_db: ArrayLike) -> float:
    """Level of the loudest output, dB; what designs are matched by."""
    levels = real_array("levels_db", levels_db, "levels in dB")
    if not levels.size:
        raise InvalidInputError("levels_db is empty, expected at least one level")
    return float(levels.max())


def matching_gain(loudest_db: float, reference_db: float) -> float:
    """Factor that brings a loudest output to the level of another one; 1 where either is silent.

    Parameters
    ----------
    loudest_db, reference_db
        Levels of both in dB, as `loudest_db` gives them.
    """
    if loudest_db <= FLOOR_DB or reference_db <= FLOOR_DB:
        return 1.0
    # The same level gives 1 exactly: the reference itself is not changed.
    return float(10.0 ** ((reference_db - loudest_db) / 20.0))


def gain_text(gain: float) -> str:
    """What a factor is in dB, "+3.2 dB"; empty where it is none to a tenth of a dB."""
    by_db = round(20.0 * math.log10(gain), 1) if gain > 0 else 0.0
    return f"{by_db:+.1f} dB".replace("-", "\N{MINUS SIGN}") if by_db else ""


def match_text(gain: float) -> str:
    """What axes say of results that are shown with a factor, "−3.2 dB, matched"; or nothing."""
    text = gain_text(gain)
    return f"{text}, matched" if text else ""


def difference_db(
    levels_db: Floats,
    other_db: Floats,
    *,
    gain: float = 1.0,
    loudest_db: float | None = None,
    depth_db: float = DEPTH_DB,
) -> Floats:
    """How much louder than another design one is, in dB, same shape.

    Parameters
    ----------
    levels_db, other_db
        Levels at the same places, any shape; NaN outside an outline stays NaN.
    gain
        Factor with which the other one is played.
    loudest_db
        The loudest level of both; the largest of these, unless given.
    depth_db
        Levels farther below the loudest count as so far below: silence is no difference of 200 dB.
    """
    positive_number("gain", gain)
    played = other_db + 20.0 * np.log10(gain)
    if loudest_db is None:
        loudest_db = float(np.nanmax([np.nanmax(levels_db), np.nanmax(played)]))
    floor = loudest_db - depth_db
    return np.maximum(levels_db, floor) - np.maximum(played, floor)


def end_db(*differences_db: ArrayLike) -> float:
    """Where a scale ends that tells these differences, or spreads, in dB: a round number.

    A few large ones would leave all others without colour: 19 of 20 lie within the scale, and it
    reaches at least to a third of the largest, so that one that stands alone is seen as it is.
    What lies beyond has the colour of the end.

    Parameters
    ----------
    differences_db
        Of any shape and sign; NaN counts as nothing.
    """
    sizes = np.concatenate(
        [np.empty(0), *(np.abs(np.ravel(differences)) for differences in differences_db)]
    )
    sizes = sizes[~np.isnan(sizes)]
    if not sizes.size:
        return ENDS_DB[0]
    reached = max(float(np.quantile(sizes, _TOLD)), _OF_LARGEST * float(sizes.max()))
    return next((end for end in ENDS_DB if reached <= end), ENDS_DB[-1])


# The same design on several limbs: which ones, and what their levels have in common.

#: Of so many limbs or designs side by side each is still large enough to be looked at.
MOST_BESIDE = 4


def related_limbs(limb: str) -> tuple[str, ...]:
    """Names of the limbs that belong beside ``limb``, at most four, itself among them.

    Of a published or synthetic limb the four of its kind; of an own limb the others that a lab
    imported with the same outputs.
    """
    kind = limb.partition("-")[0]
    if limb in PUBLISHED:
        return tuple(name for name in PUBLISHED if name.partition("-")[0] == kind)
    others = (name for name in own_limb_names() if name != limb and same_outputs(limb, name))
    return (limb, *others)[:MOST_BESIDE]


def same_outputs(limb: str, other: str) -> bool:
    """Whether an output of one limb is at the place that it has on the other, by its number.

    That is so of all published and synthetic limbs, and of own limbs with as many outputs that
    have the same names.
    """
    facts, other_facts = facts_of(limb), facts_of(other)
    if not (facts.known and other_facts.known):
        return False
    same = facts.own == other_facts.own and facts.output_names == other_facts.output_names
    return same and facts.n_outputs == other_facts.n_outputs


def mean_and_spread_over(
    levels_db: ArrayLike, *, depth_db: float = DEPTH_DB
) -> tuple[Floats, Floats]:
    """Return mean and standard deviation, (n_outputs,), of levels over limbs or designs, in dB.

    Parameters
    ----------
    levels_db : (n, n_outputs)
        Level of each output on each; two at least.
    depth_db
        Levels farther below the loudest of all count as so far below, as in `difference_db`.

    Returns
    -------
    The mean of the levels in dB, and their standard deviation, that of a sample.

    Raises
    ------
    InvalidInputError
        The levels are not a table of at least two rows of finite numbers.
    """
    levels = real_array("levels_db", levels_db, "levels in dB")
    if levels.ndim != 2 or len(levels) < 2 or not levels.shape[1] or not np.isfinite(levels).all():
        raise InvalidInputError(
            f"levels_db has shape {levels.shape}, expected finite levels (n, n_outputs) of at "
            "least two limbs or designs"
        )
    audible = np.maximum(levels, levels.max() - depth_db)
    return audible.mean(axis=0), audible.std(axis=0, ddof=1)


# Levels by region, and how people differ.

#: Names of regions and the outputs in them.  No sensor lies on the palm itself.
REGION_OUTPUTS: dict[str, tuple[int, ...]] = {
    **{
        f"Digit {digit}": tuple(
            output.number for output in OUTPUTS if output.region == f"digit {digit}"
        )
        for digit in DIGITS
    },
    "Digits": tuple(output.number for output in OUTPUTS if output.region.startswith("digit")),
    "Back of the hand": tuple(output.number for output in OUTPUTS if output.region == "hand"),
    "Wrist": tuple(
        output.number for output in OUTPUTS if (output.region, output.side) == ("wrist", "dorsal")
    ),
    "Wrist, palm side": tuple(
        output.number for output in OUTPUTS if (output.region, output.side) == ("wrist", "volar")
    ),
    "Forearm": tuple(output.number for output in OUTPUTS if output.region == "forearm"),
    "Elbow": tuple(output.number for output in OUTPUTS if output.region == "elbow"),
}


def region_levels_db(rms: ArrayLike) -> dict[str, float]:
    """Return the level of each region: the root of the mean square over its outputs, dB re 1 m/s².

    Parameters
    ----------
    rms : (72,)
        RMS of each output, m/s².

    Raises
    ------
    InvalidInputError
        There are not the 72 outputs of the published limbs: where others lie is not known.
    """
    values = finite_array("rms", rms)
    if values.shape != (N_OUTPUTS,):
        raise InvalidInputError(
            f"rms has shape {values.shape}, expected ({N_OUTPUTS},): regions are known of the "
            "published limbs only"
        )
    power = np.square(values)
    return {
        name: float(decibels(np.sqrt(power[np.array(outputs) - 1].mean())))
        for name, outputs in REGION_OUTPUTS.items()
    }


def mean_and_spread(levels_db: Sequence[float]) -> tuple[float, float]:
    """Return the mean of levels in dB and their standard deviation, that of a sample.

    The deviation of fewer than two is NaN.
    """
    values: Floats = finite_array("levels_db", levels_db)
    if values.ndim != 1 or not values.size:
        raise InvalidInputError(f"levels_db has shape {values.shape}, expected (n_people,)")
    return float(values.mean()), float(values.std(ddof=1)) if values.size > 1 else float("nan")


# Designs that are kept to be looked at side by side.

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
    design: Design = fields.field(ModelSpec(label="Design", kinds=lambda: (Design,)))
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
    inputs = tuple(replace(track, amplitude=track.amplitude * gain) for track in design.inputs)
    return replace(design, inputs=inputs)


def same_but_rounding(design: Design, other: Design) -> bool:
    """Whether they are the same, but for the rounding of amplitudes."""
    if len(design.inputs) != len(other.inputs):
        return False
    pairs = list(zip(design.inputs, other.inputs, strict=True))
    same_amplitudes = tuple(
        replace(track, amplitude=other_track.amplitude) for track, other_track in pairs
    )
    return replace(design, inputs=same_amplitudes) == other and all(
        math.isclose(track.amplitude, other_track.amplitude, rel_tol=1e-9)
        for track, other_track in pairs
    )


def shown(snapshots: Sequence[Snapshot], design: Design) -> Snapshot | None:
    """Return the snapshot that ``design`` is; None where it is none of them."""
    # The one that was shown last stands last.
    return next((snapshot for snapshot in reversed(snapshots) if snapshot.design == design), None)


def with_edited(snapshots: Sequence[Snapshot], design: Design) -> tuple[Snapshot, ...]:
    """Return all snapshots, and ``design`` as what is edited if it is none of them."""
    if shown(snapshots, design) is not None:
        return tuple(snapshots)
    stored = (snapshot for snapshot in snapshots if snapshot.number != EDITED)
    return (*stored, Snapshot(number=EDITED, design=design))


def other_than(snapshots: Sequence[Snapshot], design: Design) -> Snapshot | None:
    """Return the snapshot that was shown last and is not ``design``; None: there is none.

    From a design that is no snapshot the way leads to a stored one: it takes the place of what was
    edited before.  Where all others are the same as ``design``, it leads to one of these.
    """
    current = shown(snapshots, design)
    without = EDITED if current is None else current.number
    others = [snapshot for snapshot in reversed(snapshots) if snapshot.number != without]
    differing = (snapshot for snapshot in others if snapshot.design != design)
    equal = (snapshot for snapshot in others if snapshot.number != EDITED)
    return next(differing, None) or next(equal, None)


def name_of(number: int) -> str:
    """What the design under a number is called in a sentence."""
    return "what was edited" if number == EDITED else f"snapshot {number}"


def why_no_comparison(snapshots: Sequence[Snapshot]) -> str:
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
    return min(snapshots, key=lambda snapshot: snapshot.number, default=None)


def brought_back(
    restored: Sequence[Snapshot], other: Sequence[Snapshot], present: Sequence[Snapshot]
) -> tuple[Snapshot, ...]:
    """Return ``present`` with that in place of which an edit had changed ``wanted`` to ``other``.

    What was stored since then stays, also under a number that the edit had made free.  The order is
    that of ``wanted``, the one that was shown last stands last; what it does not hold comes after.
    """
    before, after, current = (
        {snapshot.number: snapshot for snapshot in snapshots}
        for snapshots in (restored, other, present)
    )
    for number in {*before, *after}:
        if before.get(number) == after.get(number) or current.get(number) != after.get(number):
            continue
        current.pop(number, None)
        if number in before:
            current[number] = before[number]
    numbers = [
        *(number for number in before if number in current),
        *(number for number in current if number not in before),
    ]
    return tuple(current[number] for number in numbers)
