"""What points at an input in one panel is seen in the others."""

from PySide6.QtCore import Signal

from skinsource_gui.widgets.pictures.pictured import Pictured


class PointsAtInputs(Pictured):
    """Tells which input is pointed at here, and shows which one is elsewhere."""

    #: Id of the input that is pointed at here, or None.
    input_pointed_at = Signal(object)

    def show_pointed_input(self, input_id: int | None) -> None:
        """Mark the input that is pointed at in another panel; None: none is."""
