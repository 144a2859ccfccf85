"""The effects of a clip, one below the other, as they follow each other."""

from functools import partial

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QMenu, QToolButton, QVBoxLayout, QWidget

from skinsource.effects import Effect, effect_kinds
from skinsource_gui.panels.inspector.effects.effect_row import EffectRow
from skinsource_gui.theme import LIGHT, UNIT_PX, Theme
from skinsource_gui.widgets.tooltips import tooltip

_LINE_PX = 2


class EffectChain(QWidget):
    """Rows of effects and a button that adds one.

    A row follows its effect when that is moved; what is new stands open.
    """

    #: Name of a kind of effect.
    added = Signal(str)
    #: Place of an effect.
    removed = Signal(int)
    #: Place of an effect, and the one that it is moved to.
    moved = Signal(int, int)
    #: Place of an effect, and whether it is on.
    switched = Signal(int, bool)
    #: Place of an effect, name of a field, its new value, number of the gesture or None.
    edited = Signal(int, str, object, object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = LIGHT
        self._rows: tuple[EffectRow, ...] = ()
        self._clip_id: int | None = None
        self._words = QLabel("Effects")
        self._add = QToolButton()
        self._add.setObjectName("add_effect")
        self._add.setText("Add…")
        self._add.setAccessibleName("Add an effect")
        self._add.setToolTip(tooltip("Add an effect at the end of the chain"))
        self._add.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self._add.setMenu(QMenu(self._add))
        # The dots say that there is more to choose.
        self._add.setStyleSheet("QToolButton::menu-indicator { image: none; width: 0; }")
        self._add.menu().aboutToShow.connect(self._fill_menu)
        head = QHBoxLayout()
        head.setContentsMargins(0, 0, 0, 0)
        head.addWidget(self._words, 1)
        head.addWidget(self._add)
        self._column = QVBoxLayout()
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(UNIT_PX // 4)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, UNIT_PX // 2, 0, 0)
        whole.setSpacing(UNIT_PX // 4)
        whole.addLayout(head)
        whole.addLayout(self._column)
        # Where a dragged effect would go.
        self._line = QFrame(self)
        self._line.hide()

    @property
    def rows(self) -> tuple[EffectRow, ...]:
        """One for each effect, in their order."""
        return self._rows

    def show_chain(self, clip_id: int | None, effects: tuple[Effect, ...]) -> None:
        """Show the effects of a clip; None: there is none."""
        self.setVisible(clip_id is not None)
        same_clip = clip_id == self._clip_id
        self._clip_id = clip_id
        rows, left = [], list(self._rows)
        for index, effect in enumerate(effects):
            row = _row_for(effect, index, left, self._rows)
            if row is None:
                row = self._new_row(effect)
                row.set_open(same_clip)
            else:
                left.remove(row)
                if not same_clip:
                    row.forget_typing()
                row.show_effect(effect)
            rows.append(row)
        if tuple(rows) != self._rows:
            self._arrange(tuple(rows), left)

    def show_refused(self, index: int, name: str, reason: str) -> None:
        """Say why a field of an effect stays as it is."""
        if index < len(self._rows):
            self._rows[index].show_refused(name, reason)

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        self._words.setStyleSheet(f"color: {theme.dim};")
        self._line.setStyleSheet(f"background: {theme.accent};")
        for row in self._rows:
            row.show_theme(theme)

    def forget_typing(self) -> None:
        """Close open editors without committing."""
        for row in self._rows:
            row.forget_typing()

    def _fill_menu(self) -> None:
        menu = self._add.menu()
        menu.clear()
        menu.setToolTipsVisible(True)
        for kind in effect_kinds():
            action = menu.addAction(kind.title)
            action.setToolTip(tooltip((kind.__doc__ or "").strip().splitlines()[0]))
            action.triggered.connect(partial(self._tell_added, kind.__name__))

    def _tell_added(self, name: str, _checked: bool = False) -> None:
        self.added.emit(name)

    def _new_row(self, effect: Effect) -> EffectRow:
        row = EffectRow(effect, self._theme, self)
        row.switched.connect(lambda on: self.switched.emit(self._rows.index(row), on))
        row.removed.connect(lambda: self.removed.emit(self._rows.index(row)))
        row.edited.connect(lambda *change: self.edited.emit(self._rows.index(row), *change))
        row.title.pressed_key.connect(lambda name: self._press(row, name))
        row.title.dragged.connect(self._show_line)
        row.title.dropped.connect(lambda y: self._drop(row, y))
        row.title.given_up.connect(self._line.hide)
        return row

    def _arrange(self, rows: tuple[EffectRow, ...], gone: list[EffectRow]) -> None:
        was_focused = [k for k, row in enumerate(self._rows) if _has_focus(row) and row in gone]
        for row in self._rows:
            self._column.removeWidget(row)
        for row in gone:
            # What was being typed in it is for no other effect.
            row.forget_typing()
            row.hide()
            row.deleteLater()
        self._rows = rows
        before: QWidget = self._add
        for row in rows:
            self._column.addWidget(row)
            self.setTabOrder(before, row.title)
            before = row.title
            row.show()
        if was_focused:
            stops = [row.title for row in rows] or [self._add]
            stops[min(was_focused[0], len(stops) - 1)].setFocus(Qt.FocusReason.OtherFocusReason)

    def _press(self, row: EffectRow, name: str) -> None:
        index, last = self._rows.index(row), len(self._rows) - 1
        if name == "open":
            row.set_open(not row.open)
        elif name == "switch":
            row.toggle()
        elif name == "remove":
            self.removed.emit(index)
        elif name in ("shift_up", "shift_down"):
            to = index + (1 if name == "shift_down" else -1)
            if 0 <= to <= last:
                self.moved.emit(index, to)
        else:
            to = {"up": index - 1, "down": index + 1, "first": 0}.get(name, last)
            stop = self._rows[min(max(to, 0), last)].title
            stop.setFocus(Qt.FocusReason.OtherFocusReason)

    def _gap(self, y: int) -> int:
        """Before which row, or after the last one, something goes that is dropped at ``y``."""
        middles = [row.mapToGlobal(QPoint(0, row.title.height() // 2)).y() for row in self._rows]
        return sum(middle < y for middle in middles)

    def _show_line(self, y: int) -> None:
        gap = self._gap(y)
        above = gap == len(self._rows)
        row = self._rows[gap - 1 if above else gap]
        at = row.y() + (row.height() if above else -_LINE_PX)
        self._line.setGeometry(0, at, self.width(), _LINE_PX)
        self._line.raise_()
        self._line.show()

    def _drop(self, row: EffectRow, y: int) -> None:
        self._line.hide()
        index, gap = self._rows.index(row), self._gap(y)
        to = gap if gap <= index else gap - 1
        if to != index:
            self.moved.emit(index, to)


def _row_for(
    effect: Effect, index: int, left: list[EffectRow], before: tuple[EffectRow, ...]
) -> EffectRow | None:
    """The row that goes on with an effect: its own, the one at its place, one of its kind."""
    own = [row for row in left if row.effect is effect]
    at_place = [row for row in before[index : index + 1] if row in left]
    for row in (*own, *at_place, *left):
        if type(row.effect) is type(effect):
            return row
    return None


def _has_focus(row: EffectRow) -> bool:
    focused = row.window().focusWidget()
    return focused is not None and row.isAncestorOf(focused)
