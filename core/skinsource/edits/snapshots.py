"""Snapshots of the design, and going from one to another."""

from dataclasses import replace

from skinsource.comparing import EDITED, NUMBERS, Snapshot, gain_words, louder, name_of, shown
from skinsource.design import Design
from skinsource.edits.edit import Edit, Refusal, refused
from skinsource.errors import InvalidInputError
from skinsource.quoting import quoted
from skinsource.view import View

_NONE = Refusal(sentence="Nothing is stored to compare with; store a snapshot with Ctrl+1 to 4.")


def store_snapshot(design: Design, view: View, number: int) -> Edit | Refusal:
    """Keep the design as it is now under a number; what was kept under it goes."""
    if number not in NUMBERS:
        return Refusal(
            sentence=f"No snapshot has the number {quoted(number)}; choose {NUMBERS[0]} to "
            f"{NUMBERS[-1]}."
        )
    try:
        # What is in the window stays as loud as it is.
        new = Snapshot(number=number, design=design, gain=view.match_gain(design))
        kept = (*_without(view, number), new)
        after = replace(view, snapshots=kept)
    except InvalidInputError as error:
        return refused(error)
    return Edit(label=f"Store snapshot {number}", design=design, view=after)


def take_snapshot(design: Design, view: View, other: Design) -> Edit | Refusal:
    """Keep another design, such as one of a file, under the lowest number that is free."""
    taken = {one.number for one in view.snapshots}
    free = next((number for number in NUMBERS if number not in taken), None)
    if free is None:
        return Refusal(
            sentence=f"All {len(NUMBERS)} snapshots are taken. Forget one first: Delete on its "
            "card in the panel Compare."
        )
    try:
        after = replace(view, snapshots=(*view.snapshots, Snapshot(number=free, design=other)))
    except InvalidInputError as error:
        return refused(error)
    return Edit(label=f"Store snapshot {free}", design=design, view=after)


def show_snapshot(design: Design, view: View, number: int, gain: float = 1.0) -> Edit | Refusal:
    """Put a snapshot in place of the design, as it was stored; the view shows it with ``gain``.

    A design that is no snapshot is kept under the number 0, so that the way back leads to it.
    """
    wanted = next((one for one in view.snapshots if one.number == number), None)
    if wanted is None:
        return _NONE
    kept = view.snapshots
    if shown(kept, design) is None:
        if number == EDITED:
            return Refusal(
                sentence="What was edited before would replace the present design unseen; store "
                "that first."
            )
        kept = (*_without(view, EDITED), Snapshot(number=EDITED, design=design))
    try:
        now = replace(wanted, gain=gain)
        after = replace(view, snapshots=(*(one for one in kept if one.number != number), now))
    except InvalidInputError as error:
        return refused(error)
    return Edit(label=f"Show {name_of(number)}", design=wanted.design, view=after)


def keep_match_gain(design: Design, view: View) -> Edit | Refusal:
    """Give the design the amplitudes that it is shown with to match another one."""
    gain = view.match_gain(design)
    if gain == 1.0:
        return Refusal(sentence="The design is shown with the amplitudes that it has.")
    return Edit(
        label=f"Keep {gain_words(gain) or 'the match gain'}",
        design=louder(design, gain),
        view=view,
    )


def forget_snapshot(design: Design, view: View, number: int) -> Edit | Refusal:
    """Forget what is kept under a number."""
    left = _without(view, number)
    if len(left) == len(view.snapshots):
        return _NONE
    return Edit(
        label=f"Forget {name_of(number)}", design=design, view=replace(view, snapshots=left)
    )


def match_levels(design: Design, view: View, on: bool) -> Edit | Refusal:
    """Show snapshots as loud as each other, or as loud as they were stored."""
    try:
        after = replace(view, levels_matched=on)
    except InvalidInputError as error:
        return refused(error)
    return Edit(label="Match levels", design=design, view=after)


def _without(view: View, number: int) -> tuple[Snapshot, ...]:
    return tuple(one for one in view.snapshots if one.number != number)
