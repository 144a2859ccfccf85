"""The way from a waveform to where it is made."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QPushButton, QWidget

from skinsource_gui.widgets.fields.edited_cell import LABEL_PX, LabelledCell
from skinsource_gui.widgets.tooltips import tooltip


class ButtonCell(LabelledCell):
    """A button: what it leads to is not changed here.

    Parameters
    ----------
    label, words, hint
        What stands beside the button, on it, and what it says of itself.
    name
        Of the button, for whoever looks for it.
    """

    wanted = Signal()

    def __init__(
        self, label: str, words: str, hint: str, *, name: str, parent: QWidget | None = None
    ) -> None:
        super().__init__(label, parent)
        self.button = QPushButton(words, self)
        self.button.setObjectName(name)
        self.button.setMinimumHeight(LABEL_PX)
        self.button.setToolTip(tooltip(hint))
        self.button.clicked.connect(lambda: self.wanted.emit())
        self.stack.addWidget(self.button, 0, Qt.AlignmentFlag.AlignLeft)
        self.label.setBuddy(self.button)
        self.setFocusProxy(self.button)


def pen_cell() -> ButtonCell:
    """Leads from a drawn waveform to the pen: it is changed where it is seen large."""
    hint = "Show the clip large, and draw on it with the pen"
    return ButtonCell("Pen", "Draw", hint, name="draw_button")


def file_cell() -> ButtonCell:
    """Leads from a recording to the file that it shall be taken from."""
    hint = "Import a recording, in place of these samples or beside them"
    return ButtonCell("File", "Choose file…", hint, name="recording_button")
