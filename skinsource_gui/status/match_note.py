"""Says in the status bar that a snapshot is shown louder or softer than it is, to match another."""

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QToolButton, QWidget

from skinsource.design.comparing import match_words
from skinsource.design.design import Design
from skinsource.design.view import View

_ABOUT = (
    "What is shown and played has this gain; the design, its file and all exports have the "
    "amplitudes that were stored. Click to keep it, or to see the design as stored."
)


class MatchNote(QToolButton):
    """The gain; its menu keeps it or takes it off.  It takes no room where there is none.

    Parameters
    ----------
    actions
        What can be done about it.
    parent
        As in Qt.
    """

    def __init__(self, actions: Sequence[QAction], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("match_note")
        self.setAutoRaise(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self)
        menu.addActions(list(actions))
        self.setMenu(menu)
        self.hide()

    def show_state(self, design: Design, view: View) -> None:
        """Say with what gain ``design`` is shown."""
        gain = view.match_gain(design)
        words = match_words(gain)
        if words != self.accessibleName():
            self.setText(words)
            self.setAccessibleName(words)
            self.setToolTip(f"{words}. {_ABOUT}" if words else "")
        self.setVisible(bool(words))
