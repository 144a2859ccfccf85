"""The editors of fields of a model: one for each kind of specification.

Lists are typed as a line of text: numbers, curves, and points of a glide.  `SweepDialog` makes
frequencies in equal steps or factors.
"""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import pairwise
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, Qt

from skinsource.base.errors import InvalidInputError, printable
from skinsource.design.display_units import value_text
from skinsource.design.edits.edit import KindSpec
from skinsource.design.effects.breakpoints import Points as Breakpoints
from skinsource.design.waveforms.wavelet_train import frequency_sweep
from skinsource.signals.synthesis import Column, Curve, bends_of, curve_of, with_curve
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
from skinsource_gui.fields.editor import MIXED, Editor
from skinsource_gui.fields.grid import EditedCell, label_of
from skinsource_gui.fields.kinds import KindField
from skinsource_gui.fields.number_field import NumberField, outside_band_text
from skinsource_gui.fields.parts import PartsEditor
from skinsource_gui.fields.text_field import UNDOING, LiveText
from skinsource_gui.fields.units import (
    as_known,
    column_label,
    number_of,
    numbers_text,
    points_text,
    read_numbers,
    read_points,
)
from skinsource_gui.qt.buttons import answers, page_label, tool_button
from skinsource_gui.qt.layouts import in_column, in_row, named, tooltip
from skinsource_gui.qt.resources import choice_of
from skinsource_gui.qt.theme import tabular

_SPACING = choice_of("sweep_spacing")
_ORDER = choice_of("sweep_order")
_MOST_SHOWN = 12


class SweepDialog(QtWidgets.QDialog):
    """Asks for the ends of a sweep, the number of frequencies, their spacing and their order."""

    def __init__(
        self, values: tuple[float, ...], spec: ListSpec, parent: QtWidgets.QWidget
    ) -> None:
        super().__init__(parent)
        self._spec = spec
        self.setObjectName("sweep_dialog")
        self.setWindowTitle("Generate frequencies")
        count = NumberSpec(
            label="Count", minimum=max(spec.fewest, 1), maximum=spec.most, whole=True
        )
        self.low = NumberField(replace(number_of(spec), label="From"), self)
        self.high = NumberField(replace(number_of(spec), label="To"), self)
        self.count = NumberField(count, self)
        self.spacing, self.order = ChoiceField(_SPACING, self), ChoiceField(_ORDER, self)
        self.low.set_value(min(values, default=50.0))
        self.high.set_value(max(values, default=400.0))
        self.count.set_value(len(values) or 5)
        self.spacing.set_value("logarithmic")
        falls = len(values) > 1 and values[0] > values[-1]
        self.order.set_value("down" if falls else "up")
        self._list = page_label("sweep_list")
        self._list.setMinimumWidth(260)
        form = QtWidgets.QFormLayout(self)
        for field in (self.low, self.high, self.count, self.spacing, self.order):
            field.setObjectName(f"{field.accessibleName().lower()}_sweep")
            field.edited.connect(self._show_list)
            form.addRow(field.accessibleName(), field)
        form.addRow(self._list)
        form.addRow(answers(self))
        self._show_list()

    @property
    def values(self) -> tuple[float, ...]:
        """The frequencies, in Hz."""
        low, high = sorted((self.low.value_si, self.high.value_si))
        values = frequency_sweep(
            low,
            high,
            round(self.count.value_si),
            "linear" if self.spacing.value == "linear" else "logarithmic",
            "down" if self.order.value == "down" else "up",
        )
        # Ends stay exact; others have a tenth of a hertz where that is small beside all steps.
        coarse = min((abs(b - a) for a, b in pairwise(values)), default=0.0) >= 1.0
        inner = [round(hz, 1) if coarse else float(f"{hz:.5g}") for hz in values[1:-1]]
        return (values[0], *inner, *values[1:][-1:])

    def _show_list(self, *_: object) -> None:
        values = self.values
        more = f" … ({len(values)})" if len(values) > _MOST_SHOWN else ""
        self._list.setText(f"{numbers_text(values[:_MOST_SHOWN], self._spec)}{more} Hz")


_LONGEST = 100_000


