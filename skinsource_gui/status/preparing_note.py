"""Says in the status bar that the sound of a long design is prepared, and how to stop that."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QSizePolicy, QWidget

from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.keys import shortcut_text
from skinsource_gui.widgets.lateness import Lateness

_WORDS = "Preparing the sound…"
_HINT = "It is brought to the rate of the device from beginning to end, and plays then"


class PreparingNote(QWidget):
    """Words and Cancel; they come where it takes long, and go with the first sound."""

    cancel_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("preparing_sound")
        words = QLabel(_WORDS)
        words.setToolTip(_HINT)
        self._cancel = QPushButton("Cancel")
        self._cancel.setObjectName("cancel_preparing")
        self._cancel.setToolTip(f"Do not play ({shortcut_text('play')})")
        self._cancel.setAccessibleName("Cancel preparing the sound")
        self._cancel.setAutoDefault(False)
        self._cancel.clicked.connect(self.cancel_wanted)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        row = QHBoxLayout(self)
        row.setContentsMargins(UNIT_PX, 0, 0, 0)
        row.setSpacing(UNIT_PX)
        row.addWidget(words)
        row.addWidget(self._cancel)
        self._lateness = Lateness(self)
        self._lateness.changed.connect(self._follow)
        self.hide()

    def show_preparing(self, preparing: bool) -> None:
        """Say whether something is about to be played; a short while is not worth a word."""
        self._lateness.set_stale(preparing)

    def _follow(self, late: bool) -> None:
        # The keyboard goes back to where work is done.
        if not late and self._cancel.hasFocus():
            self.window().setFocus()
        self.setVisible(late)
