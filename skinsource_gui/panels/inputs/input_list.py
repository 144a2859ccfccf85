"""A list of inputs that scrolls."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QApplication, QScrollArea, QVBoxLayout, QWidget

from skinsource_gui.panels.inputs.input_row import InputRow, RowState
from skinsource_gui.theme import LIGHT, Theme

_MOVES = frozenset({Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Home, Qt.Key.Key_End})


class InputRows(QWidget):
    """The rows, and the keys that act on the selected one.

    Rows stay with their input when others come and go, so that an open editor survives.
    """

    selected = Signal(int)
    amplitude_edited = Signal(int, float, object)
    mute_toggled = Signal(int)
    solo_toggled = Signal(int)
    removed = Signal(int)
    duplicated = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("input_rows")
        self.setAccessibleName("Inputs")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self._theme = LIGHT
        self._rows: dict[tuple[int, int], InputRow] = {}
        self._layout = QVBoxLayout(self)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._layout.setSpacing(0)
        self._layout.addStretch(1)

    @property
    def rows(self) -> tuple[InputRow, ...]:
        """The rows, from top to bottom."""
        return tuple(self._rows.values())

    @property
    def selected_row(self) -> InputRow | None:
        """The selected row."""
        return next((row for row in self.rows if row.state.selected), None)

    def show_rows(self, states: Sequence[RowState]) -> None:
        """Show one row for each state."""
        keys = _keys(states)
        if keys != list(self._rows):
            self._arrange(keys)
        focused = self.hasFocus()
        for row, state in zip(self.rows, states, strict=True):
            row.show_state(replace(state, list_focused=True) if focused else state)

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        for row in self.rows:
            row.show_theme(theme)

    def event(self, event: QEvent) -> bool:
        # Without this, a shortcut of the window that does the same would take the key, or both.
        if event.type() == QEvent.Type.ShortcutOverride and self._knows(event):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        row = self.selected_row
        if not self._knows(event) or not self._rows:
            event.ignore()
        elif event.key() in _MOVES:
            self.setFocus(Qt.FocusReason.OtherFocusReason)
            self.selected.emit(self._target(event.key(), row))
        elif row is None:
            event.ignore()
        elif event.key() in (Qt.Key.Key_Delete, Qt.Key.Key_Backspace):
            self.removed.emit(row.state.index)
        elif event.key() == Qt.Key.Key_M:
            self.mute_toggled.emit(row.state.index)
        elif event.key() == Qt.Key.Key_S:
            self.solo_toggled.emit(row.state.index)
        elif event.key() == Qt.Key.Key_D:
            self.duplicated.emit(row.state.index)
        else:
            row.amplitude.setFocus(Qt.FocusReason.OtherFocusReason)
            row.amplitude.begin_editing()

    def mousePressEvent(self, event) -> None:
        # Also reached by presses on a row, which leaves them to us.
        self.setFocus(Qt.FocusReason.MouseFocusReason)

    def focusInEvent(self, event) -> None:
        super().focusInEvent(event)
        self._show_focus()

    def focusOutEvent(self, event) -> None:
        super().focusOutEvent(event)
        self._show_focus()

    def _show_focus(self) -> None:
        for row in self.rows:
            row.show_state(replace(row.state, list_focused=self.hasFocus()))

    def _knows(self, event: QKeyEvent) -> bool:
        if event.matches(QKeySequence.StandardKey.Delete):
            return True
        control = Qt.KeyboardModifier.ControlModifier
        if event.key() == Qt.Key.Key_D:
            return event.modifiers() == control
        letters = (Qt.Key.Key_M, Qt.Key.Key_S)
        others = (Qt.Key.Key_Backspace, Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_F2)
        known = event.key() in _MOVES or event.key() in letters or event.key() in others
        return known and not event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier

    def _target(self, key: int, row: InputRow | None) -> int:
        last = len(self._rows) - 1
        if row is None or key in (Qt.Key.Key_Home, Qt.Key.Key_End):
            return last if key in (Qt.Key.Key_End, Qt.Key.Key_Up) else 0
        return min(max(row.state.index + (1 if key == Qt.Key.Key_Down else -1), 0), last)

    def _arrange(self, keys: list[tuple[int, int]]) -> None:
        old, self._rows = self._rows, {}
        for position, key in enumerate(keys):
            row = old.pop(key, None) or self._new_row()
            self._rows[key] = row
            self._layout.insertWidget(position, row)
        for row in old.values():
            focused = QApplication.focusWidget()
            had_focus = focused is not None and row.isAncestorOf(focused)
            self._layout.removeWidget(row)
            row.hide()
            row.deleteLater()
            if had_focus:
                self.setFocus(Qt.FocusReason.OtherFocusReason)
        before: QWidget = self
        for row in self.rows:
            for control in row.controls:
                self.setTabOrder(before, control)
                before = control

    def _new_row(self) -> InputRow:
        row = InputRow(self)
        row.show_theme(self._theme)
        row.pressed.connect(self.selected)
        row.amplitude_edited.connect(self.amplitude_edited)
        row.mute_toggled.connect(self.mute_toggled)
        row.solo_toggled.connect(self.solo_toggled)
        row.removed.connect(self.removed)
        return row


class InputList(QScrollArea):
    """`InputRows` in a frame that scrolls and keeps the selected row in sight."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("input_list")
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.rows = InputRows()
        self.setWidget(self.rows)
        self._revealed: InputRow | None = None

    def reveal_selected(self) -> None:
        """Scroll to the selected row if it is another than before."""
        row = self.rows.selected_row
        if row is not None and row is not self._revealed:
            # New rows have no place before their layout is done.
            self.rows.layout().activate()
            self.rows.adjustSize()
            self.ensureWidgetVisible(row, 0, 0)
        self._revealed = row


def _keys(states: Sequence[RowState]) -> list[tuple[int, int]]:
    # The colour is kept for the life of an input; files may hold the same colour twice.
    keys: list[tuple[int, int]] = []
    seen: Counter[int] = Counter()
    for state in states:
        colour = state.shown.colour
        keys.append((colour, seen[colour]))
        seen[colour] += 1
    return keys
