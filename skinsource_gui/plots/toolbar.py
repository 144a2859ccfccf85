"""The row of switches above a plot."""

from collections.abc import Callable, Sequence

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import (
    QBoxLayout,
    QButtonGroup,
    QHBoxLayout,
    QSizePolicy,
    QToolButton,
    QWidget,
)

from skinsource_gui.qt.buttons import tool_button
from skinsource_gui.qt.room import (
    RoomOrText,
    fitting_font,
    readable_of,
    smallest_of,
    width_in,
    write_in,
)
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.qt.wheel import bars_px

TOOLBAR_HEIGHT_PX = 28
_BESIDE, _BELOW = QBoxLayout.Direction.LeftToRight, QBoxLayout.Direction.TopToBottom
_LAYOUTS = (
    ("overlaid", "Overlaid", "All curves over each other"),
    ("stacked", "Stacked", "Each curve in its own row, all with the same scale"),
)


class PlotToolbar(QWidget):
    """Overlaid or stacked, switches of one plot, and the way out of a zoom.

    Buttons say what the user wants; what they show is set from outside.  Where there is too little
    room they are written smaller, and before that is hard to read, switches go below, if they may;
    before words are cut they do in any case.
    """

    #: ``"overlaid"``, ``"stacked"``, or one that was added.
    layout_chosen = Signal(str)
    everything_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._may_fold = True
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self._rows = QBoxLayout(_BESIDE, self)
        self._rows.setContentsMargins(UNIT_PX // 2, 1, UNIT_PX // 2, 1)
        self._rows.setSpacing(UNIT_PX // 2)
        self._row = QHBoxLayout()
        self._row.setSpacing(UNIT_PX // 2)
        self._layouts = QButtonGroup(self)
        self._layout_buttons: dict[str, QToolButton] = {}
        self._segments = QHBoxLayout()
        self._segments.setSpacing(0)
        self._segments.addStretch(1)
        for name, text, hint in _LAYOUTS:
            self.add_layout(name, text, hint)
        self._layouts.buttonClicked.connect(self._choose_layout)
        self._rows.addLayout(self._segments)
        self._rows.addLayout(self._row, 1)
        self._row.addStretch(1)
        self._everything = self._button("show-all", "Show all", "Leave the zoom (key 0)")
        self._everything.setCheckable(False)
        self._everything.clicked.connect(self.everything_wanted)
        self._everything.setVisible(False)
        self._row.addWidget(self._everything)
        RoomOrText(self).changed.connect(self._fit)

    def add_layout(self, name: str, text: str, hint: str) -> None:
        """Add one beside those that each plot has, before there are switches."""
        button = self._button(name, text, hint)
        self._layouts.addButton(button)
        self._segments.insertWidget(self._segments.count() - 1, button)
        others = list(self._layout_buttons.values())
        if others:
            # Tab goes from left to right, also where the plot was made before this button.
            QWidget.setTabOrder(others[-1], button)
        self._layout_buttons[name] = button
        self._last_before_switches = button

    def add_switch(
        self, name: str, text: str, hint: str, toggled: Callable[[bool], None]
    ) -> QToolButton:
        """Return a new switch; ``toggled`` is told what the user wants it to be."""
        button = self._button(name, text, hint)
        button.clicked.connect(toggled)
        self._row.insertWidget(self._row.count() - 2, button)
        # Tab goes from left to right, whenever a switch was made.
        QWidget.setTabOrder(self._last_before_switches, button)
        self._last_before_switches = button
        return button

    def show_passing(self, button: QToolButton, on: bool) -> None:
        """Show a switch where it is on, to be switched off; elsewhere it takes no room."""
        button.setChecked(on)
        self._show(button, on)

    def let_fold(self, may_fold: bool) -> None:
        """Whether there is room for a second row: a plot that is low needs it more."""
        if may_fold != self._may_fold:
            self._may_fold = may_fold
            self._fit()

    def sizeHint(self) -> QSize:
        # As high as its words need, where they are large or stand in two rows.
        return super().sizeHint().expandedTo(QSize(0, TOOLBAR_HEIGHT_PX))

    def minimumSizeHint(self) -> QSize:
        return super().minimumSizeHint().expandedTo(QSize(0, TOOLBAR_HEIGHT_PX))

    def show_state(self, *, layout: str, zoomed: bool) -> None:
        """Show which layout there is, and whether a zoom can be left."""
        self._layout_buttons[layout].setChecked(True)
        self._show(self._everything, zoomed)

    def _show(self, button: QToolButton, shown: bool) -> None:
        """Show or hide a button; the keyboard stays in the row."""
        chosen = self._layouts.checkedButton()
        if not shown and button.hasFocus() and chosen is not None:
            chosen.setFocus(Qt.FocusReason.OtherFocusReason)
        button.setVisible(shown)

    def _fit(self) -> None:
        """Write smaller where there is too little room: cut words say less than small ones.

        The way out of a zoom comes and goes while somebody turns the wheel over the plot: it takes
        the room that is left, and never makes a row fold.
        """
        first = list(self._layout_buttons.values())
        staying = [button for button in self._shown if button is not self._everything]
        others = [button for button in staying if button not in first]
        smallest = smallest_of(self.font())
        # What a scroll bar took: a row that folded for it would be higher, and keep it.
        unscrolled_px = self._room_px(others) + bars_px(self)
        tight = width_in(readable_of(self.font()), staying) > unscrolled_px
        # Cut words say nothing, whatever a plot needs.
        with_exit = [*others, self._everything]
        cut = width_in(smallest, [*first, *with_exit]) > self._room_px(with_exit)
        folds = bool(others) and (cut or (tight and self._may_fold))
        self._write((first, others) if folds else (staying,), others)
        direction = _BELOW if folds else _BESIDE
        if direction != self._rows.direction():
            self._rows.setDirection(direction)
            self._rows.activate()
            self.updateGeometry()
        shown = [button for button in with_exit if button in self._shown]
        least = max(width_in(smallest, row) for row in (first, shown))
        around, gap = self._rows.contentsMargins(), self._rows.spacing()
        around_px = around.left() + around.right() + gap * (len(first) + len(shown))
        self.setMinimumWidth(least + around_px)

    @property
    def _shown(self) -> list[QToolButton]:
        return [button for button in self.findChildren(QToolButton) if button.isVisibleTo(self)]

    def _room_px(self, others: Sequence[QToolButton]) -> int:
        """Width for words where layouts, which stand close together, have ``others`` beside."""
        around, gap = self._rows.contentsMargins(), self._rows.spacing()
        return self.width() - around.left() - around.right() - gap * len(others)

    def _write(
        self, rows: tuple[Sequence[QToolButton], ...], others: Sequence[QToolButton]
    ) -> None:
        """Write rows as large as they fit, and the way out of a zoom into what is left."""
        room = self._room_px(others)
        font = fitting_font(rows, self.font(), room)
        everything = [self._everything]
        if self._everything.isVisibleTo(self):
            room = self._room_px([*others, *everything])
            left = room - width_in(font, rows[-1])
            if width_in(smallest_of(self.font()), everything) > left:
                rows = (*rows[:-1], [*rows[-1], *everything])
                font = fitting_font(rows, self.font(), room)
                left = room - width_in(font, rows[-1][:-1])
            left = min(left, width_in(font, everything))
            write_in(fitting_font((everything,), self.font(), left), everything)
        for row in rows:
            write_in(font, [button for button in row if button is not self._everything])

    def _button(self, name: str, text: str, hint: str) -> QToolButton:
        button = tool_button(self, name, text, hint, checkable=True)
        button.setAccessibleName(text)
        button.setAccessibleDescription(hint)
        return button

    def _choose_layout(self, button: QToolButton) -> None:
        self.layout_chosen.emit(button.objectName())
