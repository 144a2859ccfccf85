"""What edits a list of recipes: rows of them, and a button that adds one."""

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from skinsource.design.edits.effects import Parts, moved_part, new_part, with_part, without_part
from skinsource.specs.fields import ListSpec, RecipeSpec
from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.fields.editor import NewEditor
from skinsource_gui.widgets.fields.parts.add_button import AddButton
from skinsource_gui.widgets.fields.parts.part_row import PartRow, stays_words
from skinsource_gui.widgets.fields.parts.row_column import RowColumn
from skinsource_gui.widgets.tooltips import tooltip


class PartsEditor(QObject):
    """Edits a tuple of recipes; a new one stands open.

    Attributes
    ----------
    holder
        Returns the recipe that holds the list, to which a new part is fitted; or None.
    """

    edited = Signal(object, object)
    problem_changed = Signal(str)

    def __init__(
        self, spec: ListSpec, of: RecipeSpec, new_editor: NewEditor, parent: QWidget
    ) -> None:
        super().__init__(parent)
        self._spec, self._of = spec, of
        self._new_editor = new_editor
        self._value: Parts = ()
        self.holder: Callable[[], Any] = lambda: None
        self.field = QWidget(parent)
        self.field.setAccessibleName(spec.label)
        self.label = QLabel(spec.label)
        self.label.setToolTip(tooltip(spec.hint))
        self._add = AddButton(spec, of)
        self._add.chosen.connect(self._add_part)
        self._column = RowColumn(self._add)
        self._column.moved.connect(
            lambda index, to: self._tell(moved_part(self._value, index, to), None)
        )
        head = QHBoxLayout()
        head.setContentsMargins(0, 0, 0, 0)
        head.addWidget(self.label, 1)
        head.addWidget(self._add)
        whole = QVBoxLayout(self.field)
        whole.setContentsMargins(0, UNIT_PX // 4, 0, UNIT_PX // 4)
        whole.setSpacing(UNIT_PX // 4)
        whole.addLayout(head)
        whole.addWidget(self._column)
        self.field.setFocusProxy(self._add)

    @property
    def rows(self) -> tuple[PartRow, ...]:
        """One for each part, in their order."""
        return self._column.rows

    def set_value(self, value: Parts) -> None:
        """Show other parts, and tell nobody."""
        self._value = value
        self.problem_changed.emit("")
        self._show()

    def set_spec(self, spec: ListSpec) -> None:
        """Take over the rate of another limb."""
        self._spec = spec
        if isinstance(spec.of, RecipeSpec):
            self._of = spec.of
        for row in self.rows:
            row.set_spec(self._of)

    def advice(self) -> str:
        """Nothing needs a remark."""
        return ""

    def refuse(self, reason: str) -> None:
        """It is said under the list."""

    def cancel(self) -> None:
        """Forget what is being entered."""
        for row in self.rows:
            row.forget_typing()

    def _show(self) -> None:
        count, found = len(self._value), _rows_of(self._value, self.rows, self._new_row)
        for index, part in enumerate(self._value):
            found[index].show_part(part, index, count, self._spec.fewest)
        self._column.show_rows(found)
        self._add.show_count(count)

    def _new_row(self) -> PartRow:
        row = PartRow(self._of, self._new_editor, self._column)
        row.edited.connect(lambda part, gesture: self._change(row, part, gesture))
        row.removed.connect(lambda: self._remove(row))
        row.stepped.connect(lambda name: self._column.step(row, name))
        row.restopped.connect(self._column.order_stops)
        row.title.pressed_key.connect(lambda name: self._press(row, name))
        self._column.take_in(row)
        return row

    def _add_part(self, name: str) -> None:
        part = new_part(self._of, name, self.holder())
        self._tell((*self._value, part), None)
        # Unless it was refused.
        if self.rows and self.rows[-1].part is self._value[-1] is part:
            self.rows[-1].set_open(True)
            self.rows[-1].title.setFocus(Qt.FocusReason.OtherFocusReason)

    def _remove(self, row: PartRow) -> None:
        if len(self._value) <= self._spec.fewest:
            self.problem_changed.emit(
                f"{self._spec.label}: {stays_words(self._spec.fewest).lower()}."
            )
            return
        self._tell(without_part(self._value, self.rows.index(row)), None)

    def _change(self, row: PartRow, part: Any, gesture: int | None) -> None:
        self._tell(with_part(self._value, self.rows.index(row), part), gesture)

    def _press(self, row: PartRow, name: str) -> None:
        if name == "open":
            row.set_open(not row.open)
        elif name == "remove":
            self._remove(row)
        else:
            self._column.step(row, name)

    def _tell(self, parts: Parts, gesture: int | None) -> None:
        if parts != self._value:
            self.problem_changed.emit("")
            self._value = parts
            self._show()
            self.edited.emit(parts, gesture)


def _rows_of(
    parts: Parts, rows: tuple[PartRow, ...], new_row: Callable[[], PartRow]
) -> tuple[PartRow, ...]:
    """A row goes on with its part, wherever that stands, or with what came to its place."""
    left = list(rows)
    found: dict[int, PartRow] = {}
    for index, part in enumerate(parts):
        own = next((row for row in left if row.part is part), None)
        if own is not None:
            found[index] = own
            left.remove(own)
    for index in range(len(parts)):
        if index not in found:
            here = [row for row in rows[index : index + 1] if row in left]
            found[index] = here[0] if here else new_row()
            left = [row for row in left if row not in here]
    return tuple(found[index] for index in range(len(parts)))
