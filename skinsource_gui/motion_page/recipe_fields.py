"""The fields of one recipe in a grid."""

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QApplication

from skinsource.specs.fields import ChoiceSpec, Spec, specs_of
from skinsource_gui.widgets.fields.field_cell import FieldCell
from skinsource_gui.widgets.fields.field_grid import FieldGrid

#: Changes a specification to what counts here; None leaves the field out.
Adapt = Callable[[str, Spec], Spec | None]


class RecipeFields(QObject):
    """Cells for the kind and the fields of a recipe, made anew when it is of another kind.

    Parameters
    ----------
    adapt
        What is allowed here for each field.

    Attributes
    ----------
    grid
        Where the cells stand.
    """

    #: Name of a kind.
    kind_chosen = Signal(str)
    #: Name of the field and its new value.
    edited = Signal(str, object)

    def __init__(self, adapt: Adapt, parent: QObject) -> None:
        super().__init__(parent)
        self._adapt = adapt
        self._cells: tuple[FieldCell, ...] = ()
        self._built_for: tuple[type, ChoiceSpec] | None = None
        self.grid = FieldGrid()

    @property
    def cells(self) -> tuple[FieldCell, ...]:
        """The kind, and the fields."""
        return self._cells

    def show_recipe(self, recipe: Any, kinds: ChoiceSpec) -> None:
        """Show a recipe's values; ``kinds`` is what it may be."""
        if self._built_for != (type(recipe), kinds):
            self._build(recipe, kinds)
        kind, *others = self._cells
        kind.set_value(type(recipe).__name__)
        for cell in others:
            cell.set_value(getattr(recipe, cell.name))

    def show_refused(self, recipe: Any, name: str, reason: str) -> None:
        """Show again what ``recipe`` has in this field, and why it stays so."""
        kind, *others = self._cells
        if name == kind.name:
            kind.set_value(type(recipe).__name__)
            kind.show_reason(reason)
        for cell in others:
            if cell.name == name:
                cell.set_value(getattr(recipe, name))
                cell.show_reason(reason)

    def _build(self, recipe: Any, kinds: ChoiceSpec) -> None:
        old = self._cells
        # The list in which a kind was just chosen keeps the keyboard.
        kept = old[:1] if self._built_for is not None and self._built_for[1] == kinds else ()
        kind = kept[0] if kept else FieldCell("kind", kinds)
        if not kept:
            kind.edited.connect(self._tell_kind)
        cells = [kind]
        for name, spec in specs_of(recipe).items():
            adapted = self._adapt(name, spec)
            if adapted is not None:
                cell = FieldCell(name, adapted)
                cell.edited.connect(self._tell)
                cells.append(cell)
        self._cells, self._built_for = tuple(cells), (type(recipe), kinds)
        gone = [cell for cell in old if cell not in cells]
        focused = QApplication.focusWidget()
        if focused is not None and any(cell.isAncestorOf(focused) for cell in gone):
            kind.field.setFocus(Qt.FocusReason.OtherFocusReason)
        self.grid.show_cells(self._cells)
        for part in (widget for cell in gone for widget in (cell.label, cell)):
            part.deleteLater()

    def _tell_kind(self, _: str, kind: str, __: object) -> None:
        self.kind_chosen.emit(kind)

    def _tell(self, name: str, value: object, _: object) -> None:
        self.edited.emit(name, value)
