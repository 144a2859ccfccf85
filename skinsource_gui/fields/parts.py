"""The editor of a list of models, such as the effects of a clip or the layers of a waveform.

`PartsEditor` has a `PartRow` for each part, in a `RowColumn` that lets the user reorder them, and
an `AddButton`.  A row shows the cells of `PartFields` while it is open.  The effects of a clip have
rows of their own in such a column.
"""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, Generic, TypeVar

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, QPoint, Qt, Signal

from skinsource.base.errors import InvalidInputError, sentence
from skinsource.design.edits.edit import KindSpec, as_kind, with_field
from skinsource.design.edits.effects import (
    Parts,
    choices_of,
    moved_part,
    new_part,
    part_text,
    with_part,
    without_part,
)
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import ListSpec, ModelSpec
from skinsource.specs.spec import Spec
from skinsource_gui.fields.editor import Editor, NewEditor
from skinsource_gui.fields.grid import EditedCell, FieldGrid, discard, forget_typing
from skinsource_gui.fields.kinds import fill_kind_menu
from skinsource_gui.qt.buttons import menu_of, remove_button
from skinsource_gui.qt.frames import drop_line
from skinsource_gui.qt.keys import claims_shortcut, key_text, meaning_of
from skinsource_gui.qt.layouts import Policy, in_column, in_row, tooltip
from skinsource_gui.qt.theme import UNIT_PX


class AddButton(QtWidgets.QToolButton):
    """Opens a menu of kinds of models, which ``fill`` fills each time."""

    def __init__(self, name: str, fill: Callable[[QtWidgets.QMenu], None]) -> None:
        super().__init__()
        self.setObjectName(name)
        self.setText("Add…")
        menu_of(self, fill)
        # The dots in the text already tell that there is a menu.
        self.setStyleSheet("QToolButton::menu-indicator { image: none; width: 0; }")


