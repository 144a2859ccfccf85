"""Which input the mouse points at on the hand."""

from PySide6.QtCore import QObject, Signal

from skinsource.design.design import Design
from skinsource_gui.panels.hand.hand_stage import HandStage


class Pointing(QObject):
    """Follows the mouse over a hand.

    Attributes
    ----------
    design
        Whose inputs there are.
    """

    #: Id of the input that is pointed at, or None.
    pointed_at = Signal(object)

    def __init__(self, stage: HandStage) -> None:
        super().__init__(stage)
        self._stage = stage
        self._pointed_at: int | None = None
        # Id of the input that is pointed at elsewhere, or None.
        self._elsewhere: int | None = None
        self.design: Design | None = None
        stage.changed.connect(self._follow)

    def show(self, input_id: int | None) -> None:
        """Mark the place of an input that is pointed at elsewhere."""
        self._elsewhere = input_id
        found = () if self.design is None else self.design.inputs
        site = next((one.location for one in found if one.id == input_id), None)
        self._stage.change(target=site)

    def show_design(self, design: Design) -> None:
        """Take another design: what is pointed at elsewhere may stand at another place in it."""
        self.design = design
        if self._elsewhere is not None and self._stage.state.moving is None:
            self.show(self._elsewhere)

    def _follow(self) -> None:
        state = self._stage.state
        index = None if state.hovered is None else state.front_at(state.hovered)
        ids = () if self.design is None else self.design.ids
        # What is held may have gone.
        found = ids[index] if index is not None and index < len(ids) else None
        if found != self._pointed_at:
            self._pointed_at = found
            self.pointed_at.emit(found)
