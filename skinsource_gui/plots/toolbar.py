"""The toolbar of a plot: its layout, switches, and the button that leaves a zoom."""

from collections.abc import Callable
from itertools import pairwise

from PySide6 import QtWidgets
from PySide6.QtCore import Qt, Signal

from skinsource_gui.qt.buttons import tool_button
from skinsource_gui.qt.layouts import FlowLayout
from skinsource_gui.qt.theme import UNIT_PX

_LAYOUTS = (
    ("overlaid", "Overlaid", "All curves over each other"),
    ("stacked", "Stacked", "Each curve in its own row, all with the same scale"),
)


class PlotToolbar(QtWidgets.QWidget):
    """Buttons for the layout, switches of one plot, and a button that leaves a zoom.

    Signals tell what the user wants; the owner sets what the buttons show.  Where it is narrow,
    they stand in several rows.
    """

    #: ``"overlaid"``, ``"stacked"``, or a layout that was added.
    layout_chosen = Signal(str)
    everything_requested = Signal()

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._row = FlowLayout(self, UNIT_PX // 2)
        self._row.setContentsMargins(UNIT_PX // 2, 1, UNIT_PX // 2, 1)
        self._buttons: list[QtWidgets.QToolButton] = []
        self._layouts = QtWidgets.QButtonGroup(self)
        self._layout_buttons: dict[str, QtWidgets.QToolButton] = {}
        self._everything = self._button("show-all", "Fit", "Leave the zoom (key 0)", at=0)
        self._everything.setCheckable(False)
        self._everything.clicked.connect(self.everything_requested)
        self._everything.setVisible(False)
        for name, text, hint in _LAYOUTS:
            self.add_layout(name, text, hint)
        self._layouts.buttonClicked.connect(self._choose_layout)

    def add_layout(self, name: str, text: str, hint: str) -> None:
        """Add a further layout, before any switch."""
        button = self._button(name, text, hint, at=len(self._layout_buttons))
        self._layouts.addButton(button)
        self._layout_buttons[name] = button

    def add_switch(
        self, name: str, text: str, hint: str, toggled: Callable[[bool], None]
    ) -> QtWidgets.QToolButton:
        """Return a new switch; ``toggled`` is called with the state that the user wants."""
        button = self._button(name, text, hint, at=len(self._buttons) - 1)
        button.clicked.connect(toggled)
        return button

    def show_passing(self, button: QtWidgets.QToolButton, on: bool) -> None:
        """Show a switch only while it is on."""
        button.setChecked(on)
        self._show(button, on)

    def show_state(self, *, layout: str, zoomed: bool) -> None:
        """Show the present layout, and whether the plot is zoomed."""
        self._layout_buttons[layout].setChecked(True)
        self._show(self._everything, zoomed)

    def _show(self, button: QtWidgets.QToolButton, shown: bool) -> None:
        """Show or hide a button; the focus stays in the toolbar."""
        chosen = self._layouts.checkedButton()
        if not shown and button.hasFocus() and chosen is not None:
            chosen.setFocus(Qt.FocusReason.OtherFocusReason)
        button.setVisible(shown)

    def _button(self, name: str, text: str, hint: str, *, at: int) -> QtWidgets.QToolButton:
        button = tool_button(self, name, text, hint, checkable=True)
        button.setAccessibleName(text)
        button.setAccessibleDescription(hint)
        self._row.insert(at, button)
        self._buttons.insert(at, button)
        # Tab goes from left to right, in any order of creation.
        for before, after in pairwise(self._buttons):
            QtWidgets.QWidget.setTabOrder(before, after)
        return button

    def _choose_layout(self, button: QtWidgets.QToolButton) -> None:
        self.layout_chosen.emit(button.objectName())
