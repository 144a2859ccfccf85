"""Which inputs the list selects."""

from PySide6.QtCore import QObject, Signal

from skinsource.design import edits
from skinsource.design.design import Design
from skinsource.design.view import View


class ListSelection(QObject):
    """Turns what rows, keys and mouse tell into other selections of inputs."""

    #: `Edit` or `Refusal`, None: no gesture.
    edited = Signal(object, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._design = Design(limb="")
        self._view = View()
        # Where a selection of all rows on the way began.
        self._anchor: int | None = None

    def show_state(self, design: Design, view: View) -> None:
        """Take over the present design and view."""
        self._design, self._view = design, view

    def enter(self, chosen: int) -> None:
        """Go to an input's number: one of several may be typed or dragged for all."""
        if chosen not in self._view.selected_inputs:
            self.select(chosen)

    def select(self, chosen: int) -> None:
        """Select this input alone."""
        self._anchor = chosen
        self._tell(edits.select_inputs(self._design, self._view, (chosen,)))

    def toggle(self, chosen: int) -> None:
        """Add this input, or take it out."""
        self._anchor = chosen
        self._tell(edits.toggle_selected(self._design, self._view, chosen))

    def select_through(self, chosen: int) -> None:
        """Select all from where it began to this input."""
        known = self._anchor in self._view.selected_inputs
        self._anchor = self._anchor if known else self._view.selected_input
        self._tell(edits.select_through(self._design, self._view, self._anchor, chosen))

    def select_all(self) -> None:
        """Select all inputs."""
        self._tell(edits.select_all_inputs(self._design, self._view))

    def go(self, place: int, extending: bool) -> None:
        """Select the input of this row, or with ``extending`` all on the way to it."""
        chosen = self._design.ids[place]
        (self.select_through if extending else self.select)(chosen)

    def _tell(self, outcome: edits.Edit | edits.Refusal) -> None:
        self.edited.emit(outcome, None)
