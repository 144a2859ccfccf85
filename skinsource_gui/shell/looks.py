"""What is done to the view alone."""

from dataclasses import replace

from PySide6.QtCore import QObject

from skinsource.quantities import PRE_TRIGGER_DELAY_S
from skinsource_gui.state.document import Document


class Looks(QObject):
    """Changes what is looked at in ``document``."""

    def __init__(self, document: Document) -> None:
        super().__init__(document)
        self._document = document

    def toggle_delay(self) -> None:
        """Show time axes with the pre-trigger delay, or without."""
        view = self._document.view
        shown, removed = view.time_range_s, not view.delay_removed
        if shown is not None:
            # The same piece of the curves stays in sight.
            shift_s = -PRE_TRIGGER_DELAY_S if removed else PRE_TRIGGER_DELAY_S
            shown = (shown[0] + shift_s, shown[1] + shift_s)
        self._document.look(replace(view, delay_removed=removed, time_range_s=shown))
