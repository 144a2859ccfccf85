"""Compare designs and limbs: snapshots, matched levels, differences, and levels by region.

A `Snapshot` is a design stored under a number; the view holds several, and the one that was shown
last is the last of them.  Levels of two designs are matched by the loudest output of each.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from skinsource.base.arguments import finite_array, real_array
from skinsource.base.conventions import N_OUTPUTS, Floats
from skinsource.base.decibels import FLOOR_DB, decibels
from skinsource.base.errors import InvalidInputError
from skinsource.design.clips import Clip
from skinsource.design.design import EDITED, Design, Snapshot, played_clips, shown_snapshot
from skinsource.limbs.limb import PUBLISHED
from skinsource.limbs.locations import DIGITS, OUTPUTS
from skinsource.limbs.own_limbs import facts_of, own_limb_names

#: Levels farther below the loudest output are raised to this depth: next to the loudest output
#: nobody can feel them.
DEPTH_DB = 60.0
#: Ends of scales of differences, dB.
ENDS_DB = (1.0, 2.0, 3.0, 5.0, 6.0, 10.0, 15.0, 20.0, 30.0, 40.0, 60.0)
#: A scale of differences covers this share of them, and reaches this part of the largest.
_COVERED_SHARE, _PART_OF_LARGEST = 0.95, 1.0 / 3.0


def loudest_db(levels_db: ArrayLike) -> float:
    """Return the level of the loudest output in dB, by which designs are matched."""
    levels = real_array("levels_db", levels_db, "levels in dB")
    if not levels.size:
        raise InvalidInputError("levels_db is empty, expected at least one level")
    return float(levels.max())


def matching_gain(loudest_db: float, reference_db: float) -> float:
    """Return the factor that gives one loudest output the level of another; 1 if one is silent.

    Parameters
    ----------
    loudest_db, reference_db
        Both levels in dB, as `loudest_db` returns them.
    """
    if loudest_db <= FLOOR_DB or reference_db <= FLOOR_DB:
        return 1.0
    # Equal levels give exactly 1, so that the reference itself is not changed.
    return float(10.0 ** ((reference_db - loudest_db) / 20.0))


def gain_text(gain: float) -> str:
    """Return a factor in dB, "+3.2 dB"; empty where it rounds to 0 dB."""
    by_db = round(20.0 * math.log10(gain), 1) if gain > 0 else 0.0
    return f"{by_db:+.1f} dB".replace("-", "\N{MINUS SIGN}") if by_db else ""


def match_text(gain: float) -> str:
    """Return the note for axes of matched results, "−3.2 dB, matched"; empty without a factor."""
    text = gain_text(gain)
    return f"{text}, matched" if text else ""


def difference_db(levels_db: Floats, other_db: Floats) -> Floats:
    """Return how much louder one design is than another, in dB, of the same shape.

    Parameters
    ----------
    levels_db, other_db
        Levels at the same places, any shape; NaN outside an outline stays NaN.

    Levels farther than 60 dB below the loudest are raised to this depth, so that silence does not
    give differences of 200 dB.
    """
    floor = float(np.nanmax([np.nanmax(levels_db), np.nanmax(other_db)])) - DEPTH_DB
    return np.maximum(levels_db, floor) - np.maximum(other_db, floor)


def scale_end_db(*differences_db: ArrayLike) -> float:
    """Return the end of a colour scale for differences or spreads in dB: a round number.

    A few large values would leave all others without colour.  So 19 of 20 values lie within the
    scale, and it reaches at least a third of the largest value, which keeps a single one visible.
    Values beyond have the colour of the end.

    Parameters
    ----------
    differences_db
        Values of any shape and sign; NaN is ignored.
    """
    sizes = np.concatenate(
        [np.empty(0), *(np.abs(np.ravel(differences)) for differences in differences_db)]
    )
    sizes = sizes[~np.isnan(sizes)]
    if not sizes.size:
        return ENDS_DB[0]
    quantile = float(np.quantile(sizes, _COVERED_SHARE))
    reached = max(quantile, _PART_OF_LARGEST * float(sizes.max()))
    return next((end for end in ENDS_DB if reached <= end), ENDS_DB[-1])


#: Most limbs or designs side by side; with more each would be too small to see.
MOST_SIDE_BY_SIDE = 6


def related_limbs(limb: str) -> tuple[str, ...]:
    """Return the names of limbs to compare with ``limb``, at most six with itself.

    For a published or synthetic limb these are the four of its kind, for an own limb the other own
    limbs with the same outputs.
    """
    kind = limb.partition("-")[0]
    if limb in PUBLISHED:
        return tuple(name for name in PUBLISHED if name.partition("-")[0] == kind)
    others = (name for name in own_limb_names() if name != limb and same_outputs(limb, name))
    return (limb, *others)[:MOST_SIDE_BY_SIDE]


def same_outputs(limb: str, other: str) -> bool:
    """Whether outputs with the same number are at the same place on both limbs.

    This holds for all published and synthetic limbs, and for own limbs with the same number of
    outputs and the same names of outputs.
    """
    facts, other_facts = facts_of(limb), facts_of(other)
    if not (facts.known and other_facts.known):
        return False
    return (facts.own, facts.output_names, facts.n_outputs) == (
        other_facts.own,
        other_facts.output_names,
        other_facts.n_outputs,
    )


def mean_and_spread_over(levels_db: ArrayLike) -> tuple[Floats, Floats]:
    """Return mean and standard deviation, (n_outputs,), of levels over limbs or designs, in dB.

    Parameters
    ----------
    levels_db : (n, n_outputs)
        Level of each output on each; two at least.  Levels far below the loudest of all are raised
        as in `difference_db`.

    Returns
    -------
    The mean of the levels in dB, and their sample standard deviation.

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
    audible = np.maximum(levels, levels.max() - DEPTH_DB)
    return audible.mean(axis=0), audible.std(axis=0, ddof=1)


