"""The editors of fields of a model: one for each kind of specification."""

from collections.abc import Callable
from functools import partial
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import Qt

from skinsource.base.quoting import printable
from skinsource.design.edits.edit import KindSpec
from skinsource.specs.breakpoints import BreakpointsSpec
from skinsource.specs.numbers import (
    CurveSpec,
    ListSpec,
    ModelSpec,
    NumberSpec,
    OptionalSpec,
    PointsSpec,
)
from skinsource.specs.spec import ChoiceSpec, Spec, SwitchSpec, TextSpec, made_for
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.curve_field import CurveField
from skinsource_gui.fields.editor import Editor
from skinsource_gui.fields.grid import EditedCell
from skinsource_gui.fields.kinds import KindField
from skinsource_gui.fields.list_editors import CurveText, NumbersEditor, PointsEditor
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.fields.parts import PartsEditor
from skinsource_gui.fields.text_field import LiveText
from skinsource_gui.fields.units import value_text
from skinsource_gui.qt.layouts import named
from skinsource_gui.qt.tooltips import tooltip


class SwitchField(Editor, QtWidgets.QCheckBox):
    """Edits a value that is on or off."""

    def __init__(self, spec: SwitchSpec, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        named(self, title=spec.label, hint=tooltip(spec.label, spec.hint))
        self.clicked.connect(lambda on: self.edited.emit(on, None))

    def set_value(self, value: bool) -> None:
        """Show whether it is on, without a signal."""
        self.setChecked(value)


class TextLine(Editor, QtWidgets.QLineEdit):
    """Edits one line of text; the signal comes when typing ends."""

    def __init__(self, spec: TextSpec, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self._shown = ""
        self.setMaxLength(spec.longest)
        named(self, title=spec.label, hint=tooltip(spec.label, spec.hint))
        self.editingFinished.connect(self._tell)

    def set_value(self, value: str) -> None:
        """Show another text without a signal; what is being typed stays."""
        if value != self._shown:
            self._shown = value
            self.setText(value)

    def cancel(self) -> None:
        """Restore the text."""
        self.setText(self._shown)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        super().keyPressEvent(event)
        if event.key() == Qt.Key.Key_Escape:
            self.cancel()

    def _tell(self) -> None:
        if self.text() != self._shown:
            self._shown = self.text()
            self.edited.emit(self._shown, None)


class ValueLabel(Editor, QtWidgets.QLabel):
    """Shows a value that cannot be edited here."""

    def __init__(self, spec: Spec, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        named(self, title=spec.label, hint=tooltip(spec.label, spec.hint))
        of = spec.of if isinstance(spec, OptionalSpec) else spec
        self._unit = of.unit if isinstance(of, NumberSpec) else None

    def set_value(self, value: object) -> None:
        """Show a value as text."""
        if value in (None, ()):
            self.setText("none")
        elif self._unit is not None and isinstance(value, float):
            self.setText(value_text(value, self._unit, 6))
        else:
            self.setText(printable(value))


def text_editor(spec: TextSpec, parent: QtWidgets.QWidget) -> Editor:
    """Make the editor of a text; one with a reader is read while it is typed."""
    return TextLine(spec, parent) if spec.reader is None else LiveText(spec, parent)


def list_editor(spec: ListSpec, parent: QtWidgets.QWidget) -> Editor:
    """Make the editor of a list of numbers or of models; other lists are only shown."""
    if isinstance(spec.of, ModelSpec):
        return PartsEditor(spec, spec.of, new_editor, parent)
    if isinstance(spec.of, NumberSpec):
        return NumbersEditor(spec, parent)
    return ValueLabel(spec, parent)


#: The editor for each kind of specification.
EDITORS: dict[Any, Callable[[Any, QtWidgets.QWidget], Editor]] = {
    NumberSpec: partial(NumberField, problem_beside=True),
    ChoiceSpec: ChoiceField,
    KindSpec: KindField,
    SwitchSpec: SwitchField,
    TextSpec: text_editor,
    BreakpointsSpec: CurveField,
    ListSpec: list_editor,
    PointsSpec: PointsEditor,
    CurveSpec: CurveText,
    # Values without an editor, such as samples, are only shown.
    Spec: ValueLabel,
}


def new_editor(spec: Spec, parent: QtWidgets.QWidget) -> Editor:
    """Make the editor for a field; a value without one is only shown."""
    return made_for(spec, EDITORS)(spec, parent)


class FieldCell(EditedCell):
    """A labelled cell with the editor for ``spec``; ``edited`` gets its signals."""

    def __init__(
        self, name: str, spec: Spec, parent: QtWidgets.QWidget | None = None, *, edited: Any = None
    ) -> None:
        super().__init__(name, spec, new_editor, parent)
        if edited is not None:
            self.edited.connect(edited)