class PartFields(QObject):
    """Cells for the kind and the fields of a model of ``spec``, in reading order.

    The cells of nested models come first, then numbers and choices, then lists.
    """

    #: The changed model; number of the gesture or None.
    edited = Signal(object, object)
    #: There are other cells; the old ones will be deleted.
    rebuilt = Signal()

    def __init__(self, spec: ModelSpec, new_editor: NewEditor, parent: QObject) -> None:
        super().__init__(parent)
        self._spec, self._new_editor = spec, new_editor
        self._model: Any = None
        self._built_for: type | None = None
        self._own: dict[str, EditedCell] = {}
        self._nested: dict[str, PartFields] = {}
        self._last_edited = ""
        # The model before the gesture, and its number.
        self._start: tuple[Any, int | None] = None, None
        self._kind: EditedCell | None = None
        if len(spec.kinds()) > 1:
            self._kind = self._cell("kind", choices_of(spec))
            self._kind.edited.connect(self._change_kind)

    @property
    def cells(self) -> tuple[EditedCell, ...]:
        """All cells, in reading order."""
        kind = () if self._kind is None else (self._kind,)
        nested = [cell for part_fields in self._nested.values() for cell in part_fields.cells]
        return (*kind, *nested, *sorted(self._own.values(), key=lambda cell: cell.across))

    def show_model(self, model: Any) -> None:
        """Show the values of a model without a signal."""
        self._model = model
        if type(model) is not self._built_for:
            self._build(model)
        if self._kind is not None:
            self._kind.set_value(type(model).__name__)
        for name, cell in self._own.items():
            cell.set_value(getattr(model, name))
        for name, part_fields in self._nested.items():
            part_fields.show_model(getattr(model, name))

    def set_spec(self, spec: ModelSpec) -> None:
        """Use the rate of another limb."""
        self._spec = spec
        specs = specs_of(self._built_for) if self._built_for else {}
        parts: dict[str, EditedCell | PartFields] = {**self._own, **self._nested}
        for name, part in parts.items():
            part.set_spec(self._at_rate(specs[name]))

    def show_reason(self, reason: str) -> None:
        """Show at the field that was edited last why the edit was refused."""
        known: dict[str, EditedCell | PartFields] = {**self._own, **self._nested}
        if (part := known.get(self._last_edited, self._kind)) is not None:
            part.show_reason(reason)

    def _build(self, model: Any) -> None:
        old = self._nested.values()
        own: dict[str, EditedCell] = {}
        removed = [cell for cell in self.cells if cell is not self._kind]
        nested: dict[str, PartFields] = {}
        for name, spec in specs_of(model).items():
            if isinstance(spec, ModelSpec):
                nested[name] = PartFields(self._at_rate(spec), self._new_editor, self)
                nested[name].edited.connect(partial(self._change, name))
                nested[name].rebuilt.connect(self.rebuilt)
            elif spec.editable:
                own[name] = self._cell(name, self._at_rate(spec))
                own[name].edited.connect(self._change)
                field = own[name].field
                if isinstance(field, PartsEditor):
                    field.holder = lambda: self._model
        self._own, self._nested, self._built_for = own, nested, type(model)
        discard(removed, None if self._kind is None else self._kind.field)
        self.rebuilt.emit()
        for part_fields in old:
            part_fields.deleteLater()

    def _cell(self, name: str, spec: Spec) -> EditedCell:
        cell = EditedCell(name, spec, self._new_editor)
        # The clip itself has fields of the same names.
        cell.field.setObjectName(f"part_{name}_field")
        return cell

    def _at_rate(self, spec: Any) -> Any:
        rate_hz = self._spec.rate_hz
        return spec if rate_hz is None else spec.at_rate(rate_hz, self._spec.band_hz)

    def _change(self, name: str, value: object, gesture: int | None) -> None:
        self._last_edited = name
        if gesture is None or gesture != self._start[1]:
            self._start = self._model, gesture
        try:
            after = with_field(self._model, name, value, self._start[0])
        except InvalidInputError as error:
            self.show_model(self._model)
            self.show_reason(sentence(str(error)))
            return
        self._apply(after, gesture)

    def _change_kind(self, _: str, name: str, gesture: int | None) -> None:
        self._last_edited = "kind"
        kind = next(kind for kind in self._spec.kinds() if kind.__name__ == name)
        rate_hz = self._spec.rate_hz or facts_of("").sample_rate_hz
        self._apply(as_kind(self._model, kind, rate_hz), gesture)

    def _apply(self, after: Any, gesture: int | None) -> None:
        if after != self._model:
            self._model = after
            self.edited.emit(after, gesture)


# Width of the arrow and the edges of a title.
_BESIDE_PX = 30


