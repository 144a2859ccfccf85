"""The toolbar of a plot: its layout, switches, and the button that leaves a zoom."""

from collections.abc import Callable, Sequence

from PySide6 import QtWidgets
from PySide6.QtCore import QSize, Qt, Signal

from skinsource_gui.qt.buttons import tool_button
from skinsource_gui.qt.fitting import (
    LayoutWatcher,
    fitting_font,
    readable_of,
    set_fonts,
    smallest_font,
    width_in,
)
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.qt.wheel import bars_px

TOOLBAR_HEIGHT_PX = 28
_BESIDE, _BELOW = (
    QtWidgets.QBoxLayout.Direction.LeftToRight,
    QtWidgets.QBoxLayout.Direction.TopToBottom,
)
_LAYOUTS = (
    ("overlaid", "Overlaid", "All curves over each other"),
    ("stacked", "Stacked", "Each curve in its own row, all with the same scale"),
)


class PlotToolbar(QtWidgets.QWidget):
    """Buttons for the layout, switches of one plot, and a button that leaves a zoom.

    Signals tell what the user wants; the owner sets what the buttons show.  In a narrow toolbar
    letters shrink, and switches go into a second row before letters are hard to read.
    """

    #: ``"overlaid"``, ``"stacked"``, or a layout that was added.
    layout_chosen = Signal(str)
    everything_requested = Signal()

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Fixed)
        self._rows = QtWidgets.QBoxLayout(_BESIDE, self)
        self._rows.setContentsMargins(UNIT_PX // 2, 1, UNIT_PX // 2, 1)
        self._rows.setSpacing(UNIT_PX // 2)
        self._row = QtWidgets.QHBoxLayout()
        self._row.setSpacing(UNIT_PX // 2)
        self._layouts = QtWidgets.QButtonGroup(self)
        self._layout_buttons: dict[str, QtWidgets.QToolButton] = {}
        self._segments = QtWidgets.QHBoxLayout()
        self._segments.setSpacing(0)
        self._segments.addStretch(1)
        for name, text, hint in _LAYOUTS:
            self.add_layout(name, text, hint)
        self._layouts.buttonClicked.connect(self._choose_layout)
        self._rows.addLayout(self._segments)
        self._rows.addLayout(self._row, 1)
        self._row.addStretch(1)
        self._everything = self._button("show-all", "Show all", "Reset zoom (key 0)")
        self._everything.setCheckable(False)
        self._everything.clicked.connect(self.everything_requested)
        self._everything.setVisible(False)
        self._row.addWidget(self._everything)
        LayoutWatcher(self).changed.connect(self._fit)

    def add_layout(self, name: str, text: str, hint: str) -> None:
        """Add a further layout, before any switch."""
        button = self._button(name, text, hint)
        self._layouts.addButton(button)
        self._segments.insertWidget(self._segments.count() - 1, button)
        others = list(self._layout_buttons.values())
        if others:
            # Tab goes from left to right, also if the plot is older than this button.
            QtWidgets.QWidget.setTabOrder(others[-1], button)
        self._layout_buttons[name] = button
        self._last_before_switches = button

    def add_switch(
        self, name: str, text: str, hint: str, toggled: Callable[[bool], None]
    ) -> QtWidgets.QToolButton:
        """Return a new switch; ``toggled`` is called with the state that the user wants."""
        button = self._button(name, text, hint)
        button.clicked.connect(toggled)
        self._row.insertWidget(self._row.count() - 2, button)
        # Tab goes from left to right, in any order of creation.
        QtWidgets.QWidget.setTabOrder(self._last_before_switches, button)
        self._last_before_switches = button
        return button

    def show_passing(self, button: QtWidgets.QToolButton, on: bool) -> None:
        """Show a switch only while it is on."""
        button.setChecked(on)
        self._show(button, on)

    def sizeHint(self) -> QSize:
        # Large letters and two rows need more height.
        return super().sizeHint().expandedTo(QSize(0, TOOLBAR_HEIGHT_PX))

    def minimumSizeHint(self) -> QSize:
        return super().minimumSizeHint().expandedTo(QSize(0, TOOLBAR_HEIGHT_PX))

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

    def _fit(self) -> None:
        """Choose fonts and rows that fit the present width.

        The button that leaves a zoom comes and goes while the user turns the wheel: it never makes
        a row fold.
        """
        first = list(self._layout_buttons.values())
        visible = [
            button
            for button in self.findChildren(QtWidgets.QToolButton)
            if button.isVisibleTo(self)
        ]
        shown = [button for button in visible if button not in first]
        others = [button for button in shown if button is not self._everything]
        with_exit = [*others, self._everything]
        smallest = smallest_font(self.font())
        # Without the scroll bar: a row that folded for it would be higher, and keep it.
        room_px = self._room_px(others) + bars_px(self)
        folds = width_in(readable_of(self.font()), [*first, *others]) > room_px
        rows = (first, shown) if folds else ([*first, *shown],)
        set_fonts(fitting_font(rows, self.font(), self._room_px(shown)), [*first, *shown])
        direction = _BELOW if folds else _BESIDE
        if direction != self._rows.direction():
            self._rows.setDirection(direction)
            self._rows.activate()
            self.updateGeometry()
        least = max(width_in(smallest, row) for row in (first, with_exit))
        self.setMinimumWidth(least + self.width() - self._room_px(with_exit))

    def _room_px(self, others: Sequence[QtWidgets.QToolButton]) -> int:
        """Return the width for texts of the layouts, which have no gaps, and ``others`` beside."""
        margins, gap = self._rows.contentsMargins(), self._rows.spacing()
        return self.width() - margins.left() - margins.right() - gap * len(others)

    def _button(self, name: str, text: str, hint: str) -> QtWidgets.QToolButton:
        button = tool_button(self, name, text, hint, checkable=True)
        button.setAccessibleName(text)
        button.setAccessibleDescription(hint)
        return button

    def _choose_layout(self, button: QtWidgets.QToolButton) -> None:
        self.layout_chosen.emit(button.objectName())