class ListEditor(Editor, QtWidgets.QWidget):
    """Base of editors of a tuple as a text; signals come while it is typed, if it is valid.

    Attributes
    ----------
    value
        The tuple that was set or typed last.
    """

    def __init__(
        self, spec: Any, parent: QtWidgets.QWidget, hint: str, unset: str = "none"
    ) -> None:
        super().__init__(parent)
        self._spec, self._unset = spec, unset
        self.value: tuple[Any, ...] = ()
        self._typed = ""
        read = TextSpec(
            label=spec.label, hint=hint, longest=_LONGEST, one_line=True, reader=self._read
        )
        self.line = LiveText(read, self)
        self.line.setPlaceholderText(unset)
        self.line.edited.connect(self._tell)
        self.line.problem_changed.connect(self.problem_changed)
        self.setFocusProxy(self.line)
        self.line.setFont(tabular(self.font()))
        self.column = in_column(self.line, of=self, margins=0, gap_px=4)

    def set_value(self, value: Any) -> None:
        """Show a value without a signal; a typed text with the same value stays."""
        self.value = value or ()
        shown = self._text(self.value)
        for text in (self._typed, self.line.text()):
            with suppress(InvalidInputError):  # an incomplete text
                if self._read(text) == self.value:
                    shown = text
        self.line.set_value(shown)

    def set_spec(self, spec: Any) -> None:
        """Change the allowed values."""
        self._spec = spec

    def mark_error(self, reason: str) -> None:
        """Mark the place that a reason names."""
        self.line.mark_error(reason)

    def show_mixed(self, mixed: bool) -> None:
        """Say "mixed" in an empty line, or show the value."""
        self.line.show_mixed(mixed, self._unset)

    def cancel(self) -> None:
        """Restore the value."""
        self.line.cancel()

    def _tell(self, text: str, gesture: int | None) -> None:
        value, self._typed = self._read(text), text
        if value != self.value:
            self.value = value
            self.edited.emit(value, gesture)

    def _read(self, text: str) -> tuple[Any, ...]:
        raise NotImplementedError

    def _text(self, value: tuple[Any, ...]) -> str:
        raise NotImplementedError


class NumbersEditor(ListEditor):
    """Edits a list of numbers; frequencies also as a sweep."""

    def __init__(self, spec: ListSpec, parent: QtWidgets.QWidget) -> None:
        super().__init__(spec, parent, f"{spec.hint}. Numbers between commas", spec.unset)
        if self._spec.of.unit != "Hz":
            return
        hint = "Generate frequencies, logarithmic or linear, rising or falling"
        self.sweep = tool_button(self, "sweep", "Sweep…", hint)
        self.sweep.clicked.connect(self._ask_sweep)
        # The line has the whole width.
        self.label = QtWidgets.QLabel(label_of(spec))
        self.column.insertLayout(0, in_row((self.label, 1), self.sweep, margins=0, gap_px=4))

    def advice(self) -> str:
        """Warn of frequencies that were not measured."""
        outside = tuple(value for value in self.value if not self._spec.of.is_known(value))
        if not outside:
            return ""
        text = numbers_text(outside[:3], self._spec) + (" …" if len(outside) > 3 else "")
        return f"{text} Hz: {outside_band_text(self._spec.of)}"

    def _read(self, text: str) -> tuple[float, ...]:
        return read_numbers(text, self._spec)

    def _text(self, value: tuple[Any, ...]) -> str:
        return numbers_text(value, self._spec)

    def _ask_sweep(self) -> None:
        dialog = SweepDialog(self.value, self._spec, self.window())
        dialog.accepted.connect(lambda: self.edited.emit(dialog.values, None))
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()


class CurveText(ListEditor):
    """Edits the breakpoints of a curve, typed as pairs."""

    def __init__(self, spec: CurveSpec | PointsSpec, parent: QtWidgets.QWidget) -> None:
        names = ", ".join(column_label(column) for column in spec.columns)
        super().__init__(spec, parent, f"{spec.hint}. Each point: {names}; semicolons between")

    def _read(self, text: str) -> tuple[tuple[float, ...], ...]:
        return as_known(read_points(text, self._spec), self.value)

    def _text(self, value: tuple[Any, ...]) -> str:
        return points_text(value, self._spec)


_COLUMNS: tuple[Column, ...] = ("frequency", "amplitude")


