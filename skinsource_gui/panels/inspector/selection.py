"""The selected inputs, and what is done to them."""

from PySide6.QtCore import QObject, Signal

from skinsource.design import edits
from skinsource.design.design import Design, Input
from skinsource.design.edits import Edit, Refusal
from skinsource.design.view import View
from skinsource_gui.widgets.inputs.field_changes import FieldChanges


class Selection(QObject):
    """Knows the selected inputs and turns what fields and buttons tell into edits of them."""

    #: `Edit` or `Refusal`, number of the gesture or None.
    edited = Signal(object, object)
    #: Name of a field whose new value does not go with the others, and why.
    field_refused = Signal(str, str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._design = Design(limb="")
        self._view = View()
        self._changes = FieldChanges()

    @property
    def last(self) -> Input | None:
        """The input that was selected last."""
        if self._view.selected_input not in self._design.ids:
            return None
        return self._design.input(self._view.selected_input)

    @property
    def together(self) -> tuple[Input, ...]:
        """All selected inputs, in the order of the design."""
        return tuple(one for one in self._design.inputs if one.id in self._ids)

    def show_state(self, design: Design, view: View) -> None:
        """Take over the present design and view."""
        self._design, self._view = design, view

    def change_kind(self, _: str, kind: str, gesture: int | None) -> None:
        """Give all of them another kind of waveform."""
        self._tell(edits.change_kind(self._design, self._view, self._ids, kind), gesture)

    def change_place(self, _: str, number: str, gesture: int | None) -> None:
        """Move them to an input place."""
        self._tell(edits.move_inputs(self._design, self._view, self._ids, int(number)), gesture)

    def change_field(self, name: str, value: object, gesture: int | None) -> None:
        """Type or drag a field of theirs."""
        if self.last is None:
            return
        ids = self._ids
        changed = self._changes.change(
            self._design, self._view, ids, name, value, lead=ids[-1], gesture=gesture
        )
        if isinstance(changed, Refusal):
            self.field_refused.emit(name, changed.sentence)
        else:
            self._tell(changed, gesture)

    def toggle_mute(self) -> None:
        """Mute all, or none if all are."""
        self._tell(edits.toggle_mute(self._design, self._view, self._ids), None)

    def toggle_solo(self) -> None:
        """Make all solo, or none if all are."""
        self._tell(edits.toggle_solo(self._design, self._view, self._ids), None)

    @property
    def _ids(self) -> tuple[int, ...]:
        return self._view.selected_inputs

    def _tell(self, outcome: Edit | Refusal, gesture: int | None) -> None:
        # A field that is held while its input goes has nothing more to say.
        if self.last is not None and (
            isinstance(outcome, Refusal) or outcome.design != self._design
        ):
            self.edited.emit(outcome, gesture)