#: What a range between people is, and what it held.
RANGE_BETWEEN_PEOPLE = (
    "range between people: predicted from three, it held 78 to 97 % of the fourth one's levels; "
    "four people, one posture"
)
#: Why there is none.
NO_RANGE = "A range between people is known on published limbs alone."
#: Half of 90 % of a normal distribution, in standard deviations.
_HALF = 1.645


def half_width_db(people_db: Floats) -> float:
    """Return half the width of the range, of levels (n_people, ...) of what plays."""
    n_people = len(people_db)
    variance = people_db.var(axis=0, ddof=1).mean()
    return float(_HALF * np.sqrt(variance * (1.0 + 1.0 / n_people)))


def range_sentences(half_db: float | None) -> str:
    """Return how wide a range is at every place, if that is known, and what it is."""
    half = "" if half_db is None else f"±{half_db:.1f} dB at every place. "
    return f"{half}{RANGE_BETWEEN_PEOPLE[0].upper()}{RANGE_BETWEEN_PEOPLE[1:]}"


def _outputs_in(region: str, side: str = "") -> tuple[int, ...]:
    """Return the outputs of a region, on one side if it is given."""
    return tuple(
        output.number for output in OUTPUTS if output.region == region and side in ("", output.side)
    )


#: Outputs by region.  No sensor lies on the palm itself.
REGION_OUTPUTS: dict[str, tuple[int, ...]] = {
    **{f"Digit {digit}": _outputs_in(f"digit {digit}") for digit in DIGITS},
    "Digits": tuple(output.number for output in OUTPUTS if output.region.startswith("digit")),
    "Back of the hand": _outputs_in("hand"),
    "Wrist": _outputs_in("wrist", "dorsal"),
    "Wrist, palm side": _outputs_in("wrist", "volar"),
    "Forearm": _outputs_in("forearm"),
    "Elbow": _outputs_in("elbow"),
}


def published_range_db(people_db: Floats) -> tuple[Floats, float]:
    """Return the mean, (n_outputs,), and half the width of the range of people.

    Parameters
    ----------
    people_db : (n_people, n_outputs)
        Levels on published limbs; the width is pooled over the hand.
    """
    hand = np.array([*REGION_OUTPUTS["Digits"], *REGION_OUTPUTS["Back of the hand"]]) - 1
    return people_db.mean(axis=0), half_width_db(people_db[:, hand])


