"""Where a step of the history begins or ends."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from time import time
from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from skinsource.design.comparing import brought_back
from skinsource.design.design import Design
from skinsource.design.edits.edit import Edit, Refusal, kept_selection
from skinsource.design.view import View
from skinsource.limbs.own_limbs import axes_on, missing_limb, outputs_on
from skinsource_gui.state.history import MOST_STEPS


class HistoryState:
    """A design and a view, of which the history keeps selections and snapshots."""

    def __init__(self, design: Design, view: View):
        self.design, self.view = design, view

    def is_same(self, other: "HistoryState") -> bool:
        """Whether the history need not tell them apart: going on to ``other`` loses nothing."""
        mine, theirs = self.view, other.view
        same = mine.outputs == theirs.outputs and self.design == other.design
        if not same:
            return False
        # How loud one was shown last is nothing that could be lost.
        designs = {snapshot.number: snapshot.design for snapshot in theirs.snapshots}
        return all(designs.get(snapshot.number) == snapshot.design for snapshot in mine.snapshots)

    def is_before(self, other: "HistoryState") -> bool:
        """Whether ``other`` goes on from this one, with the same inputs and clips selected."""
        return (
            self.design is other.design
            and self.view.selected_inputs == other.view.selected_inputs
            and self.view.selected_clips == other.view.selected_clips
        )

    def seen_as(self, view: View, other: "HistoryState") -> View:
        """Return ``view`` with the inputs, clips and outputs that were selected then.

        It has the snapshots as they were then where they differ from those of the ``other`` end of
        the step, and all others as they are now.
        """
        return replace(
            view,
            outputs=self.view.outputs,
            selected_inputs=self.view.selected_inputs,
            selected_clips=self.view.selected_clips,
            snapshots=brought_back(self.view.snapshots, other.view.snapshots, view.snapshots),
        )


# The open design, its history, and the view on it.

# Gestures count from 1, and -1 tells Qt that a step joins no other.
_NO_GESTURE = -1


class Document(QObject):
    """Holds one immutable design and one immutable view.

    Edits swap both at once.  A step of the history brings back the design, the selected outputs,
    inputs and clips, and those snapshots that it replaced or forgot; what else the view holds is
    only looked at, and never undone.  To keep one more snapshot is no step: nothing is lost by it,
    and none is lost by what is undone later.
    """

    changed = Signal()
    #: An edit or a look is done, and everybody was told.
    settled = Signal()
    #: The playhead alone has moved; then `changed` is not emitted.
    playhead_moved = Signal()
    #: What comes does not go on from what was: a step was taken back or done again, or another file
    #: is open.  Emitted before `changed`.
    jumped = Signal()
    #: The path, or whether there is something unsaved, has changed.
    title_changed = Signal()
    #: Why an edit was not made, in one sentence.
    refused = Signal(str)
    #: What an edit that was made says of itself.
    told = Signal(str)

    def __init__(self, design: Design, view: View | None = None, parent: QObject | None = None):
        super().__init__(parent)
        self._design = self._saved = design
        self._view = _existing(view or View(), design)
        self._path: Path | None = None
        #: The file that the history begins with; None: it began with a new design.
        self.opened: Path | None = None
        #: What it is called among the scenes it was opened from; "": it is none of them.
        self.scene = ""
        #: The file whose unsaved work was left over and is open now, until it is saved; else None.
        self.recovered_from: Path | None = None
        self._saved_view = self._view
        self._was_modified = self._lost = self._read_only = self._on_the_way = False
        self._as_stored = False
        # Whether something else than what was saved has been made since, and not taken back.
        self._made = False
        self.undo_stack = QUndoStack(self)
        self.undo_stack.setUndoLimit(MOST_STEPS)
        self.undo_stack.cleanChanged.connect(self._tell_title)

    @property
    def design(self) -> Design:
        """The design as it is now."""
        return self._design

    @property
    def view(self) -> View:
        """What is looked at now."""
        return self._view

    @property
    def seen(self) -> View:
        """What panels show: the view, and no matched levels where they were `as_stored`."""
        return replace(self._view, levels_matched=False) if self._as_stored else self._view

    @contextmanager
    def as_stored(self) -> Iterator[None]:
        """Let panels show snapshots as loud as they were stored; what is played stays as it is."""
        if self._as_stored or not self._view.levels_matched:
            yield
            return
        self._as_stored = True
        self.changed.emit()
        try:
            yield
        finally:
            self._as_stored = False
            self.changed.emit()

    @property
    def path(self) -> Path | None:
        """The file it was opened from or saved to."""
        return self._path

    @property
    def read_only(self) -> bool:
        """Whether another studio has that file."""
        return self._read_only

    @property
    def modified(self) -> bool:
        """Whether there are edits, or snapshots, that no file holds; choosing outputs is none."""
        if self._lost or not _holds_snapshots(self._saved, self._saved_view, self._view):
            return True
        if self.undo_stack.isClean():
            return False
        # What was made and removed by hand is in no file; a new design without it is no proof.
        if self._made and self._path is None:
            return True
        return self._design != self._saved

    def apply(self, outcome: Edit | Refusal, gesture: int | None = None) -> None:
        """Take over what an edit leads to, or tell why there was none.

        Edits of the same ``gesture`` (one drag of one handle) undo as one step; whoever selects
        something else ends the gesture.
        """
        if isinstance(outcome, Refusal):
            self.refused.emit(outcome.sentence)
            return
        if outcome.design != self._design and _same_limb(outcome.design, self._design):
            missing = missing_limb(self._design.limb, self._design.limb_digest)
            if missing:
                self.refused.emit(f"This design is read-only. {missing}")
                return
        view = kept_selection(outcome.view, self._design, outcome.design)
        before, after = HistoryState(self._design, self._view), HistoryState(outcome.design, view)
        if before.is_same(after):
            self.look(view)
        else:
            self.undo_stack.push(ReplaceDesign(self, outcome.label, before, after, gesture))
            self.settled.emit()
        if outcome.said:
            self.told.emit(outcome.said)

    def edit(self, label: str, design: Design, gesture: int | None = None) -> None:
        """Replace the design, as `apply` does."""
        self.apply(Edit(label=label, design=design, view=self._view), gesture)

    def look(self, view: View) -> None:
        """Replace the view."""
        snapshots = self._view.snapshots
        self._show(self._design, view)
        if self._view.snapshots is not snapshots:
            self._tell_title()
        self.settled.emit()

    def start_over(
        self,
        design: Design,
        view: View,
        path: Path | None,
        *,
        read_only: bool = False,
        scene: str = "",
        recovered_from: Path | None = None,
    ) -> None:
        """Take over another design, with an empty history.

        A file that is ``read_only`` is another studio's: this one may not replace it.  ``scene`` is
        what the design is called among the scenes it was opened from; ``recovered_from`` is the
        file that it is left-over work on.
        """
        self.undo_stack.clear()
        self._read_only = read_only
        self._saved, self._path, self.opened, self.scene = design, path, path, scene
        self.recovered_from = recovered_from
        self._design, self._view = design, _existing(view, design)
        self._saved_view = self._view
        self._made = False
        self.jumped.emit()
        self.changed.emit()
        self._was_modified = self._lost = False
        self.title_changed.emit()

    def mark_saved(self, path: Path | None) -> None:
        """Note that ``path`` holds the present design; None: no file shall, nothing is unsaved."""
        self._path, self._saved, self._read_only = path, self._design, False
        self.recovered_from = None
        self._saved_view = self._view
        self.undo_stack.setClean()
        self._was_modified = self._lost = self._made = False
        self.title_changed.emit()

    def mark_lost(self) -> None:
        """Note that the file is gone: nothing holds the design but this document."""
        self._lost = True
        self._tell_title()

    def go_to(self, count: int) -> None:
        """Take back, or do again, until ``count`` steps are done; tells once."""
        before = self._design, self._view
        self._on_the_way = True
        try:
            self.undo_stack.setIndex(min(max(count, 0), self.undo_stack.count()))
        finally:
            self._on_the_way = False
        if before != (self._design, self._view):
            self.changed.emit()
        self._tell_title()

    def show_step(self, design: Design, view: View) -> None:
        """Put these in place of the present ones; for steps of the history only."""
        self._made = self._made or design != self._saved
        self._show(design, view)
        self._tell_title()

    def _show(self, design: Design, view: View) -> None:
        view = _existing(view, design)
        if (design, view) != (self._design, self._view):
            alone = design is self._design and _same_but_for_playhead(view, self._view)
            self._design, self._view = design, view
            if not self._on_the_way:
                (self.playhead_moved if alone else self.changed).emit()

    def _tell_title(self, clean: bool = False) -> None:
        # Said by the history; while a step is done, it does not know yet what it will be.
        self._made = self._made and not clean
        if self._on_the_way:
            return
        if self.modified != self._was_modified:
            self._was_modified = self.modified
            self.title_changed.emit()


class ReplaceDesign(QUndoCommand):
    """The only undo command there is: put that design in place of this one."""

    def __init__(
        self,
        document: Document,
        label: str,
        before: HistoryState,
        after: HistoryState,
        gesture: int | None,
    ):
        super().__init__(label)
        self._document = document
        self._before, self._after = before, after
        self._done_before = False
        self._gesture = _NO_GESTURE if gesture is None else gesture
        self.at_s = time()

    def redo(self) -> None:
        step = self._after
        # The first time, all of the view is new.
        view = step.view
        if self._done_before:
            view = step.seen_as(self._document.view, self._before)
            self._document.jumped.emit()
        self._done_before = True
        self._document.show_step(step.design, view)

    def undo(self) -> None:
        step = self._before
        self._document.jumped.emit()
        view = step.seen_as(self._document.view, self._after)
        self._document.show_step(step.design, view)

    def id(self) -> int:
        return self._gesture

    def mergeWith(self, newer: QUndoCommand) -> bool:
        if not isinstance(newer, ReplaceDesign) or not self._after.is_before(newer._before):
            return False
        self._after, self.at_s = newer._after, newer.at_s
        self.setText(newer.text())
        self.setObsolete(self._before.is_same(self._after))
        return True


def _same_but_for_playhead(view: View, other: View) -> bool:
    return replace(view, playhead_s=other.playhead_s) == other


def _holds_snapshots(saved: Design, saved_view: View, view: View) -> bool:
    """Whether what was saved holds the snapshots of ``view``, and ``view`` all that were saved.

    One more of a design that was saved is nothing that could be lost.
    """
    if view.snapshots == saved_view.snapshots:
        return True
    then = {snapshot.number: snapshot.design for snapshot in saved_view.snapshots}
    now = {snapshot.number: snapshot.design for snapshot in view.snapshots}
    if any(now.get(number) != design for number, design in then.items()):
        return False
    held = (saved, *then.values())
    return all(design in held for number, design in now.items() if number not in then)


def _existing(view: View, design: Design) -> View:
    """Return ``view`` with those selected inputs, clips, outputs and axes that exist."""
    chosen = tuple(track_id for track_id in view.selected_inputs if track_id in design.ids)
    clip_ids = {clip.id for clip in design.clips} if view.selected_clips else set()
    clips = tuple(clip_id for clip_id in view.selected_clips if clip_id in clip_ids)
    outputs = outputs_on(design.limb, view.outputs)
    existing: dict[str, Any] = {
        "selected_inputs": chosen,
        "selected_clips": clips,
        "outputs": outputs,
        "axes": axes_on(design.limb, view.axes),
    }
    if all(getattr(view, name) == value for name, value in existing.items()):
        return view
    return replace(view, **existing)


def _same_limb(design: Design, other: Design) -> bool:
    return (design.limb, design.limb_digest) == (other.limb, other.limb_digest)