class RowTitle(QtWidgets.QToolButton):
    """The title of a part: shows or hides its fields, can be dragged, and handles its keys.

    Parameters
    ----------
    text
        The title; a long one is cut.
    place
        Place in the table of keys that lists its keys.
    where
        Where the part is moved, for the tooltip: "in the chain".

    Attributes
    ----------
    open
        Whether the fields are shown.
    """

    #: Whether the fields shall be shown.
    opened = Signal(bool)
    #: Name of a key in the table of keys.
    pressed_key = Signal(str)
    #: y of the pointer on the screen, during a drag and at its end.
    dragged = Signal(int)
    dropped = Signal(int)
    #: The drag was cancelled.
    cancelled = Signal()

    def __init__(self, text: str, place: str, where: str) -> None:
        super().__init__()
        self._text, self._place = "", place
        self._start_y: int | None = None
        self._dragging = False
        self.open = False
        self.setObjectName(f"{place}_title")
        self.setStyleSheet("QToolButton { text-align: left; }")
        self.setAutoRaise(True)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.setSizePolicy(Policy.Ignored, Policy.Fixed)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        keys = f"{key_text(place, 'shift_up')}, {key_text(place, 'shift_down')}"
        self._hint = f"Click: show or hide its settings. Drag, or {keys}: another place {where}"
        self.set_text(text)
        self.clicked.connect(lambda: self.set_open(not self.open))
        self._show_arrow()

    def set_text(self, text: str) -> None:
        """Change the title."""
        if text != self._text:
            self._text = text
            self.setAccessibleName(text)
            self.setToolTip(tooltip(text, self._hint))
            self._fit()

    def set_open(self, open_: bool) -> None:
        """Tell whether the fields are shown."""
        if open_ != self.open:
            self.open = open_
            self._show_arrow()
            self.opened.emit(open_)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        name = meaning_of(self._place, event)
        if self._dragging and event.key() == Qt.Key.Key_Escape:
            self._end_drag()
            self.cancelled.emit()
        elif name:
            self.pressed_key.emit(name)
        else:
            event.ignore()

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, self._claims) or super().event(event)

    def _claims(self, event: QtGui.QKeyEvent) -> bool:
        gives_up = self._dragging and event.key() == Qt.Key.Key_Escape
        return gives_up or bool(meaning_of(self._place, event))

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        super().mousePressEvent(event)
        if event.button() == Qt.MouseButton.LeftButton:
            self._start_y = round(event.globalPosition().y())

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        super().mouseMoveEvent(event)
        if self._start_y is None:
            return
        y = round(event.globalPosition().y())
        if (
            not self._dragging
            and abs(y - self._start_y) >= QtWidgets.QApplication.startDragDistance()
        ):
            self._dragging = True
            # A drag is no click.
            self.setDown(False)
            self.setCursor(Qt.CursorShape.ClosedHandCursor)
        if self._dragging:
            self.dragged.emit(y)

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        if self._dragging and event.button() == Qt.MouseButton.LeftButton:
            self._end_drag()
            self.dropped.emit(round(event.globalPosition().y()))
            event.accept()
            return
        self._start_y = None
        super().mouseReleaseEvent(event)

    def _fit(self) -> None:
        room = max(self.width() - _BESIDE_PX, 0)
        text = self.fontMetrics().elidedText(self._text, Qt.TextElideMode.ElideRight, room)
        self.setText(text)

    def _end_drag(self) -> None:
        self._start_y, self._dragging = None, False
        self.setDown(False)
        self.unsetCursor()

    def _show_arrow(self) -> None:
        self.setArrowType(Qt.ArrowType.DownArrow if self.open else Qt.ArrowType.RightArrow)


