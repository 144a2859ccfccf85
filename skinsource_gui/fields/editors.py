"""The editors of fields of a model: one for each kind of specification."""

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QCheckBox, QLabel, QLineEdit, QWidget

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
from skinsource_gui.fields.list_editors import (
    CurveText,
    NumbersEditor,
    PointsEditor,
    outside_band_text,
)
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.fields.parts import PartsEditor
from skinsource_gui.fields.text_field import LiveText
from skinsource_gui.fields.units import value_text
from skinsource_gui.qt.tooltips import tooltip


class NumberEditor(QObject):
    """Edits a number."""

    edited = Signal(object, object)
    problem_changed = Signal(str)
    label = None

    def __init__(self, spec: NumberSpec, parent: QWidget) -> None:
        super().__init__(parent)
        self.field = NumberField(spec, parent, problem_beside=True)
        self.field.edited.connect(self.edited.emit)
        self.field.problem_changed.connect(self.problem_changed)
        self.set_value, self.set_spec = self.field.set_value, self.field.set_spec
        self.cancel = self.field.cancel_editing

    def mark_error(self, reason: str) -> None:
        """Do nothing: the field shows the value again."""

    def advice(self) -> str:
        """Warn of frequencies that were not measured."""
        spec = self.field.spec
        return "" if spec.is_known(self.field.value_si) else outside_band_text(spec)


class _PlainEditor(QObject):
    """Base of editors of values that cannot be entered wrongly."""

    edited = Signal(object, object)
    problem_changed = Signal(str)
    label = None

    def set_spec(self, spec: Any) -> None:
        """Do nothing: the specification does not depend on the design."""

    def advice(self) -> str:
        """Return no remark."""
        return ""

    def mark_error(self, reason: str) -> None:
        """Do nothing: the field shows the value again."""

    def cancel(self) -> None:
        """Do nothing: an input is complete at once."""


class ChoiceEditor(_PlainEditor):
    """Chooses one of several names."""

    def __init__(self, spec: ChoiceSpec, parent: QWidget) -> None:
        super().__init__(parent)
        self.field = ChoiceField(spec, parent)
        self.field.chosen.connect(self.edited.emit)
        self.set_value = self.field.set_value

    def set_spec(self, spec: ChoiceSpec) -> None:
        """Offer other names."""
        self.field.offer(spec)


class KindEditor(_PlainEditor):
    """Chooses a kind of waveform."""

    def __init__(self, spec: KindSpec, parent: QWidget) -> None:
        super().__init__(parent)
        self.field = KindField(spec, parent)
        self.field.chosen.connect(self.edited.emit)
        self.set_value = self.field.set_value


class SwitchEditor(_PlainEditor):
    """Edits a value that is on or off."""

    def __init__(self, spec: SwitchSpec, parent: QWidget) -> None:
        super().__init__(parent)
        self.field = QCheckBox(parent)
        self.field.setAccessibleName(spec.label)
        self.field.setToolTip(tooltip(spec.label, spec.hint))
        self.field.clicked.connect(self._tell)
        self.set_value = self.field.setChecked

    def _tell(self, on: bool) -> None:
        self.edited.emit(on, None)


class TextEditor(_PlainEditor):
    """Edits one line of text; the signal comes when typing ends."""

    def __init__(self, spec: TextSpec, parent: QWidget) -> None:
        super().__init__(parent)
        self._shown = ""
        self.field = QLineEdit(parent)
        self.field.setMaxLength(spec.longest)
        self.field.setAccessibleName(spec.label)
        self.field.setToolTip(tooltip(spec.label, spec.hint))
        self.field.editingFinished.connect(self._tell)

    def set_value(self, value: str) -> None:
        """Show a text without a signal."""
        self._shown = value
        self.field.setText(value)

    def cancel(self) -> None:
        """Restore the text."""
        self.field.setText(self._shown)

    def _tell(self) -> None:
        if self.field.text() != self._shown:
            self._shown = self.field.text()
            self.edited.emit(self._shown, None)


class LiveTextEditor(QObject):
    """Edits a text with a reader; signals come while it is typed."""

    edited = Signal(object, object)
    problem_changed = Signal(str)
    label = None

    def __init__(self, spec: TextSpec, parent: QWidget) -> None:
        super().__init__(parent)
        self.field = LiveText(spec, parent)
        self.field.edited.connect(self.edited.emit)
        self.field.problem_changed.connect(self.problem_changed)
        self.set_value, self.mark_error = self.field.set_value, self.field.mark_error
        self.cancel = self.field.cancel

    def set_spec(self, spec: TextSpec) -> None:
        """Do nothing: the specification does not depend on the design."""

    def advice(self) -> str:
        """Return no remark."""
        return ""


class CurveEditor(_PlainEditor):
    """Edits breakpoints."""

    def __init__(self, spec: BreakpointsSpec, parent: QWidget) -> None:
        super().__init__(parent)
        self.field = CurveField(spec, parent)
        self.field.edited.connect(self.edited.emit)
        self.set_value = self.field.set_value

    def cancel(self) -> None:
        """End a drag."""
        self.field.cancel()


class ShownOnly(_PlainEditor):
    """Shows a value that cannot be edited here."""

    def __init__(self, spec: Spec, parent: QWidget) -> None:
        super().__init__(parent)
        self.field = QLabel(parent)
        self.field.setAccessibleName(spec.label)
        self.field.setToolTip(tooltip(spec.label, spec.hint))
        of = spec.of if isinstance(spec, OptionalSpec) else spec
        self._unit = of.unit if isinstance(of, NumberSpec) else None

    def set_value(self, value: object) -> None:
        """Show a value as text."""
        if value in (None, ()):
            self.field.setText("none")
        elif self._unit is not None and isinstance(value, float):
            self.field.setText(value_text(value, self._unit, 6))
        else:
            self.field.setText(printable(value))


def text_editor(spec: TextSpec, parent: QWidget) -> Editor:
    """Make the editor of a text; one with a reader is read while it is typed."""
    return TextEditor(spec, parent) if spec.reader is None else LiveTextEditor(spec, parent)


def list_editor(spec: ListSpec, parent: QWidget) -> Editor:
    """Make the editor of a list of numbers or of models; other lists are only shown."""
    if isinstance(spec.of, ModelSpec):
        return PartsEditor(spec, spec.of, new_editor, parent)
    if isinstance(spec.of, NumberSpec):
        return NumbersEditor(spec, parent)
    return ShownOnly(spec, parent)


#: The editor for each kind of specification.
EDITORS: dict[Any, Callable[[Any, QWidget], Editor]] = {
    NumberSpec: NumberEditor,
    ChoiceSpec: ChoiceEditor,
    KindSpec: KindEditor,
    SwitchSpec: SwitchEditor,
    TextSpec: text_editor,
    BreakpointsSpec: CurveEditor,
    ListSpec: list_editor,
    PointsSpec: PointsEditor,
    CurveSpec: CurveText,
    # Values without an editor, such as samples, are only shown.
    Spec: ShownOnly,
}


def new_editor(spec: Spec, parent: QWidget) -> Editor:
    """Make the editor for a field; a value without one is only shown."""
    return made_for(spec, EDITORS)(spec, parent)


class FieldCell(EditedCell):
    """A labelled cell with the editor for ``spec``."""

    def __init__(self, name: str, spec: Spec, parent: QWidget | None = None) -> None:
        super().__init__(name, spec, new_editor, parent)
