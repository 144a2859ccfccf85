"""The effects of a clip in the clip panel: a row for each, and a button that adds one."""

from collections.abc import Callable, Sequence
from functools import partial

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, Qt, QTimer, Signal

from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design, View
from skinsource.design.edits.clips import of_each
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.effects import effect_kinds
from skinsource.design.effects.effect import ON, Effect
from skinsource.specs.models import specs_of
from skinsource_gui.fields.curve_field import CurveField
from skinsource_gui.fields.editor import MIXED
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.grid import forget_typing
from skinsource_gui.fields.parts import AddButton, FieldsRow, RowColumn, RowTitle, lay_out_list
from skinsource_gui.qt.buttons import Fold, page_label, passing_menu, show_or_hide
from skinsource_gui.qt.layouts import in_column, named, tooltip
from skinsource_gui.qt.theme import UNIT_PX, set_tone
from skinsource_gui.qt.wheel import scroll_to

_MIXED = "Clips differ; typing and dragging set all"
_OTHERS = "The clips have different effects. Edits change the last clip only; Add… changes all."


class EffectRow(FieldsRow):
    """Switch, name and remove button of an effect, and its fields while it is open."""

    switched = Signal(bool)
    #: Name of a field, its new value, number of the gesture or None.
    edited = Signal(str, object, object)
    #: The name of an action of the window.
    action_requested = Signal(str)

    def __init__(self, effect: Effect) -> None:
        self.part = effect
        self._switch = named(
            QtWidgets.QCheckBox(), "effect_switch", f"{effect.title} on", tooltip(ON.label, ON.hint)
        )
        title = RowTitle(effect.title, "effects", "in the chain")
        super().__init__(title, (self._switch,), UNIT_PX // 2)
        self.remove_button.setToolTip(tooltip(f"Remove {effect.title.lower()}"))
        self._cells = tuple(self._cell(name) for name in specs_of(effect) if name != "on")
        self.grid.show_cells(self._cells)
        self._switch.clicked.connect(self.switched)
        self.show_effect(effect)

    @property
    def cells(self) -> tuple[FieldCell, ...]:
        return self._cells

    def cell(self, name: str) -> FieldCell:
        """Return the cell of a field."""
        return next(cell for cell in self._cells if cell.name == name)

    def show_effect(self, effect: Effect, others: Sequence[Effect] = ()) -> None:
        """Show another effect of the same kind, and where ``others`` differ from it."""
        self.part = effect
        self._switch.setChecked(effect.on)
        self._switch.setTristate(any(other.on != effect.on for other in others))
        if self._switch.isTristate():
            self._switch.setCheckState(Qt.CheckState.PartiallyChecked)
        set_tone(self.title, "" if effect.on else "dim")
        for cell in self._cells:
            value = getattr(effect, cell.name)
            cell.set_value(value)
            cell.show_mixed(any(getattr(each, cell.name) != value for each in others), _MIXED)

    def show_end(self, end_s: float) -> None:
        """Take over the end of the clip, for curves over its time."""
        for cell in self._cells:
            if isinstance(cell.field, CurveField):
                cell.field.end_x = end_s

    def show_refused(self, name: str, reason: str) -> None:
        """Show the value of a field again, and the reason why it did not change."""
        self.cell(name).refuse(getattr(self.part, name), reason)

    def contextMenuEvent(self, event: QtGui.QContextMenuEvent) -> None:
        menu = passing_menu(self, "effect_menu")
        for text, name in (("Copy effects", "copy_effects"), ("Replace effects", "paste_effects")):
            menu.addAction(text).triggered.connect(partial(self.action_requested.emit, name))
        menu.addAction(f"Remove {self.part.title.lower()}").triggered.connect(self.removed)
        menu.popup(event.globalPos())

    def press(self, name: str) -> None:
        if name == "switch":
            self._switch.click()
        else:
            super().press(name)

    def _cell(self, name: str) -> FieldCell:
        cell = FieldCell(name, specs_of(self.part)[name], edited=self.edited)
        # Waveforms may have a field of the same name.
        cell.field.setObjectName(f"effect_{name}_field")
        return cell


class EffectChain(QtWidgets.QWidget):
    """Rows of the effects of a clip and a button that adds one.

    Of several clips with the same kinds of effects all are changed, of others the last one.
    A row follows its effect when that is moved. A new row is open; one that was added here is
    scrolled into view and gets the keyboard focus.
    """

    #: `Edit` or `Refusal`, number of the gesture or None.
    edited = Signal(object, object)
    #: The name of an action of the window.
    action_requested = Signal(str)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._design, self._view = Design(limb=""), View()
        self._clip: Clip | None = None
        self._ids: tuple[int, ...] = ()
        # Those whose effects the rows change.
        self._changed: tuple[int, ...] = ()
        self._adds = False
        add = AddButton("add_effect", self._fill_menu)
        hint = tooltip("Add an effect to all selected clips, at the end")
        named(add, title="Add an effect", hint=hint)
        self._column: RowColumn[EffectRow] = RowColumn(add)
        self._column.moved.connect(partial(self._change, edits.move_effect))
        self._note = page_label("effects_note", tone="dim")
        content = QtWidgets.QWidget()
        in_column(self._note, self._column, of=content, margins=0, gap_px=UNIT_PX // 4)
        self.fold = Fold("effects_fold", "Effects", content)
        lay_out_list(self, self.fold, add, content)

    @property
    def rows(self) -> tuple[EffectRow, ...]:
        """A row for each effect, in their order."""
        return self._column.rows

    def show_chain(
        self, design: Design, view: View, clip: Clip | None, chosen: tuple[Clip, ...]
    ) -> None:
        """Show the effects of a clip, or none, which is the last one of those that are chosen."""
        before, self._clip = self._clip, clip
        self._design, self._view = design, view
        self._ids = tuple(each.id for each in chosen)
        alike = len({tuple(map(type, each.effects)) for each in chosen}) == 1
        shown = chosen if alike or clip is None else (clip,)
        self._changed = tuple(each.id for each in shown)
        self.setVisible(clip is not None)
        same_clip = before is not None and clip is not None and before.id == clip.id
        effects = clip.effects if clip is not None else ()
        before_rows, end_s = self.rows, clip.duration_s if clip is not None else 0.0
        rows, new = self._column.rows_for(effects, self._new_row, same_kind=True), None
        for k, (row, effect) in enumerate(zip(rows, effects, strict=True)):
            if row not in before_rows:
                new = row
                row.title.set_open(same_clip)
            elif not same_clip:
                forget_typing(row)
            row.show_effect(effect, [each.effects[k] for each in shown])
            row.show_end(end_s)
        self._column.show_rows(rows)
        text = f"Effects · {len(rows)}" if rows else "Effects"
        differ = len(shown) < len(chosen)
        self.fold.setText(f"Effects · {MIXED}" if differ else text)
        show_or_hide(self._note, _OTHERS if differ else "")
        if self._adds and new is not None and same_clip:
            self._adds = False
            self.fold.setChecked(True)
            new.title.setFocus(Qt.FocusReason.OtherFocusReason)
            # Only the layout gives it a place to scroll to.
            QTimer.singleShot(0, new, partial(_show_whole, new))

    def _fill_menu(self, menu: QtWidgets.QMenu) -> None:
        menu.setToolTipsVisible(True)
        for kind in effect_kinds():
            action = menu.addAction(kind.title)
            action.setToolTip(tooltip((kind.__doc__ or "").strip().splitlines()[0]))
            action.triggered.connect(partial(self._add, kind.__name__))

    def _new_row(self, effect: Effect) -> EffectRow:
        row = EffectRow(effect)
        row.switched.connect(lambda on: self._change(edits.switch_effect, self._index(row), on))
        row.removed.connect(lambda: self._change(edits.remove_effect, self._index(row)))
        row.edited.connect(partial(self._change_field, row))
        row.action_requested.connect(self.action_requested)
        self._column.take_in(row)
        return row

    def _index(self, row: EffectRow) -> int:
        return self.rows.index(row)

    def _add(self, kind: str, _checked: bool = False) -> None:
        self._adds = True
        self._tell(edits.add_effect(self._design, self._view, self._ids, kind))

    def _change(self, edit: Callable[..., Edit | Refusal], *arguments: object) -> None:
        if self._clip is not None:
            self._tell(of_each(edit, self._design, self._view, self._changed, *arguments))

    def _change_field(self, row: EffectRow, name: str, value: object, gesture: int | None) -> None:
        if self._clip is None:
            return
        change, what = edits.change_effect_field, (self._index(row), name, value)
        outcome = of_each(change, self._design, self._view, self._changed, *what)
        if isinstance(outcome, Refusal):
            row.show_refused(name, outcome.sentence)
        else:
            self._tell(outcome, gesture)

    def _tell(self, outcome: Edit | Refusal, gesture: int | None = None) -> None:
        if isinstance(outcome, Refusal) or outcome.design != self._design:
            self.edited.emit(outcome, gesture)


def _show_whole(row: EffectRow) -> None:
    """Scroll to a new row; of one that is too tall, to its beginning."""
    # Nested layouts post further requests; on some systems the timer fires before the last one.
    QtWidgets.QApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)
    scroll_to(row)
    scroll_to(row.title)