class FieldsRow(QtWidgets.QWidget):
    """A title that can be dragged, buttons beside it, and fields below it while it is open.

    Parameters
    ----------
    title
        The title; emits drags and keys.
    before
        Buttons before the title; one after it removes the row.

    Attributes
    ----------
    part
        The model that is shown.
    """

    removed = Signal()
    part: Any = None

    def __init__(self, title: RowTitle, before: Sequence[QtWidgets.QWidget], gap_px: int) -> None:
        super().__init__()
        self.title, self.remove_button = title, remove_button()
        self.grid = FieldGrid()
        self.grid.hide()
        head = in_row(*before, (title, 1), self.remove_button, gap_px=gap_px)
        in_column(head, self.grid, of=self, margins=0, gap_px=UNIT_PX // 4)
        title.opened.connect(self._open)
        self.remove_button.clicked.connect(self.removed)

    @property
    def cells(self) -> tuple[EditedCell, ...]:
        """The fields that were made so far."""
        raise NotImplementedError

    @property
    def stops(self) -> tuple[QtWidgets.QWidget, ...]:
        """Widgets in the order of the Tab key."""
        return (self.title,)

    def press(self, name: str) -> None:
        """Do what a key of the title means."""
        if name == "open":
            self.title.set_open(not self.title.open)
        elif name == "remove":
            self.removed.emit()

    def _open(self, open_: bool) -> None:
        focused = self.focusWidget()
        if not open_ and focused is not None and self.grid.isAncestorOf(focused):
            self.title.setFocus(Qt.FocusReason.OtherFocusReason)
        self.grid.setVisible(open_ and bool(self.cells))


#: Place in the table of keys that lists the keys of a row.
PLACE = "parts"


class PartRow(FieldsRow):
    """The title of a part, a button that removes it, and its fields while it is open.

    The fields are made when they are shown first.
    """

    #: The changed part; number of the gesture or None.
    edited = Signal(object, object)
    #: The order of the Tab key has changed.
    restopped = Signal()

    def __init__(self, spec: ModelSpec, new_editor: NewEditor) -> None:
        self._spec, self._new_editor = spec, new_editor
        self.fields: PartFields | None = None
        super().__init__(RowTitle("", PLACE, "in the list"), (), 0)
        # The indent tells whose fields they are.
        self.grid.setContentsMargins(UNIT_PX, 0, 0, UNIT_PX // 2)

    @property
    def cells(self) -> tuple[EditedCell, ...]:
        return () if self.fields is None else self.fields.cells

    @property
    def stops(self) -> tuple[QtWidgets.QWidget, ...]:
        return (self.title, self.remove_button, *(cell.field for cell in self.cells))

    def show_part(self, part: Any, index: int, count: int, fewest: int) -> None:
        """Show part ``index`` of ``count``, of which ``fewest`` have to stay."""
        self.part = part
        self.title.set_text(f"{index + 1} · {part_text(part)}")
        name = f"{self._spec.label.lower()} {index + 1}"
        self.remove_button.setEnabled(count > fewest)
        hint = f"Remove {name} ({key_text(PLACE, 'remove')})"
        self.remove_button.setToolTip(tooltip(hint if count > fewest else why_required(fewest)))
        self.remove_button.setAccessibleName(f"Remove {name}")
        if self.fields is not None:
            self.fields.show_model(part)

    def set_spec(self, spec: ModelSpec) -> None:
        """Use the rate of another limb."""
        self._spec = spec
        if self.fields is not None:
            self.fields.set_spec(spec)

    def _open(self, open_: bool) -> None:
        if open_ and self.fields is None:
            self.fields = PartFields(self._spec, self._new_editor, self)
            self.fields.edited.connect(self.edited)
            self.fields.rebuilt.connect(self._show_cells)
            self.fields.show_model(self.part)
        super()._open(open_)

    def _show_cells(self) -> None:
        self.grid.show_cells(self.cells)
        self.restopped.emit()


def why_required(fewest: int) -> str:
    """Return why the last parts cannot be removed."""
    return f"At least {fewest} {'has' if fewest == 1 else 'have'} to stay"


_LINE_PX = 2
Row = TypeVar("Row", bound=FieldsRow)


class RowColumn(QtWidgets.QWidget, Generic[Row]):
    """Rows one below the other, which the user reorders by mouse or keys.

    Parameters
    ----------
    head
        Widget before the rows in the order of the Tab key; it gets the focus when no row is left.

    Attributes
    ----------
    rows
        The rows, in their order.
    """

    #: Index of a row, and the index to which it shall move.
    moved = Signal(int, int)

    def __init__(self, head: QtWidgets.QWidget) -> None:
        super().__init__()
        self._head = head
        self.rows: tuple[Row, ...] = ()
        self._column = in_column(of=self, margins=0, gap_px=UNIT_PX // 4)
        # Shows where a dragged row would go.
        self._line = drop_line(self, "row_gap")

    def take_in(self, row: Row) -> None:
        """Let a new row be dragged."""
        row.title.pressed_key.connect(partial(self.step, row))
        row.title.dragged.connect(self._show_line)
        row.title.dropped.connect(partial(self._drop, row))
        row.title.cancelled.connect(self._line.hide)

    def show_rows(self, rows: tuple[Row, ...]) -> None:
        """Show these rows, and delete the others."""
        if rows == self.rows:
            return
        removed = [row for row in self.rows if row not in rows]
        was_focused = [k for k, row in enumerate(self.rows) if row in removed and _has_focus(row)]
        for row in self.rows:
            self._column.removeWidget(row)
        for row in removed:
            # Typing that has begun in a removed row must not reach another one.
            forget_typing(row)
            row.hide()
            row.deleteLater()
        self.rows = rows
        for row in rows:
            self._column.addWidget(row)
            row.show()
        self.order_stops()
        if was_focused:
            stops: list[QtWidgets.QWidget] = [row.title for row in rows]
            stops = stops or [self._head]
            stops[min(was_focused[0], len(stops) - 1)].setFocus(Qt.FocusReason.OtherFocusReason)

    def rows_for(
        self, parts: Parts, new_row: Callable[[Any], Row], *, same_kind: bool = False
    ) -> tuple[Row, ...]:
        """Return a row for each part: its own, else that at its place, else a new one.

        ``same_kind``: the row at its place fits only a part of the same kind.
        """
        own = {id(row.part): row for row in reversed(self.rows)}
        left = set(self.rows) - {own[id(part)] for part in parts if id(part) in own}
        rows: list[Row] = []
        for index, part in enumerate(parts):
            row = own.pop(id(part), None)
            at_place = self.rows[index] if index < len(self.rows) else None
            if row is None and at_place in left:
                fits = not same_kind or type(at_place.part) is type(part)
                row = at_place if fits else None
            rows.append(new_row(part) if row is None else row)
            left.discard(rows[-1])
        return tuple(rows)

    def order_stops(self) -> None:
        """Set the order of the Tab key along the rows."""
        before = self._head
        for stop in (stop for row in self.rows for stop in row.stops):
            self.setTabOrder(before, stop)
            before = stop

    def step(self, row: Row, name: str) -> None:
        """Do what a key means for a row: act on it, move it, or go to another row."""
        index, last = self.rows.index(row), len(self.rows) - 1
        to = {"up": index - 1, "down": index + 1, "first": 0, "last": last}.get(name)
        if name in ("shift_up", "shift_down"):
            to = index + (1 if name == "shift_down" else -1)
            if 0 <= to <= last:
                self.moved.emit(index, to)
        elif to is None:
            row.press(name)
        else:
            self.rows[min(max(to, 0), last)].title.setFocus(Qt.FocusReason.OtherFocusReason)

    def _gap(self, y: int) -> int:
        """Return the index of the row before which a drop at ``y`` goes, or the number of rows."""
        middles = [row.mapToGlobal(QPoint(0, row.title.height() // 2)).y() for row in self.rows]
        return sum(middle < y for middle in middles)

    def _show_line(self, y: int) -> None:
        gap = self._gap(y)
        at_end = gap == len(self.rows)
        row = self.rows[gap - 1 if at_end else gap]
        at = row.y() + row.height() - _LINE_PX if at_end else max(row.y() - _LINE_PX, 0)
        self._line.setGeometry(0, at, self.width(), _LINE_PX)
        self._line.raise_()
        self._line.show()

    def _drop(self, row: Row, y: int) -> None:
        self._line.hide()
        index, gap = self.rows.index(row), self._gap(y)
        to = gap if gap <= index else gap - 1
        if to != index:
            self.moved.emit(index, to)


def lay_out_list(
    editor: QtWidgets.QWidget, label: QtWidgets.QWidget, add: AddButton, rows: QtWidgets.QWidget
) -> None:
    """Put a label and the button that adds rows above the rows."""
    head = in_row((label, 1), add)
    in_column(head, rows, of=editor, margins=0, gap_px=UNIT_PX // 4)


def _has_focus(row: QtWidgets.QWidget) -> bool:
    focused = row.window().focusWidget()
    return focused is not None and row.isAncestorOf(focused)


class PartsEditor(Editor, QtWidgets.QWidget):
    """Edits a tuple of models; a new one is open.

    Attributes
    ----------
    holder
        Returns the model that contains the list, to which a new part is fitted; or None.
    """

    def __init__(
        self, spec: ListSpec, of: ModelSpec, new_editor: NewEditor, parent: QtWidgets.QWidget
    ) -> None:
        super().__init__(parent)
        self._spec, self._of = spec, of
        self._new_editor = new_editor
        self._value: Parts = ()
        self.holder: Callable[[], Any] = lambda: None
        self.setAccessibleName(spec.label)
        self.label = QtWidgets.QLabel(spec.label)
        self.label.setToolTip(tooltip(spec.hint))
        self._add = AddButton("add_part", self._fill_menu)
        self._add.setAccessibleName(f"{spec.label}: add")
        self._column: RowColumn[PartRow] = RowColumn(self._add)
        self._column.moved.connect(
            lambda index, to: self._apply(moved_part(self._value, index, to), None)
        )
        lay_out_list(self, self.label, self._add, self._column)
        self.setContentsMargins(0, UNIT_PX // 4, 0, UNIT_PX // 4)
        self.setFocusProxy(self._add)

    @property
    def rows(self) -> tuple[PartRow, ...]:
        """The row of each part, in their order."""
        return self._column.rows

    def set_value(self, value: Parts) -> None:
        """Show other parts without a signal."""
        self._value = value
        self.problem_changed.emit("")
        self._show()

    def set_spec(self, spec: ListSpec) -> None:
        """Use the rate of another limb."""
        self._spec = spec
        if isinstance(spec.of, ModelSpec):
            self._of = spec.of
        for row in self.rows:
            row.set_spec(self._of)

    def cancel(self) -> None:
        """Forget what is being typed."""
        forget_typing(*self.rows)

    def _show(self) -> None:
        count, rows = len(self._value), self._column.rows_for(self._value, self._new_row)
        for index, part in enumerate(self._value):
            rows[index].show_part(part, index, count, self._spec.fewest)
        self._column.show_rows(rows)
        full = count >= self._spec.most
        self._add.setEnabled(not full)
        reason = f"There are at most {self._spec.most}; remove one first"
        self._add.setToolTip(tooltip(reason if full else "Add one at the end"))

    def _new_row(self, _part: Any) -> PartRow:
        row = PartRow(self._of, self._new_editor)
        row.edited.connect(lambda part, gesture: self._change(row, part, gesture))
        row.removed.connect(lambda: self._remove(row))
        row.restopped.connect(self._column.order_stops)
        self._column.take_in(row)
        return row

    def _fill_menu(self, menu: QtWidgets.QMenu) -> None:
        choices = choices_of(self._of)
        if isinstance(choices, KindSpec):
            fill_kind_menu(menu, self._add_part)
            return
        for name, title in choices.options:
            menu.addAction(title).triggered.connect(partial(self._add_part, name))

    def _add_part(self, name: str, _checked: bool = False) -> None:
        part = new_part(self._of, name, self.holder())
        self._apply((*self._value, part), None)
        # Unless the document has refused it.
        if self.rows and self.rows[-1].part is self._value[-1] is part:
            self.rows[-1].title.set_open(True)
            self.rows[-1].title.setFocus(Qt.FocusReason.OtherFocusReason)

    def _remove(self, row: PartRow) -> None:
        if len(self._value) <= self._spec.fewest:
            self.problem_changed.emit(
                f"{self._spec.label}: {why_required(self._spec.fewest).lower()}."
            )
            return
        self._apply(without_part(self._value, self.rows.index(row)), None)

    def _change(self, row: PartRow, part: Any, gesture: int | None) -> None:
        self._apply(with_part(self._value, self.rows.index(row), part), gesture)

    def _apply(self, parts: Parts, gesture: int | None) -> None:
        if parts != self._value:
            self.problem_changed.emit("")
            self._value = parts
            self._show()
            self.edited.emit(parts, gesture)
