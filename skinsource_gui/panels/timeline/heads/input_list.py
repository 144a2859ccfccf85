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
from PySide6.QtWidgets import QApplication, QFrame, QScrollArea, QVBoxLayout, QWidget

from skinsource_gui.panels.timeline.heads.input_row import InputRow
from skinsource_gui.panels.timeline.heads.list_keys import ListKeys
from skinsource_gui.panels.timeline.heads.list_mouse import ListMouse
from skinsource_gui.panels.timeline.heads.row_signals import RowSignals
from skinsource_gui.panels.timeline.heads.row_state import RowState
from skinsource_gui.theme import LIGHT, Theme
from skinsource_gui.widgets.key_tables.kept_from_shortcuts import kept_from_shortcuts

_GAP_PX = 3


class InputRows(QWidget):
    """The rows, by the id of their input.

    Rows stay with their input when others come and go, so that an open editor survives.

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
        self._theme = LIGHT
        self._rows: dict[int, InputRow] = {}
        self.signals = RowSignals(self)
        self.keys, self.mouse = ListKeys(self), ListMouse(self)
        self.keys.typing_wanted.connect(self._type_amplitude)
        self.keys.moved.connect(self._take_keys)
        self.mouse.held_over.connect(self._show_gap)
        self._gap = QFrame(self)
        self._gap.setObjectName("input_gap")
        self._gap.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._gap.hide()
        self._layout = QVBoxLayout(self)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._layout.setSpacing(0)
        self._layout.addStretch(1)

    @property
    def rows(self) -> tuple[InputRow, ...]:
        """The rows, from top to bottom."""
        return tuple(self._rows.values())

    @property
    def last_row(self) -> InputRow | None:
        """The row that was selected last."""
        return next((row for row in self.rows if row.state.last), None)

    def show_rows(self, states: Sequence[RowState]) -> None:
        """Show one row for each state."""
        ids = [state.shown.id for state in states]
        left: list[InputRow] = []
        if ids != list(self._rows):
            self.mouse.cancel()
            left = self._arrange(ids)
        focused = self.hasFocus()
        for row, state in zip(self.rows, states, strict=True):
            row.show_state(replace(state, list_focused=True) if focused else state)
        # The keyboard may come from a row that goes: those that stay know by now what they show.
        for row in left:
            self._remove(row)

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        self._gap.setStyleSheet(f"background: {theme.accent};")
        for row in self.rows:
            row.show_theme(theme)

    def event(self, event: QEvent) -> bool:
        return kept_from_shortcuts(event, self._claims) or super().event(event)

    def _claims(self, event: QKeyEvent) -> bool:
        return self.keys.claims(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.mouse.cancel():
            return
        last = self.last_row
        here = None if last is None else self.rows.index(last)
        if not self.keys.press(event, here, len(self._rows)):
            event.ignore()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        # Also reached by presses on a row, which leaves them to us.
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        row = self._row_at(event.position().y())
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
        row = self.last_row if by_key else self._row_at(event.pos().y())
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

    def _row_at(self, y: float) -> InputRow | None:
        return next((row for row in self.rows if row.y() <= y < row.y() + row.height()), None)

    def _take_keys(self) -> None:
        # The key may have come from a control of a row that is left now.
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    def _type_amplitude(self) -> None:
        row = self.last_row
        if row is not None:
            row.amplitude.setFocus(Qt.FocusReason.OtherFocusReason)
            row.amplitude.begin_editing()

    def _show_gap(self, gap: int | None) -> None:
        self._gap.setVisible(gap is not None)
        if gap is not None:
            above = self.rows[:gap]
            bottom = above[-1].geometry().bottom() + 1 if above else 0
            self._gap.setGeometry(0, max(bottom - _GAP_PX // 2, 0), self.width(), _GAP_PX)
            self._gap.raise_()

    def _arrange(self, ids: list[int]) -> list[InputRow]:
        """Put the rows of these inputs in order; return those that are left over."""
        old, self._rows = self._rows, {}
        for position, one in enumerate(ids):
            row = old.pop(one, None) or self._new_row()
            self._rows[one] = row
            self._layout.insertWidget(position, row)
        before: QWidget = self
        for row in self.rows:
            for control in row.controls:
                self.setTabOrder(before, control)
                before = control
        return list(old.values())

    def _remove(self, row: InputRow) -> None:
        focused = QApplication.focusWidget()
        had_focus = focused is not None and row.isAncestorOf(focused)
        self._layout.removeWidget(row)
        row.amplitude.cancel_editing()
        row.hide()
        row.deleteLater()
        if had_focus:
            self.setFocus(Qt.FocusReason.OtherFocusReason)

    def _new_row(self) -> InputRow:
        row = InputRow(self.signals, self)
        row.show_theme(self._theme)
        return row


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
