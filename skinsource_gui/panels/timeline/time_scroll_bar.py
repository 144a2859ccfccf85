"""A scroll bar over the time."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QScrollBar, QWidget

from skinsource_gui.widgets.time.time_scale import Range

_STEPS_PER_S = 10_000


class TimeBar(QScrollBar):
    """Shows which part of the time is seen; hidden where it is all."""

    #: The part to see.
    range_wanted = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self.setObjectName("time_bar")
        self.setAccessibleName("Time shown")
        self._shown_s: Range = (0.0, 1.0)
        self._taking = False
        self.valueChanged.connect(self._tell)
        self.hide()

    def show_range(self, shown_s: Range, whole_s: Range) -> None:
        """Show a part of the whole."""
        self._taking, self._shown_s = True, shown_s
        length = round((shown_s[1] - shown_s[0]) * _STEPS_PER_S)
        whole = round((whole_s[1] - whole_s[0]) * _STEPS_PER_S)
        self.setRange(0, max(whole - length, 0))
        self.setPageStep(max(length, 1))
        self.setSingleStep(max(length // 10, 1))
        self.setValue(round((shown_s[0] - whole_s[0]) * _STEPS_PER_S))
        self.setVisible(whole > length)
        self._taking = False

    def _tell(self, value: int) -> None:
        if not self._taking:
            length = self._shown_s[1] - self._shown_s[0]
            start = value / _STEPS_PER_S
            self.range_wanted.emit((start, start + length))
