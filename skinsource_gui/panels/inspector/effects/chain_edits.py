"""What is done to the chain of the clip that is shown."""

from collections.abc import Callable

from PySide6.QtCore import QObject, Signal

from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design
from skinsource.design.edits import Edit, Refusal
from skinsource.design.view import View


class ChainEdits(QObject):
    """Turns what rows and menu tell into edits of the clip."""

    #: `Edit` or `Refusal`, number of the gesture or None.
    edited = Signal(object, object)
    #: Place of an effect, name of a field whose new value is not allowed, and why.
    field_refused = Signal(int, str, str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._design, self._view = Design(limb=""), View()
        self._clip: Clip | None = None
        self._ids: tuple[int, ...] = ()

    def show_state(
        self, design: Design, view: View, clip: Clip | None, ids: tuple[int, ...]
    ) -> None:
        """Take over the state, the clip that is shown, and all that a new effect is added to."""
        self._design, self._view, self._clip, self._ids = design, view, clip, ids

    def add(self, kind: str) -> None:
        """Put an effect at the end of the chains of all selected clips."""
        self._tell(edits.add_effect(self._design, self._view, self._ids, kind))

    def remove(self, index: int) -> None:
        """Take an effect out."""
        self._of_clip(edits.remove_effect, index)

    def move(self, index: int, to: int) -> None:
        """Put an effect at another place."""
        self._of_clip(edits.move_effect, index, to)

    def switch(self, index: int, on: bool) -> None:
        """Switch an effect on or off."""
        self._of_clip(edits.switch_effect, index, on)

    def change_field(self, index: int, name: str, value: object, gesture: int | None) -> None:
        """Set a field of an effect."""
        if self._clip is None:
            return
        outcome = edits.change_effect_field(
            self._design, self._view, self._clip.id, index, name, value
        )
        if isinstance(outcome, Refusal):
            self.field_refused.emit(index, name, outcome.sentence)
        else:
            self._tell(outcome, gesture)

    def _of_clip(self, edit: Callable[..., Edit | Refusal], *given: object) -> None:
        if self._clip is not None:
            self._tell(edit(self._design, self._view, self._clip.id, *given))

    def _tell(self, outcome: Edit | Refusal, gesture: int | None = None) -> None:
        if isinstance(outcome, Refusal) or outcome.design != self._design:
            self.edited.emit(outcome, gesture)
