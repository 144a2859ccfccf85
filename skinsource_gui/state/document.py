"""The open design, its history, and the view on it."""

from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from skinsource.design import Design
from skinsource.view import View

#: Steps that can be undone; older ones are forgotten.
MOST_STEPS = 1000


class Document(QObject):
    """Holds one immutable design and one immutable view.

    Every edit of the design swaps it for another, undoably.  The view is saved with the design,
    but never undone.
    """

    changed = Signal()
    #: The path, or whether there is something unsaved, has changed.
    title_changed = Signal()

    def __init__(self, design: Design, view: View | None = None, parent: QObject | None = None):
        super().__init__(parent)
        self._design = design
        self._view = _fitted(view or View(), design)
        self._path: Path | None = None
        self.undo_stack = QUndoStack(self)
        self.undo_stack.setUndoLimit(MOST_STEPS)
        self.undo_stack.cleanChanged.connect(self.title_changed)

    @property
    def design(self) -> Design:
        """The design as it is now."""
        return self._design

    @property
    def view(self) -> View:
        """What is looked at now."""
        return self._view

    @property
    def path(self) -> Path | None:
        """The file it was opened from or saved to."""
        return self._path

    @property
    def modified(self) -> bool:
        """Whether there are edits that no file holds."""
        return not self.undo_stack.isClean()

    def edit(self, label: str, design: Design, gesture: int | None = None) -> None:
        """Replace the design.

        Edits of the same ``gesture`` (one drag of one handle) undo as one step.
        """
        if design != self._design:
            self.undo_stack.push(_Swap(self, label, design, gesture))

    def look(self, view: View) -> None:
        """Replace the view."""
        fitted = _fitted(view, self._design)
        if fitted != self._view:
            self._view = fitted
            self.changed.emit()

    def start_over(self, design: Design, view: View, path: Path | None) -> None:
        """Take over another design, with an empty history."""
        self.undo_stack.clear()
        self._design, self._view, self._path = design, _fitted(view, design), path
        self.changed.emit()
        self.title_changed.emit()

    def mark_saved(self, path: Path) -> None:
        """Note that ``path`` holds the present design."""
        self._path = path
        self.undo_stack.setClean()
        self.title_changed.emit()

    def show_design(self, design: Design, *, again: bool) -> None:
        """Put ``design`` in place of the present one; for undo steps only.

        ``again``: an undo or redo, which selects the input that it changes.
        """
        view = _pointing_at_change(self._view, self._design, design) if again else self._view
        self._design = design
        self._view = _fitted(view, design)
        self.changed.emit()


class _Swap(QUndoCommand):
    """The only undo command there is: put that design in place of this one."""

    def __init__(self, document: Document, label: str, after: Design, gesture: int | None):
        super().__init__(label)
        self._document = document
        self._before, self._after = document.design, after
        self._gesture = -1 if gesture is None else gesture
        self._done_before = False

    def redo(self) -> None:
        self._document.show_design(self._after, again=self._done_before)
        self._done_before = True

    def undo(self) -> None:
        self._document.show_design(self._before, again=True)

    def id(self) -> int:
        return self._gesture

    def mergeWith(self, newer: QUndoCommand) -> bool:
        if not isinstance(newer, _Swap):
            return False
        self._after = newer._after
        self.setObsolete(self._after == self._before)
        return True


def _pointing_at_change(view: View, before: Design, after: Design) -> View:
    """Return ``view`` with the input selected that differs, or else the same one as before."""
    known = {one.colour: one for one in before.inputs}
    came = [k for k, one in enumerate(after.inputs) if one.colour not in known]
    other = [k for k, one in enumerate(after.inputs) if known.get(one.colour, one) != one]
    if came or other:
        return replace(view, selected_input=(came or other)[0])
    if view.selected_input is None:
        return view
    # Inputs went: the same one stays selected, or else its successor.
    colour = before.inputs[view.selected_input].colour
    same = [k for k, one in enumerate(after.inputs) if one.colour == colour]
    return replace(view, selected_input=same[0] if same else view.selected_input)


def _fitted(view: View, design: Design) -> View:
    """Return ``view`` with a selected input that exists."""
    selected, count = view.selected_input, len(design.inputs)
    if selected is not None and selected >= count:
        return replace(view, selected_input=count - 1 if count else None)
    return view
