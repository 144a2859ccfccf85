"""What edits lists of numbers: a line of text, read as one types."""

from math import inf
from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QWidget

from skinsource.base.errors import InvalidInputError
from skinsource.specs.fields import CurveSpec, ListSpec, NumberSpec, PointsSpec, TextSpec
from skinsource_gui.widgets.fields.live_text import LiveText
from skinsource_gui.widgets.fields.sweep_dialog import SweepDialog
from skinsource_gui.widgets.fields.typed_numbers import (
    as_known,
    column_words,
    numbers_text,
    points_text,
    read_numbers,
    read_points,
)

_LONGEST = 100_000


def outside_band_words(spec: NumberSpec) -> str:
    """What is said of a frequency that was not measured."""
    low_hz, high_hz = spec.felt_hz or (0.0, inf)
    return f"outside the measured band ({low_hz:g} to {high_hz:g} Hz)"


class Listed(QObject):
    """Edits a tuple as a text; told while it is typed, as soon as all of it can be read."""

    edited = Signal(object, object)
    problem_changed = Signal(str)
    label = None

    def __init__(self, spec: Any, parent: QWidget, hint: str) -> None:
        super().__init__(parent)
        self._spec = spec
        self._value: tuple[Any, ...] = ()
        read = TextSpec(
            label=spec.label, hint=hint, longest=_LONGEST, one_line=True, reader=self._read
        )
        self.line = LiveText(read, parent)
        self.line.setPlaceholderText("none")
        self.line.edited.connect(self._tell)
        self.line.problem_changed.connect(self.problem_changed)
        self.field: QWidget = self.line
        self.cancel, self.refuse = self.line.cancel, self.line.refuse

    def set_value(self, value: Any) -> None:
        """Show a value, and tell nobody; another way in which it is typed stays."""
        self._value = value or ()
        shown = self._text(self._value)
        try:
            if self._read(self.line.text()) == self._value:
                shown = self.line.text()
        except InvalidInputError:
            pass  # half typed
        self.line.set_value(shown)

    def set_spec(self, spec: Any) -> None:
        """Change what is allowed."""
        self._spec = spec

    def advice(self) -> str:
        """Nothing needs a remark."""
        return ""

    def _tell(self, text: str, gesture: int | None) -> None:
        value = self._read(text)
        if value != self._value:
            self._value = value
            self.edited.emit(value, gesture)

    def _read(self, text: str) -> tuple[Any, ...]:
        raise NotImplementedError

    def _text(self, value: tuple[Any, ...]) -> str:
        raise NotImplementedError


class NumbersEditor(Listed):
    """Edits a list of numbers; frequencies also as a sweep."""

    def __init__(self, spec: ListSpec, parent: QWidget) -> None:
        super().__init__(spec, parent, f"{spec.hint}. Numbers between commas")
        if self._spec.of.unit != "Hz":
            return
        self.field = QWidget(parent)
        row = QHBoxLayout(self.field)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(4)
        self.sweep = QPushButton("Sweep…", self.field)
        self.sweep.setToolTip("Frequencies in equal factors or steps, rising or falling")
        self.sweep.setAutoDefault(False)
        self.sweep.clicked.connect(self._ask_sweep)
        row.addWidget(self.line, 1)
        row.addWidget(self.sweep)
        self.field.setFocusProxy(self.line)

    def advice(self) -> str:
        """Warn of frequencies that were not measured."""
        outside = tuple(one for one in self._value if not self._spec.of.is_known(one))
        if not outside:
            return ""
        words = numbers_text(outside[:3], self._spec) + (" …" if len(outside) > 3 else "")
        return f"{words} Hz: {outside_band_words(self._spec.of)}"

    def _read(self, text: str) -> tuple[float, ...]:
        return read_numbers(text, self._spec)

    def _text(self, value: tuple[Any, ...]) -> str:
        return numbers_text(value, self._spec)

    def _ask_sweep(self) -> None:
        dialog = SweepDialog(self._value, self._spec, self.field.window())
        dialog.accepted.connect(lambda: self.edited.emit(dialog.values, None))
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()


class CurveText(Listed):
    """Edits the breakpoints of a curve, typed as pairs; none is allowed where the curve may be."""

    def __init__(self, spec: CurveSpec, parent: QWidget) -> None:
        self._pairs = PointsSpec(
            label=spec.label, columns=(spec.x, spec.y), fewest=spec.fewest, most=spec.most
        )
        names = ", ".join(column_words(one) for one in self._pairs.columns)
        super().__init__(spec, parent, f"{spec.hint}. Each point: {names}; semicolons between")

    def _read(self, text: str) -> tuple[tuple[float, ...], ...]:
        return as_known(read_points(text, self._pairs), self._value)

    def _text(self, value: tuple[Any, ...]) -> str:
        return points_text(value, self._pairs)
