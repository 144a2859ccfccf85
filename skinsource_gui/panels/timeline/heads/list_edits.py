"""What the list does to inputs."""

from PySide6.QtCore import QObject, Signal

from skinsource.design import edits
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource_gui.widgets.inputs.field_changes import FieldChanges
from skinsource_gui.widgets.inputs.inputs_menu import InputEdit


class ListEdits(QObject):
    """Turns what rows, keys and mouse tell into edits of inputs.

    Where a control of a row tells it, ``one`` is the id of its input; where a key does, None.
    """

    #: `Edit` or `Refusal`, number of the gesture or None.
    edited = Signal(object, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._design = Design(limb="")
        self._view = View()
        self._changes = FieldChanges()

    def show_state(self, design: Design, view: View) -> None:
        """Take over the present design and view."""
        self._design, self._view = design, view

    def shift(self, down: bool) -> None:
        """Move the selected inputs past their neighbour."""
        ids = self._view.selected_inputs
        self._tell(edits.shift_inputs(self._design, self._view, ids, down))

    def put(self, gap: int) -> None:
        """Put the selected inputs into a gap between rows."""
        ids = self._view.selected_inputs
        self._tell(edits.put_inputs_before(self._design, self._view, ids, gap))

    def change_amplitude(self, one: int, value: float, gesture: int | None) -> None:
        """Type or drag an amplitude."""
        ids = self.together(one)
        changed = self._changes.change(
            self._design, self._view, ids, "amplitude", value, lead=one, gesture=gesture
        )
        self.edited.emit(changed, gesture)

    def toggle_mute(self, one: int | None = None) -> None:
        """Mute all, or none if all are."""
        self._tell(edits.toggle_mute(self._design, self._view, self.together(one)))

    def toggle_solo(self, one: int | None = None) -> None:
        """Make all solo, or none if all are."""
        self._tell(edits.toggle_solo(self._design, self._view, self.together(one)))

    def remove(self, one: int | None = None) -> None:
        """Remove the selected inputs; the cross of a row removes that row alone."""
        ids = self._view.selected_inputs if one is None else (one,)
        self._tell(edits.remove_inputs(self._design, self._view, ids))

    def edit(self, ids: tuple[int, ...], edit: InputEdit) -> None:
        """Do to these inputs what was chosen."""
        self._tell(edit(self._design, self._view, ids))

    def duplicate(self) -> None:
        """Duplicate the selected inputs."""
        ids = self._view.selected_inputs
        self._tell(edits.duplicate_inputs(self._design, self._view, ids))

    def together(self, one: int | None) -> tuple[int, ...]:
        """Whom a control of the row of ``one`` is about: all selected, if it is one of them."""
        selected = self._view.selected_inputs
        return selected if one is None or one in selected else (one,)

    def _tell(self, outcome: edits.Edit | edits.Refusal) -> None:
        self.edited.emit(outcome, None)