def region_levels_db(rms: ArrayLike) -> dict[str, float]:
    """Return the level of each region: the root of the mean square over its outputs, dB re 1 m/s².

    Parameters
    ----------
    rms : (72,)
        RMS of each output, m/s².

    Raises
    ------
    InvalidInputError
        The outputs are not the 72 of the published limbs, the only ones whose regions are known.
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


def at_frequency(design: Design, frequency_hz: float) -> Design:
    """Return ``design`` with all that has a frequency of its own, such as tones, at another one."""

    def changed(clip: Clip) -> Clip:
        waveform: Any = clip.waveform
        if not hasattr(waveform, "frequency_hz"):
            return clip
        return replace(clip, waveform=replace(waveform, frequency_hz=frequency_hz))

    inputs = (replace(track, clips=tuple(map(changed, track.clips))) for track in design.inputs)
    return replace(design, inputs=tuple(inputs))


def frequency_of(design: Design) -> float | None:
    """Return the one frequency of the clips that play, Hz; infinity: they differ, None: none."""
    known = {getattr(clip.waveform, "frequency_hz", None) for clip in played_clips(design)} - {None}
    return math.inf if len(known) > 1 else next(iter(known), None)


def same_but_rounding(design: Design, other: Design) -> bool:
    """Whether two designs are equal apart from the rounding of amplitudes."""
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


def with_edited(snapshots: Sequence[Snapshot], design: Design) -> tuple[Snapshot, ...]:
    """Return the snapshots, with ``design`` as the edited one if it is none of them."""
    if shown_snapshot(snapshots, design) is not None:
        return tuple(snapshots)
    stored = (snapshot for snapshot in snapshots if snapshot.number != EDITED)
    return (*stored, Snapshot(number=EDITED, design=design))


def other_snapshot(snapshots: Sequence[Snapshot], design: Design) -> Snapshot | None:
    """Return the snapshot that was shown last and is not ``design``, if any.

    For a design that is no snapshot this is a stored one, because the design itself replaces the
    one that was edited before.  If all others are equal to ``design``, it is one of those.
    """
    current = shown_snapshot(snapshots, design)
    without = EDITED if current is None else current.number
    others = [snapshot for snapshot in reversed(snapshots) if snapshot.number != without]
    differing = (snapshot for snapshot in others if snapshot.design != design)
    equal = (snapshot for snapshot in others if snapshot.number != EDITED)
    return next(differing, None) or next(equal, None)


def snapshot_name(number: int) -> str:
    """Return the name, within a sentence, of the design under a number."""
    return "the working design" if number == EDITED else f"snapshot {number}"


def stored_name(snapshots: Sequence[Snapshot], design: Design) -> str:
    """Return the name of the stored snapshot that holds ``design``; "" where none does."""
    shown = shown_snapshot(snapshots, design) if snapshots else None
    return snapshot_name(shown.number) if shown and shown.number != EDITED else ""


def common_title(titles: Sequence[str]) -> str:
    """Return the leading parts, between middle dots, that all titles have in common; else ""."""
    parts = [title.split(" · ") for title in titles]
    common: list[str] = []
    for column in zip(*parts, strict=False):
        if len(set(column)) > 1:
            break
        common.append(column[0])
    return " · ".join(common)


def own_parts(titles: Sequence[str]) -> dict[str, str]:
    """Return the part of each title that is its own: ``"50 Hz"`` of ``"Fig. 2B · 50 Hz"``.

    The parts of a title are between middle dots; those at the beginning that all titles share are
    left out.
    """
    common = common_title([title.rpartition(" · ")[0] for title in titles])
    return {title: title.removeprefix(f"{common} · ") for title in titles}


def why_no_comparison(snapshots: Sequence[Snapshot]) -> str:
    """Say why `other_snapshot` returns None, and what the user can do."""
    if not snapshots:
        return "Store the design with Ctrl+Shift+1 to 4, change it, then press X to switch."
    name = snapshot_name(snapshots[-1].number)
    return (
        f"The design in the window is {name}, and nothing else is stored. Change it, or store a "
        "second one with Ctrl+Shift+1 to 4, then press X to switch between them."
    )


def restored_snapshots(
    restored: Sequence[Snapshot], other: Sequence[Snapshot], present: Sequence[Snapshot]
) -> tuple[Snapshot, ...]:
    """Undo in ``present`` the edit that had changed the snapshots ``restored`` to ``other``.

    Snapshots that were stored since then stay, also under a number that the edit had freed.  The
    order is that of ``restored``, so that the one that was shown last is last; others follow.
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
