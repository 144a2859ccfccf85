"""Change selected outputs, markers, the loop, the gain curve of a track, titles and snapshots."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from skinsource.base.errors import quoted
from skinsource.design.clips import Marker
from skinsource.design.comparing import gain_text, snapshot_name, stored_name
from skinsource.design.design import (
    EDITED,
    MAX_MARKERS,
    NUMBERS,
    Design,
    Snapshot,
    View,
    louder,
    shown_snapshot,
)
from skinsource.design.edits.clips import SAME_S
from skinsource.design.edits.edit import Edit, Refusal, change_inputs, change_view, listed, refusing


@refusing
def select_outputs(design: Design, view: View, outputs: Iterable[int]) -> Edit | Refusal:
    """Select outputs in this order; an empty selection is allowed.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.select_outputs(design, ss.View(), [29, 30])
    >>> print(edit.view.outputs)
    (29, 30)
    """
    chosen = listed(outputs)
    what = f"output {chosen[0]}" if len(chosen) == 1 else f"{len(chosen) or 'no'} outputs"
    return change_view(design, view, f"Select {what}", outputs=chosen)


_TAKEN = Refusal(sentence="A marker is there already; move or rename that one.")
_NO_MARKER = Refusal(sentence="That marker is no longer there; choose another one.")


@refusing
def add_marker(design: Design, view: View, time_s: float, name: str = "") -> Edit | Refusal:
    """Add a marker at a time.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.add_marker(design, ss.View(), 0.1, "touch")
    >>> print(edit.design.markers)
    (Marker(time_s=0.1, name='touch'),)
    """
    if len(design.markers) >= MAX_MARKERS:
        return Refusal(sentence=f"A design holds at most {MAX_MARKERS} markers; remove one first.")
    if any(abs(marker.time_s - time_s) < SAME_S for marker in design.markers):
        return _TAKEN
    new = Marker(time_s=time_s, name=name)
    after = replace(design, markers=(*design.markers, new))
    return Edit(label="Add marker", design=after, view=view)


@refusing
def move_marker(design: Design, view: View, index: int, time_s: float) -> Edit | Refusal:
    """Move the ``index``-th marker of the design to another time.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> marked = ss.edits.add_marker(design, ss.View(), 0.1, "touch").design
    >>> edit = ss.edits.move_marker(marked, ss.View(), 0, 0.2)
    >>> print(edit.design.markers[0].time_s)
    0.2
    """
    others = (marker for k, marker in enumerate(design.markers) if k != index)
    if any(abs(marker.time_s - time_s) < SAME_S for marker in others):
        return _TAKEN
    return _with_marker(design, view, "Move marker", index, {"time_s": time_s})


@refusing
def rename_marker(design: Design, view: View, index: int, name: str) -> Edit | Refusal:
    """Rename a marker.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> marked = ss.edits.add_marker(design, ss.View(), 0.1, "touch").design
    >>> edit = ss.edits.rename_marker(marked, ss.View(), 0, "release")
    >>> print(edit.design.markers[0].name)
    release
    """
    return _with_marker(design, view, "Rename marker", index, {"name": name})


@refusing
def remove_marker(design: Design, view: View, index: int) -> Edit | Refusal:
    """Remove a marker.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> marked = ss.edits.add_marker(design, ss.View(), 0.1, "touch").design
    >>> edit = ss.edits.remove_marker(marked, ss.View(), 0)
    >>> print(edit.design.markers)
    ()
    """
    return _with_marker(design, view, "Remove marker", index, None)


@refusing
def set_loop(design: Design, view: View, loop_s: tuple[float, float] | None) -> Edit | Refusal:
    """Set begin and end of the loop that is played again and again; None: no loop.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.set_loop(design, ss.View(), (0.0, 0.2))
    >>> print(edit.design.loop_s)
    (0.0, 0.2)
    """
    after = replace(design, loop_s=loop_s)
    return Edit(label="Remove loop" if loop_s is None else "Set loop", design=after, view=view)


@refusing
def set_gain_curve(
    design: Design, view: View, id: int, points: tuple[tuple[float, float], ...]
) -> Edit | Refusal:
    """Set the gain curve of a track, breakpoints of s and factor; empty: no curve.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.set_gain_curve(design, ss.View(), 1, ((0.0, 0.0), (0.2, 1.0)))
    >>> print(edit.design.inputs[0].gain_curve)
    ((0.0, 0.0), (0.2, 1.0))
    """
    return change_inputs(design, view, "Change gain curve of", {id: {"gain_curve": points}})


def _with_marker(
    design: Design, view: View, label: str, index: int, changes: dict[str, Any] | None
) -> Edit | Refusal:
    """Return the edit that changes a marker; None: that removes it."""
    if index not in range(len(design.markers)):
        return _NO_MARKER
    changed = () if changes is None else (replace(design.markers[index], **changes),)
    markers = (*design.markers[:index], *changed, *design.markers[index + 1 :])
    return Edit(label=label, design=replace(design, markers=markers), view=view)


_NO_SNAPSHOT = Refusal(
    sentence="Nothing is stored to compare with; store a snapshot with Ctrl+Shift+1 to 4."
)

_REMOVE_ONE = "Remove one first: press Delete on its card in the Compare panel."


@refusing
def store_snapshot(design: Design, view: View, number: int) -> Edit | Refusal:
    """Store the design under a number, in place of the snapshot that has it.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.store_snapshot(design, ss.View(), 1)
    >>> print([snapshot.number for snapshot in edit.view.snapshots])
    [1]
    """
    if number not in NUMBERS:
        return Refusal(
            sentence=f"No snapshot has the number {quoted(number)}; choose {NUMBERS[0]} to "
            f"{NUMBERS[-1]}."
        )
    # The gain keeps the design in the window as loud as it is.
    new = Snapshot(number=number, design=design, gain=view.match_gain(design))
    snapshots = (*_without(view, number), new)
    return change_view(design, view, f"Store snapshot {number}", snapshots=snapshots)


@refusing
def take_snapshot(design: Design, view: View, other: Design) -> Edit | Refusal:
    """Store another design, such as one of a file, under the lowest free number.

    Examples
    --------
    >>> from dataclasses import replace
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.take_snapshot(design, ss.View(), replace(design, inputs=()))
    >>> print([snapshot.number for snapshot in edit.view.snapshots])
    [1]
    """
    if (free := _free_number(view)) is None:
        return Refusal(sentence=f"All {len(NUMBERS)} snapshots are in use. {_REMOVE_ONE}")
    snapshots = (*view.snapshots, Snapshot(number=free, design=other))
    return change_view(design, view, f"Store snapshot {free}", snapshots=snapshots)


@refusing
def show_snapshot(design: Design, view: View, number: int, gain: float = 1.0) -> Edit | Refusal:
    """Replace the design by a snapshot as it was stored; the view shows it with ``gain``.

    A design that is no snapshot is stored under the number 0, so that the user can go back to it.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> stored = ss.edits.store_snapshot(design, ss.View(), 1)
    >>> edit = ss.edits.show_snapshot(stored.design, stored.view, 1)
    >>> print(edit.label)
    Show snapshot 1
    """
    chosen = next((snapshot for snapshot in view.snapshots if snapshot.number == number), None)
    if chosen is None:
        return _NO_SNAPSHOT
    snapshots = view.snapshots
    if shown_snapshot(snapshots, design) is None:
        if number == EDITED:
            return Refusal(
                sentence="The earlier edits would replace a design that is not stored; store it "
                "first."
            )
        snapshots = (*_without(view, EDITED), Snapshot(number=EDITED, design=design))
    others = (snapshot for snapshot in snapshots if snapshot.number != number)
    after = replace(view, snapshots=(*others, replace(chosen, gain=gain)))
    return Edit(label=f"Show {snapshot_name(number)}", design=chosen.design, view=after)


@refusing
def keep_match_gain(design: Design, view: View) -> Edit | Refusal:
    """Multiply the amplitudes by the gain with which the design is shown to match another one.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> stored = ss.edits.store_snapshot(design, ss.View(), 1)
    >>> quiet = ss.edits.match_levels(stored.design, stored.view, True)
    >>> quiet = ss.edits.show_snapshot(quiet.design, quiet.view, 1, gain=0.5)
    >>> edit = ss.edits.keep_match_gain(quiet.design, quiet.view)
    >>> print([track.amplitude for track in edit.design.inputs])
    [0.5, 0.5]
    """
    gain = view.match_gain(design)
    if gain == 1.0:
        return Refusal(sentence="The design is shown with its own amplitudes; match levels first.")
    by = gain_text(gain) or "the match gain"
    said = f"Amplitudes changed by {by}"
    return Edit(label=f"Apply {by}", design=louder(design, gain), view=view, said=said)


@refusing
def change_texts(design: Design, view: View, **texts: Any) -> Edit | Refusal:
    """Change title or notes of the design, and of the snapshots that have none.

    While a snapshot is shown, all that have the same text as it follow.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(change_texts(ss.Design(limb="synthetic-1"), ss.View(), title="Soft").design.title)
    Soft
    """
    is_shown = shown_snapshot(view.snapshots, design) is not None

    def with_texts(other: Design) -> Design:
        following = {
            name: text
            for name, text in texts.items()
            if not getattr(other, name)
            or (is_shown and getattr(other, name) == getattr(design, name))
        }
        return replace(other, **following)

    snapshots = tuple(replace(each, design=with_texts(each.design)) for each in view.snapshots)
    return Edit(
        label=f"Change {' and '.join(texts)}",
        design=replace(design, **texts),
        view=replace(view, snapshots=snapshots),
    )


@refusing
def rename_snapshot(design: Design, view: View, number: int, title: str) -> Edit | Refusal:
    """Give a snapshot a title of its own; "": it is called as its design.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1")
    >>> stored = ss.edits.store_snapshot(design, ss.View(), 1)
    >>> edit = rename_snapshot(stored.design, stored.view, 1, "Soft")
    >>> print(edit.view.snapshots[0].title, edit.design == design)
    Soft True
    """
    snapshots = tuple(
        replace(each, title=title.strip()) if each.number == number else each
        for each in view.snapshots
    )
    return change_view(design, view, f"Rename {snapshot_name(number)}", snapshots=snapshots)


@refusing
def forget_snapshot(design: Design, view: View, number: int) -> Edit | Refusal:
    """Remove the snapshot with a number; if it is shown, the working design is shown again.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> stored = ss.edits.store_snapshot(design, ss.View(), 1)
    >>> edit = ss.edits.forget_snapshot(stored.design, stored.view, 1)
    >>> print(edit.view.snapshots)
    ()
    """
    remaining = _without(view, number)
    if len(remaining) == len(view.snapshots):
        return _NO_SNAPSHOT
    if shown_snapshot(view.snapshots, design) and not shown_snapshot(remaining, design):
        design = next((each.design for each in remaining if each.number == EDITED), design)
    return change_view(design, view, f"Remove {snapshot_name(number)}", snapshots=remaining)


def with_working_kept(design: Design, view: View, edit: Edit) -> Edit | Refusal:
    """Return an edit of a shown snapshot that keeps the working design, which it would replace.

    That becomes the snapshot of the lowest free number, unless another one holds it.
    """
    working = next((each for each in view.snapshots if each.number == EDITED), None)
    if working is None or shown_snapshot(edit.view.snapshots, edit.design):
        return edit
    others = _without(edit.view, EDITED)
    if shown_snapshot(others, working.design) or not stored_name(view.snapshots, design):
        return replace(edit, view=replace(edit.view, snapshots=others))
    if (free := _free_number(edit.view)) is None:
        return Refusal(
            sentence="An edit of this snapshot would replace the working design, and all "
            f"{len(NUMBERS)} snapshots are in use. {_REMOVE_ONE}"
        )
    # Shown before all others: the one that was shown last stays the last.
    snapshots = (replace(working, number=free), *others)
    said = f"The working design is kept as snapshot {free}. {edit.said}".strip()
    return replace(edit, view=replace(edit.view, snapshots=snapshots), said=said)


@refusing
def match_levels(design: Design, view: View, on: bool) -> Edit | Refusal:
    """Show snapshots at matched levels, or as loud as they were stored.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> stored = ss.edits.store_snapshot(design, ss.View(), 1)
    >>> edit = ss.edits.match_levels(stored.design, stored.view, True)
    >>> print(edit.view.levels_matched)
    True
    """
    return change_view(design, view, "Match levels", levels_matched=on)


def _free_number(view: View) -> int | None:
    used = {snapshot.number for snapshot in view.snapshots}
    return next((number for number in NUMBERS if number not in used), None)


def _without(view: View, number: int) -> tuple[Snapshot, ...]:
    return tuple(snapshot for snapshot in view.snapshots if snapshot.number != number)
