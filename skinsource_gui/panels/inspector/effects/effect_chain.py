"""The effects of a clip, one below the other, as they follow each other."""

from functools import partial

from PySide6.QtCore import QEvent, Qt, QTimer, Signal
from PySide6.QtWidgets import (
    QApplication,
    QHBoxLayout,
    QLabel,
    QMenu,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from skinsource.design.effects import Effect, effect_kinds
from skinsource_gui.panels.inspector.effects.effect_row import EffectRow
from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.fields.parts.row_column import RowColumn
from skinsource_gui.widgets.into_sight import bring_into_sight
from skinsource_gui.widgets.tooltips import tooltip


class EffectChain(QWidget):
    """Rows of effects and a button that adds one.

    A row follows its effect when that is moved; what is new stands open, and what was added here
    is in sight and has the keyboard.
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
        self._clip_id: int | None = None
        self._adds = False
        self._words = QLabel("Effects")
        set_tone(self._words, "dim")
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
        self._column = RowColumn(self._add)
        self._column.moved.connect(self.moved)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, UNIT_PX // 2, 0, 0)
        whole.setSpacing(UNIT_PX // 4)
        whole.addLayout(head)
        whole.addWidget(self._column)

    @property
    def rows(self) -> tuple[EffectRow, ...]:
        """One for each effect, in their order."""
        return self._column.rows

    def show_chain(
        self, clip_id: int | None, effects: tuple[Effect, ...], end_s: float = 0.0
    ) -> None:
        """Show the effects of a clip that ends ``end_s`` after its onset; None: there is none."""
        self.setVisible(clip_id is not None)
        same_clip = clip_id == self._clip_id
        self._clip_id = clip_id
        rows, left, new = [], list(self.rows), None
        for index, effect in enumerate(effects):
            row = _row_for(effect, index, left, self.rows)
            if row is None:
                row = new = self._new_row(effect)
                row.set_open(same_clip)
            else:
                left.remove(row)
                if not same_clip:
                    row.forget_typing()
                row.show_effect(effect)
            row.show_end(end_s)
            rows.append(row)
        self._column.show_rows(tuple(rows))
        if self._adds and new is not None and same_clip:
            self._adds = False
            new.title.setFocus(Qt.FocusReason.OtherFocusReason)
            # It has a place only when it was laid out.
            QTimer.singleShot(0, new, partial(_show_whole, new))

    def show_refused(self, index: int, name: str, reason: str) -> None:
        """Say why a field of an effect stays as it is."""
        if index < len(self.rows):
            self.rows[index].show_refused(name, reason)

    def forget_typing(self) -> None:
        """Close open editors without committing."""
        for row in self.rows:
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
        self._adds = True
        self.added.emit(name)

    def _new_row(self, effect: Effect) -> EffectRow:
        row = EffectRow(effect, self)
        row.switched.connect(lambda on: self.switched.emit(self.rows.index(row), on))
        row.removed.connect(lambda: self.removed.emit(self.rows.index(row)))
        row.edited.connect(lambda *change: self.edited.emit(self.rows.index(row), *change))
        row.title.pressed_key.connect(lambda name: self._press(row, name))
        self._column.take_in(row)
        return row

    def _press(self, row: EffectRow, name: str) -> None:
        if name == "open":
            row.set_open(not row.open)
        elif name == "switch":
            row.toggle()
        elif name == "remove":
            self.removed.emit(self.rows.index(row))
        else:
            self._column.step(row, name)


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


def _show_whole(row: EffectRow) -> None:
    """Scroll to a new row; of one that is too tall, to its beginning."""
    # Layouts inside layouts ask again; on some systems a timer comes before the last of them.
    QApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)
    bring_into_sight(row)
    bring_into_sight(row.title)
