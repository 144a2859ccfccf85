"""The way from a drawn waveform to the pen."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QPushButton, QWidget

from skinsource_gui.widgets.fields.edited_cell import LABEL_PX, LabelledCell
from skinsource_gui.widgets.tooltips import tooltip


class PenCell(LabelledCell):
    """A button: what is drawn is changed where it is seen large, not here."""

    wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("Pen", parent)
        self.button = QPushButton("Draw", self)
        self.button.setObjectName("draw_button")
        self.button.setMinimumHeight(LABEL_PX)
        self.button.setToolTip(tooltip("Show the clip large, and draw on it with the pen"))
        self.button.clicked.connect(lambda: self.wanted.emit())
        self.stack.addWidget(self.button, 0, Qt.AlignmentFlag.AlignLeft)
        self.label.setBuddy(self.button)
        self.setFocusProxy(self.button)
