"""Heads of tracks, in a list that scrolls."""

from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import (
    QContextMenuEvent,
    QFocusEvent,
    QKeyEvent,
    QMouseEvent,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QScrollArea, QWidget

from skinsource_gui.panels.timeline.heads.input_row import InputRow
from skinsource_gui.panels.timeline.heads.kept_rows import KeptRows
from skinsource_gui.panels.timeline.heads.list_keys import ListKeys
from skinsource_gui.panels.timeline.heads.list_mouse import ListMouse
from skinsource_gui.panels.timeline.heads.row_gap import RowGap
from skinsource_gui.panels.timeline.heads.row_signals import RowSignals
from skinsource_gui.panels.timeline.heads.row_state import RowState
from skinsource_gui.widgets.keys import claims_shortcut


class InputRows(QWidget):
    """The heads, one below the other: hands what keys and mouse do there to who knows it.

    Attributes
    ----------
    signals, keys, mouse
        What is done to the rows: by their controls, by keys and by the mouse.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("input_rows")
        self.setAccessibleName("Inputs")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.signals = RowSignals(self)
        self._kept = KeptRows(self, self.signals)
        self.keys, self.mouse = ListKeys(self), ListMouse(self)
        self.keys.typing_wanted.connect(self._type_amplitude)
        self.keys.moved.connect(self._take_keys)
        self.mouse.held_over.connect(self._show_gap)
        self._gap = RowGap(self)

    @property
    def rows(self) -> tuple[InputRow, ...]:
        """The rows, from top to bottom."""
        return self._kept.rows

    @property
    def last_row(self) -> InputRow | None:
        """The row that was selected last."""
        return self._kept.last

    def show_rows(self, states: Sequence[RowState]) -> None:
        """Show one row for each state."""
        ids = [state.shown.id for state in states]
        left: list[InputRow] = []
        if not self._kept.stand_for(ids):
            self.mouse.cancel()
            left = self._kept.arrange(ids)
        focused = self.hasFocus()
        for row, state in zip(self.rows, states, strict=True):
            row.show_state(replace(state, list_focused=True) if focused else state)
        # The keyboard may come from a row that goes: those that stay know by now what they show.
        for row in left:
            if self._kept.remove(row):
                self.setFocus(Qt.FocusReason.OtherFocusReason)

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, self._claims) or super().event(event)

    def _claims(self, event: QKeyEvent) -> bool:
        return self.keys.claims(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.mouse.cancel():
            return
        last = self.last_row
        here = None if last is None else self.rows.index(last)
        if not self.keys.press(event, here, len(self.rows)):
            event.ignore()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        # Also reached by presses on a row, which leaves them to us.
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        row = self._kept.at(event.position().y())
        if row is not None and event.button() == Qt.MouseButton.LeftButton:
            self.mouse.press(event, row.id, row.state.selected)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        y = event.position().y()
        self.mouse.move(event, sum(row.geometry().center().y() < y for row in self.rows))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self.mouse.release()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        # A menu key means the row that was selected last, and finds its menu beside it.
        by_key = event.reason() == QContextMenuEvent.Reason.Keyboard
        row = self.last_row if by_key else self._kept.at(event.pos().y())
        if row is not None:
            at = row.mapToGlobal(row.rect().center()) if by_key else event.globalPos()
            self.mouse.menu_wanted.emit(row.id, at)

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self._show_focus()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self._show_focus()

    def _show_focus(self) -> None:
        for row in self.rows:
            row.show_state(replace(row.state, list_focused=self.hasFocus()))

    def _take_keys(self) -> None:
        # The key may have come from a control of a row that is left now.
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    def _type_amplitude(self) -> None:
        row = self.last_row
        if row is not None:
            row.amplitude.setFocus(Qt.FocusReason.OtherFocusReason)
            row.amplitude.begin_editing()

    def _show_gap(self, gap: int | None) -> None:
        self._gap.show_behind(None if gap is None else self.rows[:gap])


class InputList(QScrollArea):
    """`InputRows` in a frame that scrolls and keeps the row in sight that was selected last."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("input_list")
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.rows = InputRows()
        self.setWidget(self.rows)
        self._shown: tuple[int, int] | None = None
        self._kept_in_sight = False
        bar = self.verticalScrollBar()
        # Rows that came have no place before their layout is done, and the bar no room for them.
        bar.rangeChanged.connect(self._scroll)
        bar.actionTriggered.connect(self._let_go)

    def reveal_selected(self) -> None:
        """Scroll to the row that was selected last if it is another, or stands elsewhere."""
        row = self.rows.last_row
        shown = None if row is None else (row.id, self.rows.rows.index(row))
        if shown is not None and shown != self._shown:
            self._kept_in_sight = True
            self._scroll()
        self._shown = shown

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._scroll()

    def wheelEvent(self, event: QWheelEvent) -> None:
        self._let_go()
        super().wheelEvent(event)

    def _let_go(self) -> None:
        # Who scrolls wants to see something else.
        self._kept_in_sight = False

    def _scroll(self) -> None:
        row = self.rows.last_row
        if not self._kept_in_sight or row is None:
            return
        bar, top = self.verticalScrollBar(), self.rows.rows.index(row) * row.height()
        lowest = top + row.height() - self.viewport().height()
        bar.setValue(min(max(bar.value(), lowest), top))
