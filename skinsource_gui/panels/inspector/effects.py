"""The effects of a clip in the inspector: a row for each, and the edits that rows and menu make."""

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtWidgets import (
    QApplication,
    QCheckBox,
    QHBoxLayout,
    QLabel,
    QMenu,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.effects import effect_kinds
from skinsource.design.effects.effect import ON, Effect
from skinsource.design.view import View
from skinsource.specs.models import specs_of
from skinsource_gui.fields.curve_field import CurveField
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.grid import FieldGrid
from skinsource_gui.fields.parts import RowColumn, RowTitle
from skinsource_gui.qt.buttons import remove_button
from skinsource_gui.qt.theme import UNIT_PX, set_tone
from skinsource_gui.qt.tooltips import tooltip
from skinsource_gui.qt.wheel import scroll_to


class ChainEdits(QObject):
    """Translates what rows and menu emit into edits of the clip."""

    #: `Edit` or `Refusal`, number of the gesture or None.
    edited = Signal(object, object)
    #: Place of an effect, name of a field whose new value is not allowed, and the reason.
    field_refused = Signal(int, str, str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._design, self._view = Design(limb=""), View()
        self._clip: Clip | None = None
        self._ids: tuple[int, ...] = ()

    def show_state(
        self, design: Design, view: View, clip: Clip | None, ids: tuple[int, ...]
    ) -> None:
        """Take over the state, the clip that is shown, and all clips that get a new effect."""
        self._design, self._view, self._clip, self._ids = design, view, clip, ids

    def add(self, kind: str) -> None:
        """Add an effect at the end of the chains of all selected clips."""
        self._tell(edits.add_effect(self._design, self._view, self._ids, kind))

    def remove(self, index: int) -> None:
        """Remove an effect."""
        self._of_clip(edits.remove_effect, index)

    def move(self, index: int, to: int) -> None:
        """Move an effect to another place in the chain."""
        self._of_clip(edits.move_effect, index, to)

    def switch(self, index: int, on: bool) -> None:
        """Switch an effect on or off."""
        self._of_clip(edits.switch_effect, index, on)

    def change_field(self, index: int, name: str, value: object, gesture: int | None) -> None:
        """Set a field of an effect."""
        if self._clip is None:
            return
        outcome = edits.change_effect_field(
            self._design, self._view, self._clip.id, index, name, value
        )
        if isinstance(outcome, Refusal):
            self.field_refused.emit(index, name, outcome.sentence)
        else:
            self._tell(outcome, gesture)

    def _of_clip(self, edit: Callable[..., Edit | Refusal], *arguments: object) -> None:
        if self._clip is not None:
            self._tell(edit(self._design, self._view, self._clip.id, *arguments))

    def _tell(self, outcome: Edit | Refusal, gesture: int | None = None) -> None:
        if isinstance(outcome, Refusal) or outcome.design != self._design:
            self.edited.emit(outcome, gesture)


class EffectRow(QWidget):
    """Switch, name and remove button of an effect, and its fields while it is open.

    Attributes
    ----------
    effect
        The effect that is shown.
    title
        The name; emits drags and keys.
    """

    switched = Signal(bool)
    removed = Signal()
    #: Name of a field, its new value, number of the gesture or None.
    edited = Signal(str, object, object)

    def __init__(self, effect: Effect, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.effect = effect
        self.title = RowTitle(effect.title, "effects", "in the chain")
        self._switch = QCheckBox()
        self._switch.setObjectName("effect_switch")
        self._switch.setAccessibleName(f"{effect.title} on")
        self._switch.setToolTip(tooltip(ON.label, ON.hint))
        self._remove = remove_button()
        self._remove.setToolTip(tooltip(f"Remove {effect.title.lower()}"))
        self._cells = tuple(self._cell(name) for name in specs_of(effect) if name != "on")
        self._grid = FieldGrid()
        self._grid.show_cells(self._cells)
        self._grid.hide()
        head = QHBoxLayout()
        head.setContentsMargins(0, 0, 0, 0)
        head.setSpacing(UNIT_PX // 2)
        head.addWidget(self._switch)
        head.addWidget(self.title, 1)
        head.addWidget(self._remove)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(UNIT_PX // 4)
        column.addLayout(head)
        column.addWidget(self._grid)
        self.title.opened.connect(self._open)
        self._switch.clicked.connect(self.switched)
        self._remove.clicked.connect(self.removed)
        self.show_effect(effect)

    @property
    def stops(self) -> tuple[QWidget, ...]:
        """Widgets at which the Tab key stops first."""
        return (self.title,)

    @property
    def open(self) -> bool:
        """Whether its fields are shown."""
        return self.title.open

    def set_open(self, open_: bool) -> None:
        """Show its fields, or hide them."""
        self.title.set_open(open_)

    def cell(self, name: str) -> FieldCell:
        """Return the cell of a field."""
        return next(cell for cell in self._cells if cell.name == name)

    def show_effect(self, effect: Effect) -> None:
        """Show another effect of the same kind."""
        self.effect = effect
        self._switch.setChecked(effect.on)
        set_tone(self.title, "" if effect.on else "dim")
        for cell in self._cells:
            cell.set_value(getattr(effect, cell.name))

    def show_end(self, end_s: float) -> None:
        """Take over the end of the clip, for curves over its time."""
        for cell in self._cells:
            if isinstance(cell.field, CurveField):
                cell.field.points.end_x = end_s

    def show_refused(self, name: str, reason: str) -> None:
        """Show the value of a field again, and the reason why it did not change."""
        cell = self.cell(name)
        cell.set_value(getattr(self.effect, name))
        cell.show_reason(reason)

    def forget_typing(self) -> None:
        """Close an open editor without committing."""
        for cell in self._cells:
            cell.forget_typing()

    def toggle(self) -> None:
        """Switch the effect, as a click does."""
        self._switch.click()

    def _cell(self, name: str) -> FieldCell:
        cell = FieldCell(name, specs_of(self.effect)[name])
        # Waveforms may have a field of the same name.
        cell.field.setObjectName(f"effect_{name}_field")
        cell.edited.connect(self.edited)
        return cell

    def _open(self, open_: bool) -> None:
        focused = self._grid.isAncestorOf(self.focusWidget()) if self.focusWidget() else False
        if focused and not open_:
            self.title.setFocus(Qt.FocusReason.OtherFocusReason)
        self._grid.setVisible(open_ and bool(self._cells))


class EffectChain(QWidget):
    """Rows of effects and a button that adds one.

    A row follows its effect when that is moved. A new row is open; one that was added here is
    scrolled into view and gets the keyboard focus.
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
        title = QLabel("Effects")
        set_tone(title, "dim")
        self._add = QToolButton()
        self._add.setObjectName("add_effect")
        self._add.setText("Add…")
        self._add.setAccessibleName("Add an effect")
        self._add.setToolTip(tooltip("Add an effect at the end of the chain"))
        self._add.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self._add.setMenu(QMenu(self._add))
        # The dots on the button already show that it opens a menu.
        self._add.setStyleSheet("QToolButton::menu-indicator { image: none; width: 0; }")
        self._add.menu().aboutToShow.connect(self._fill_menu)
        head = QHBoxLayout()
        head.setContentsMargins(0, 0, 0, 0)
        head.addWidget(title, 1)
        head.addWidget(self._add)
        self._column = RowColumn(self._add)
        self._column.moved.connect(self.moved)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, UNIT_PX // 2, 0, 0)
        column.setSpacing(UNIT_PX // 4)
        column.addLayout(head)
        column.addWidget(self._column)

    @property
    def rows(self) -> tuple[EffectRow, ...]:
        """A row for each effect, in their order."""
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
            # Only the layout gives it a place to scroll to.
            QTimer.singleShot(0, new, partial(_show_whole, new))

    def show_refused(self, index: int, name: str, reason: str) -> None:
        """Show the reason why a field of an effect did not change."""
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
    """Return the row that continues an effect: its own, the one at its place, one of its kind."""
    own = [row for row in left if row.effect is effect]
    at_place = [row for row in before[index : index + 1] if row in left]
    for row in (*own, *at_place, *left):
        if type(row.effect) is type(effect):
            return row
    return None


def _show_whole(row: EffectRow) -> None:
    """Scroll to a new row; of one that is too tall, to its beginning."""
    # Nested layouts post further requests; on some systems the timer fires before the last one.
    QApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)
    scroll_to(row)
    scroll_to(row.title)
