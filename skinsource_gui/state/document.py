"""The open design, the view on it, and their history."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from time import time
from typing import Any

from PySide6 import QtGui
from PySide6.QtCore import QObject, Signal

from skinsource.design.comparing import restored_snapshots
from skinsource.design.design import Design, View
from skinsource.design.edits.edit import Edit, Refusal, kept_selection
from skinsource.design.edits.motions import with_whole_motions
from skinsource.design.edits.view import with_working_kept
from skinsource.limbs.own_limbs import axes_on, missing_limb, outputs_on

#: So many can be taken back; the oldest ones are forgotten first.
MOST_STEPS = 1000


class HistoryState:
    """A design and a view, whose selections and snapshots the history brings back."""

    def __init__(self, design: Design, view: View):
        self.design, self.view = design, view

    def is_same(self, other: "HistoryState") -> bool:
        """Return whether a step to ``other`` would lose nothing, so that none is needed."""
        mine, theirs = self.view, other.view
        same = mine.outputs == theirs.outputs and self.design == other.design
        # The gain with which a snapshot was shown last is no loss.
        return same and _stored_in(mine).items() <= _stored_in(theirs).items()

    def is_before(self, other: "HistoryState") -> bool:
        """Return whether ``other`` continues this state with the same inputs and clips."""
        return (
            self.design is other.design
            and self.view.selected_inputs == other.view.selected_inputs
            and self.view.selected_clips == other.view.selected_clips
        )

    def shown_with(self, view: View, other: "HistoryState") -> View:
        """Return ``view`` with the inputs, clips and outputs that were selected in this state.

        Snapshots that differ from those at the ``other`` end of the step are taken from this state,
        the others from ``view``.
        """
        return replace(
            view,
            outputs=self.view.outputs,
            selected_inputs=self.view.selected_inputs,
            selected_clips=self.view.selected_clips,
            snapshots=restored_snapshots(self.view.snapshots, other.view.snapshots, view.snapshots),
        )


# Gestures count from 1, and -1 tells Qt that a step joins no other.
_SINGLE_STEP = -1


#: The view of a new design: time begins at the pulse of the measurement, and waves run as slowly
#: as they can be followed.
NEW_VIEW = View(delay_removed=True, slow_motion=0.0)


class Document(QObject):
    """Holds one immutable design and one immutable view.

    Edits swap both at once.  A step of the history brings back the design, the selected outputs,
    inputs and clips, and those snapshots that it replaced or forgot; the rest of the view
    is never undone.  To store one more snapshot is no step: nothing is lost by it, and undoing
    later steps does not remove it.
    """

    changed = Signal()
    #: An edit or a change of the view is done, after `changed` was emitted.
    settled = Signal()
    #: The playhead alone has moved; then `changed` is not emitted.
    playhead_moved = Signal()
    #: A step was undone or redone, or another file is open: the next state does not continue the
    #: last one.  Emitted before `changed`.
    jumped = Signal()
    #: The path, or `modified`, has changed.
    title_changed = Signal()
    #: Why an edit was not made, in one sentence.
    refused = Signal(str)
    #: A message of an edit that was made.
    message = Signal(str)

    def __init__(self, design: Design, view: View | None = None, parent: QObject | None = None):
        super().__init__(parent)
        #: The present design and view.
        self.design = self._saved = design
        self.view = _existing(view or NEW_VIEW, design)
        #: The file it was opened from or saved to, and whether another studio has locked that.
        self.path: Path | None = None
        self.read_only = False
        #: The file that the history begins with; None: it began with a new design.
        self.opened: Path | None = None
        #: Whether the history begins with recovered work.
        self.recovered = False
        #: Name of the scene; "" where it is none.
        self.scene = ""
        #: The file whose recovered work is open, until it is saved; else None.
        self.recovered_from: Path | None = None
        self._saved_view = self.view
        self._was_modified = self._lost = self._jumping = False
        self._as_stored = False
        # Whether the design was edited since it was saved, and the edit not undone.
        self._edited = False
        self.undo_stack = QtGui.QUndoStack(self)
        self.undo_stack.setUndoLimit(MOST_STEPS)
        self.undo_stack.cleanChanged.connect(self._emit_title)

    @property
    def shown_view(self) -> View:
        """The view that panels show; inside `as_stored` without matched levels."""
        return replace(self.view, levels_matched=False) if self._as_stored else self.view

    @contextmanager
    def as_stored(self) -> Iterator[None]:
        """Have panels show snapshots as loud as they were stored; playback does not change."""
        if self._as_stored or not self.view.levels_matched:
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
    def modified(self) -> bool:
        """Whether there are edits or snapshots that no file holds; selections do not count."""
        if self._lost or not _has_saved_snapshots(self._saved, self._saved_view, self.view):
            return True
        if self.undo_stack.isClean():
            return False
        # A new design that was edited and is as at first counts as modified: no file holds it.
        return (self._edited and self.path is None) or not self.holds(self.design)

    def holds(self, design: Design) -> bool:
        """Return whether a design is the saved one, or one of the saved snapshots."""
        return design in (self._saved, *[each.design for each in self._saved_view.snapshots])

    def apply(self, outcome: Edit | Refusal, gesture: int | None = None) -> None:
        """Apply an edit, or emit why it was refused.

        Edits of the same ``gesture`` (one drag of one handle) undo as one step; another selection
        ends the gesture.
        """
        if isinstance(outcome, Edit):
            outcome = with_whole_motions(self.design, outcome)
            outcome = with_working_kept(self.design, self.view, outcome)
        if isinstance(outcome, Refusal):
            self.refused.emit(outcome.sentence)
            return
        if outcome.design != self.design and _same_limb(outcome.design, self.design):
            missing = missing_limb(self.design.limb, self.design.limb_digest)
            if missing:
                self.refused.emit(f"This design is read-only. {missing}")
                return
        view = kept_selection(outcome.view, self.design, outcome.design)
        before, after = HistoryState(self.design, self.view), HistoryState(outcome.design, view)
        if before.is_same(after):
            self.look(view)
        else:
            # A panel that is told may end what was being typed: that step comes after this one.
            self._jumping = True
            self.undo_stack.push(ReplaceDesign(self, outcome.label, before, after, gesture))
            self._jumping = False
            self.changed.emit()
            self._emit_title()
            self.settled.emit()
        if outcome.said:
            self.message.emit(outcome.said)

    def edit(self, label: str, design: Design, gesture: int | None = None) -> None:
        """Replace the design, as `apply` does."""
        self.apply(Edit(label=label, design=design, view=self.view), gesture)

    def amend(self, outcome: Edit) -> None:
        """Replace the present design, also in the history: it is no step of its own."""
        if outcome.design == self.design:
            return
        step, state = self.undo_stack.index(), HistoryState(outcome.design, outcome.view)
        for at, end in ((step - 1, "after"), (step, "before")):
            command = self.undo_stack.command(at)
            if isinstance(command, ReplaceDesign):
                setattr(command, end, state)
        self._show(outcome.design, outcome.view)
        self._emit_title()
        self.settled.emit()

    def look(self, view: View) -> None:
        """Replace the view."""
        snapshots = self.view.snapshots
        self._show(self.design, view)
        if self.view.snapshots is not snapshots:
            self._emit_title()
        self.settled.emit()

    def start_over(
        self,
        design: Design,
        view: View,
        path: Path | None,
        *,
        read_only: bool = False,
        scene: str = "",
    ) -> None:
        """Take over another design, with an empty history.

        A file that is ``read_only`` is another studio's: this one may not replace it.  ``scene`` is
        what the design is called among the scenes it was opened from.
        """
        self.undo_stack.clear()
        self.read_only = read_only
        self._saved, self.path, self.opened, self.scene = design, path, path, scene
        self.recovered_from = None
        self.design, self.view = design, _existing(view, design)
        self._saved_view = self.view
        self.recovered = self._edited = self._lost = False
        self.jumped.emit()
        self.changed.emit()
        self._was_modified = False
        self.title_changed.emit()

    def recover(self, design: Design, view: View, file: Path | None) -> None:
        """Take over left-over work on ``file``, if any; no file holds it until it is saved."""
        self.start_over(design, view, None)
        self.recovered, self.recovered_from = True, file
        self.mark_lost()

    def mark_saved(self, path: Path | None) -> None:
        """Note that ``path`` holds the present design; None: no file is needed."""
        self.path, self._saved, self.read_only = path, self.design, False
        self.recovered_from = None
        self._saved_view = self.view
        self.undo_stack.setClean()
        self._was_modified = self._lost = self._edited = False
        self.title_changed.emit()

    def mark_lost(self) -> None:
        """Note that no file holds the design, as where its file was lost."""
        self._lost = True
        self._emit_title()

    def go_to(self, count: int) -> None:
        """Undo or redo until ``count`` steps are done; `changed` is emitted once."""
        before = self.design, self.view
        self._jumping = True
        try:
            self.undo_stack.setIndex(min(max(count, 0), self.undo_stack.count()))
        finally:
            self._jumping = False
        if before != (self.design, self.view):
            self.changed.emit()
        self._emit_title()

    def show_step(self, design: Design, view: View) -> None:
        """Replace design and view; for steps of the history only."""
        self._edited = self._edited or not self.holds(design)
        self._show(design, view)
        self._emit_title()

    def _show(self, design: Design, view: View) -> None:
        view = _existing(view, design)
        if (design, view) != (self.design, self.view):
            looked = replace(self.view, playhead_s=view.playhead_s)
            alone = design is self.design and view == looked
            self.design, self.view = design, view
            if not self._jumping:
                (self.playhead_moved if alone else self.changed).emit()

    def _emit_title(self, clean: bool = False) -> None:
        # The history emits this before a step is complete.
        self._edited = self._edited and not clean
        if self._jumping:
            return
        if self.modified != self._was_modified:
            self._was_modified = self.modified
            self.title_changed.emit()


class ReplaceDesign(QtGui.QUndoCommand):
    """The only undo command: it replaces design and view."""

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
        self.before, self.after = before, after
        self._was_done = False
        self._gesture = _SINGLE_STEP if gesture is None else gesture
        self.at_s = time()

    def redo(self) -> None:
        step = self.after
        # The first time, the whole view of the step is shown.
        view = step.view
        if self._was_done:
            view = step.shown_with(self._document.view, self.before)
            self._document.jumped.emit()
        self._was_done = True
        self._document.show_step(step.design, view)

    def undo(self) -> None:
        step = self.before
        self._document.jumped.emit()
        view = step.shown_with(self._document.view, self.after)
        self._document.show_step(step.design, view)

    def id(self) -> int:
        return self._gesture

    def mergeWith(self, newer: QtGui.QUndoCommand) -> bool:
        if not isinstance(newer, ReplaceDesign) or not self.after.is_before(newer.before):
            return False
        self.after, self.at_s = newer.after, newer.at_s
        self.setText(newer.text())
        self.setObsolete(self.before.is_same(self.after))
        return True


def _has_saved_snapshots(saved: Design, saved_view: View, view: View) -> bool:
    """Return whether the saved designs are the snapshots of ``view``, so that none can be lost.

    A further snapshot of a design that was saved does not count.
    """
    if view.snapshots == saved_view.snapshots:
        return True
    then, now = _stored_in(saved_view), _stored_in(view)
    held = ("", saved), *then.values()
    return then.items() <= now.items() and all(stored in held for stored in now.values())


def _stored_in(view: View) -> dict[int, tuple[str, Design]]:
    """Return what a view has stored by number: all of a snapshot but its gain."""
    return {each.number: (each.title, each.design) for each in view.snapshots}


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
