"""The fields of one recipe, and of those that it holds, as cells in reading order."""

from dataclasses import replace
from functools import partial
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QApplication

from skinsource.base.errors import InvalidInputError
from skinsource.base.quoting import sentence
from skinsource.design.edits.edit import as_kind
from skinsource.design.edits.effects import choices_of
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.fields import ListSpec, RecipeSpec, Spec, specs_of
from skinsource_gui.widgets.fields.edited_cell import EditedCell
from skinsource_gui.widgets.fields.editor import NewEditor


class PartFields(QObject):
    """Cells for the kind and the fields of a recipe of ``spec``.

    What it holds stands first, then its own numbers and choices, then its lists.
    """

    #: The recipe as it is changed; number of the gesture or None.
    edited = Signal(object, object)
    #: Other cells are to be shown; those that are gone will be deleted.
    rebuilt = Signal()

    def __init__(self, spec: RecipeSpec, new_editor: NewEditor, parent: QObject) -> None:
        super().__init__(parent)
        self._spec, self._new_editor = spec, new_editor
        self._recipe: Any = None
        self._built_for: type | None = None
        self._own: dict[str, EditedCell] = {}
        self._held: dict[str, PartFields] = {}
        self._last = ""
        self._kind: EditedCell | None = None
        if len(spec.kinds()) > 1:
            self._kind = self._cell("kind", choices_of(spec))
            self._kind.edited.connect(self._change_kind)

    @property
    def cells(self) -> tuple[EditedCell, ...]:
        """All cells, in reading order."""
        kind = () if self._kind is None else (self._kind,)
        held = [cell for one in self._held.values() for cell in one.cells]
        plain = [cell for cell in self._own.values() if not cell.across]
        lists = [cell for cell in self._own.values() if cell.across]
        return (*kind, *held, *plain, *lists)

    def show_recipe(self, recipe: Any) -> None:
        """Show a recipe's values, and tell nobody."""
        self._recipe = recipe
        if type(recipe) is not self._built_for:
            self._build(recipe)
        if self._kind is not None:
            self._kind.set_value(type(recipe).__name__)
        for name, cell in self._own.items():
            cell.set_value(getattr(recipe, name))
        for name, held in self._held.items():
            held.show_recipe(getattr(recipe, name))

    def set_spec(self, spec: RecipeSpec) -> None:
        """Take over the rate of another limb."""
        self._spec = spec
        specs = specs_of(self._built_for) if self._built_for else {}
        for name, cell in self._own.items():
            cell.set_spec(self._at_rate(specs[name]))
        for name, held in self._held.items():
            held.set_spec(self._at_rate(specs[name]))

    def show_reason(self, reason: str) -> None:
        """Say at the field that was edited last why it stays as it was."""
        if self._last in self._held:
            self._held[self._last].show_reason(reason)
        elif self._last in self._own:
            self._own[self._last].show_reason(reason)
        elif self._kind is not None:
            self._kind.show_reason(reason)

    def forget_typing(self) -> None:
        """Close an open editor without committing."""
        for cell in self.cells:
            cell.forget_typing()

    def _build(self, recipe: Any) -> None:
        old = self._held.values()
        own: dict[str, EditedCell] = {}
        gone = [cell for cell in self.cells if cell is not self._kind]
        held: dict[str, PartFields] = {}
        for name, spec in specs_of(recipe).items():
            if isinstance(spec, RecipeSpec):
                held[name] = PartFields(self._at_rate(spec), self._new_editor, self)
                held[name].edited.connect(partial(self._change, name))
                held[name].rebuilt.connect(self.rebuilt)
            elif spec.asked:
                own[name] = self._cell(name, self._at_rate(spec))
                own[name].edited.connect(self._change)
                editor: Any = own[name].editor
                if isinstance(spec, ListSpec) and spec.nests:
                    editor.holder = lambda: self._recipe
        self._own, self._held, self._built_for = own, held, type(recipe)
        focused = QApplication.focusWidget()
        within = focused is not None and any(cell.isAncestorOf(focused) for cell in gone)
        if within and self._kind is not None:
            self._kind.field.setFocus(Qt.FocusReason.OtherFocusReason)
        self.rebuilt.emit()
        for part in (widget for cell in gone for widget in (cell.label, cell)):
            part.deleteLater()
        for one in old:
            one.deleteLater()

    def _cell(self, name: str, spec: Spec) -> EditedCell:
        cell = EditedCell(name, spec, self._new_editor)
        # The clip itself has fields of these names, too.
        cell.field.setObjectName(f"part_{name}_field")
        return cell

    def _at_rate(self, spec: Any) -> Any:
        rate_hz = self._spec.rate_hz
        return spec if rate_hz is None else spec.at_rate(rate_hz, self._spec.band_hz)

    def _change(self, name: str, value: object, gesture: int | None) -> None:
        self._last = name
        try:
            after = replace(self._recipe, **{name: value})
        except InvalidInputError as error:
            self._refuse(sentence(str(error)))
            return
        self._tell(after, gesture)

    def _change_kind(self, _: str, name: str, gesture: int | None) -> None:
        self._last = "kind"
        kind = next(one for one in self._spec.kinds() if one.__name__ == name)
        rate_hz = self._spec.rate_hz or facts_of("").sample_rate_hz
        self._tell(as_kind(self._recipe, kind, rate_hz), gesture)

    def _refuse(self, reason: str) -> None:
        self.show_recipe(self._recipe)
        self.show_reason(reason)

    def _tell(self, after: Any, gesture: int | None) -> None:
        if after != self._recipe:
            self._recipe = after
            self.edited.emit(after, gesture)