class GlideCurve(CurveField):
    """The curve of frequency or amplitude; between points it is straight or held."""

    def __init__(self, spec: BreakpointsSpec, parent: QtWidgets.QWidget) -> None:
        super().__init__(spec, parent)
        self._y = spec.y

    @property
    def text(self) -> str:
        """The quantity and the chosen point."""
        chosen = self.chosen
        time_s, value, _ = self.value[chosen]
        place = f"{chosen + 1}/{len(self.value)}"
        shown = value_text(value, self._y.unit, digits=5)
        return f"{self._y.label} · {place} · {value_text(time_s, 's')} · {shown}"

    @property
    def curve(self) -> Curve:
        """The points within the allowed range; a held value stays until just before the next."""
        low, high = self._y.minimum, self._y.maximum
        within = [(x, min(max(y, low), high), kind) for x, y, kind in self.value]
        points = []
        for (x, y, kind), after in pairwise(within):
            points += [(x, y), (after[0], y)] if kind == "held" else [(x, y)]
        return (*points, within[-1][:2])

    def show_curve(self, curve: Curve) -> None:
        """Show a curve without a signal; a new point on a straight line stays."""
        if bends_of(self.curve) != curve:
            self.set_value(tuple((x, y, "straight") for x, y in curve))


class PointsEditor(CurveText):
    """Edits points of time, frequency and amplitude, as a text and as two curves."""

    def __init__(self, spec: PointsSpec, parent: QtWidgets.QWidget) -> None:
        super().__init__(spec, parent)
        self.curves: dict[Column, GlideCurve] = {}
        for name, column_spec in zip(_COLUMNS, spec.columns[1:], strict=False):
            curve = named(GlideCurve(_spec_of(spec.columns[0], column_spec), self), f"{name}_curve")
            curve.edited.connect(partial(self._draw, name))
            self.curves[name] = curve
            self.column.addWidget(curve)

    def set_value(self, value: Any) -> None:
        """Show points without a signal."""
        super().set_value(value)
        for name, curve in self.curves.items() if value else ():
            curve.show_curve(curve_of(value, name))

    def _draw(self, name: Column, _points: Breakpoints, gesture: int | None) -> None:
        points = with_curve(self.value, name, self.curves[name].curve)
        if points != self.value:
            self.value = points
            self.edited.emit(points, gesture)


def _spec_of(time: NumberSpec, column: NumberSpec) -> BreakpointsSpec:
    hint = f"{column.label} over time, straight from point to point"
    return BreakpointsSpec(label=column.label, hint=hint, x=time, y=column)


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
    """Edits one line of text; the signal comes when typing ends, and undo is the design's then."""

    def __init__(self, spec: TextSpec, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self._value = ""
        self.setMaxLength(spec.longest)
        named(self, title=spec.label, hint=tooltip(spec.label, spec.hint))
        self.editingFinished.connect(self._tell)

    def set_value(self, value: str) -> None:
        """Show another text without a signal; what is being typed stays."""
        if value != self._value:
            self._value = value
            self.cancel()

    def show_mixed(self, mixed: bool) -> None:
        """Say "mixed" in an empty line, or show the text."""
        said = MIXED if mixed else ""
        if said != self.placeholderText():
            self.setPlaceholderText(said)
            self.cancel()

    def cancel(self) -> None:
        """Restore the text; nothing is left that was typed, also not to be undone."""
        self.setText(self._shown)

    def event(self, event: QEvent) -> bool:
        undoes = isinstance(event, QtGui.QKeyEvent) and any(map(event.matches, UNDOING))
        if event.type() == QEvent.Type.ShortcutOverride and undoes and self.text() == self._shown:
            event.ignore()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        super().keyPressEvent(event)
        if event.key() == Qt.Key.Key_Escape:
            self.cancel()

    @property
    def _shown(self) -> str:
        return "" if self.placeholderText() else self._value

    def _tell(self) -> None:
        if self.text() != self._shown:
            self._value = self.text()
            self.show_mixed(False)
            self.cancel()
            self.edited.emit(self._value, None)


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

    def __init__(self, name: str, spec: Spec, *, edited: Any = None) -> None:
        super().__init__(name, spec, new_editor)
        if edited is not None:
            self.edited.connect(edited)
