"""The button with which limbs are chosen to stand side by side."""

from collections.abc import Sequence
from functools import partial

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QMenu, QToolButton, QWidget

from skinsource.design.comparing import MOST_BESIDE
from skinsource.design.labels import limb_word
from skinsource.limbs.catalogue import available_limbs
from skinsource_gui.panels.side_by_side.settings import LEAST_BESIDE


class LimbsButton(QToolButton):
    """Opens a list of all limbs, of which two to four are ticked.

    Attributes
    ----------
    menu_of_limbs
        What it opens.
    """

    #: Names of the limbs that are chosen; none: those that belong beside the one of the design.
    limbs_chosen = Signal(object)

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._chosen: tuple[str, ...] = ()
        self._usual = True
        self.setObjectName("side_by_side_limbs")
        self.setText("Limbs…")
        # The dots say that something opens.
        self.setStyleSheet("QToolButton::menu-indicator { image: none; }")
        self.setToolTip("Which limbs are shown, two to four")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.menu_of_limbs = QMenu(self)
        self.menu_of_limbs.aboutToShow.connect(self.fill)
        self.setMenu(self.menu_of_limbs)

    def show_chosen(self, chosen: Sequence[str], *, usual: bool) -> None:
        """Take over which limbs are shown, and whether these are the usual ones."""
        self._chosen, self._usual = tuple(chosen), usual

    def fill(self) -> None:
        """Offer the limbs that there are now."""
        menu = self.menu_of_limbs
        menu.clear()
        usual = menu.addAction("Those that belong together")
        usual.setToolTip("The four of one kind, or own limbs with the same outputs")
        usual.setCheckable(True)
        usual.setChecked(self._usual)
        usual.triggered.connect(partial(self.limbs_chosen.emit, ()))
        menu.addSeparator()
        known = available_limbs()
        # One that has gone can be taken out of the choice.
        for name in (*known, *(one for one in self._chosen if one not in known)):
            action = menu.addAction(limb_word(name).title)
            action.setCheckable(True)
            ticked = name in self._chosen
            action.setChecked(ticked)
            full = len(self._chosen) >= MOST_BESIDE
            action.setEnabled(len(self._chosen) > LEAST_BESIDE if ticked else not full)
            action.triggered.connect(partial(self._toggle, name))

    def _toggle(self, name: str) -> None:
        without = tuple(one for one in self._chosen if one != name)
        self.limbs_chosen.emit(without if name in self._chosen else (*self._chosen, name))
