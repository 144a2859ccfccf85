"""One recipe of a list."""

from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from skinsource.design.edits.effects import part_words
from skinsource.specs.fields import RecipeSpec
from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.fields.editor import NewEditor
from skinsource_gui.widgets.fields.field_grid import FieldGrid
from skinsource_gui.widgets.fields.parts.part_fields import PartFields
from skinsource_gui.widgets.fields.parts.row_title import RowTitle
from skinsource_gui.widgets.inputs.letter_button import LetterButton, remove_button
from skinsource_gui.widgets.keys import key_text
from skinsource_gui.widgets.tooltips import tooltip

PLACE = "parts"


class PartRow(QWidget):
    """Name of a part, buttons that move and remove it, and its fields while it is open.

    The fields are made when they are shown first.

    Attributes
    ----------
    part
        What it shows.
    title
        The name; tells of drags and keys.
    """

    #: A key of the table: up or down.
    stepped = Signal(str)
    removed = Signal()
    #: The part as it is changed; number of the gesture or None.
    edited = Signal(object, object)
    #: The Tab key has other stops.
    restopped = Signal()

    def __init__(self, spec: RecipeSpec, new_editor: NewEditor, parent: QWidget) -> None:
        super().__init__(parent)
        self._spec, self._new_editor = spec, new_editor
        self.part: Any = None
        self._fields: PartFields | None = None
        self.title = RowTitle("", PLACE, "in the list")
        self._up = _step_button("↑", "Move up", "shift_up")
        self._down = _step_button("↓", "Move down", "shift_down")
        self._remove = remove_button()
        self._grid = FieldGrid()
        self._grid.hide()
        head = QHBoxLayout()
        head.setContentsMargins(0, 0, 0, 0)
        head.setSpacing(0)
        for part in (self.title, self._up, self._down, self._remove):
            head.addWidget(part, 1 if part is self.title else 0)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(UNIT_PX // 4)
        column.addLayout(head)
        column.addWidget(self._grid)
        # Whose fields they are.
        self._grid.set_margins(UNIT_PX, 0, 0, UNIT_PX // 2)
        self.title.opened.connect(self._open)
        self._up.clicked.connect(lambda: self.stepped.emit("shift_up"))
        self._down.clicked.connect(lambda: self.stepped.emit("shift_down"))
        self._remove.clicked.connect(self.removed)

    @property
    def stops(self) -> tuple[QWidget, ...]:
        """Where the Tab key stops, in order."""
        cells = self._fields.cells if self._fields is not None else ()
        return (self.title, self._up, self._down, self._remove, *(cell.field for cell in cells))

    @property
    def open(self) -> bool:
        """Whether its fields are shown."""
        return self.title.open

    @property
    def fields(self) -> PartFields | None:
        """Its fields, once they were shown."""
        return self._fields

    def show_part(self, part: Any, index: int, count: int, fewest: int) -> None:
        """Show another part, the ``index``-th of ``count``, of which ``fewest`` have to stay."""
        self.part = part
        self.title.set_words(f"{index + 1} · {part_words(part)}")
        name = f"{self._spec.label.lower()} {index + 1}"
        for button, can in ((self._up, index > 0), (self._down, index < count - 1)):
            if button.hasFocus() and not can:
                self.title.setFocus(Qt.FocusReason.OtherFocusReason)
            button.setEnabled(can)
        self._remove.setEnabled(count > fewest)
        words = f"Remove {name} ({key_text(PLACE, 'remove')})"
        self._remove.setToolTip(tooltip(words if count > fewest else stays_words(fewest)))
        self._remove.setAccessibleName(f"Remove {name}")
        if self._fields is not None:
            self._fields.show_recipe(part)

    def set_open(self, open_: bool) -> None:
        """Show its fields, or hide them."""
        self.title.set_open(open_)

    def set_spec(self, spec: RecipeSpec) -> None:
        """Take over the rate of another limb."""
        self._spec = spec
        if self._fields is not None:
            self._fields.set_spec(spec)

    def forget_typing(self) -> None:
        """Close an open editor without committing."""
        if self._fields is not None:
            self._fields.forget_typing()

    def _open(self, open_: bool) -> None:
        if open_ and self._fields is None:
            self._fields = PartFields(self._spec, self._new_editor, self)
            self._fields.edited.connect(self.edited)
            self._fields.rebuilt.connect(self._show_cells)
            self._fields.show_recipe(self.part)
        focused = self.focusWidget()
        if not open_ and focused is not None and self._grid.isAncestorOf(focused):
            self.title.setFocus(Qt.FocusReason.OtherFocusReason)
        self._grid.setVisible(open_)

    def _show_cells(self) -> None:
        if self._fields is not None:
            self._grid.show_cells(self._fields.cells)
        self.restopped.emit()


def stays_words(fewest: int) -> str:
    """Why the last parts cannot be removed."""
    return f"At least {fewest} {'has' if fewest == 1 else 'have'} to stay"


def _step_button(letter: str, name: str, key: str) -> LetterButton:
    button = LetterButton(letter, name)
    button.setObjectName(f"{key}_button")
    button.setToolTip(tooltip(f"{name} ({key_text(PLACE, key)})"))
    return button
