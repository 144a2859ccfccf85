"""What edits the points of a glide: a line of text, and a curve of frequency and of amplitude."""

from functools import partial
from itertools import pairwise
from typing import Any

from PySide6.QtWidgets import QVBoxLayout, QWidget

from skinsource.design.effects.breakpoints import Points as Breakpoints
from skinsource.signals.synthesis import Column, Curve, bends_of, curve_of, with_curve
from skinsource.specs.fields import BreakpointsSpec, NumberSpec, PointsSpec
from skinsource_gui.widgets.fields.curve_field import CurveField
from skinsource_gui.widgets.fields.list_editors import Listed
from skinsource_gui.widgets.fields.typed_numbers import (
    as_known,
    column_words,
    points_text,
    read_points,
)
from skinsource_gui.widgets.fields.units import value_text

_COLUMNS: tuple[Column, ...] = ("frequency", "amplitude")


class GlideCurve(CurveField):
    """One of the two curves; between its points it is straight, or held until the next."""

    def __init__(self, spec: BreakpointsSpec, parent: QWidget) -> None:
        super().__init__(spec, parent)
        self._y = spec.y

    @property
    def words(self) -> str:
        """What it is of, and the chosen point."""
        chosen = self.points.chosen
        time_s, value, _ = self.value[chosen]
        place = f"{chosen + 1}/{len(self.value)}"
        shown = value_text(value, self._y.unit, digits=5)
        return f"{self._y.label} · {place} · {value_text(time_s, 's')} · {shown}"

    @property
    def curve(self) -> Curve:
        """The points, within what is allowed; a held one stays until just before the next."""
        low, high = self._y.minimum, self._y.maximum
        within = [(x, min(max(y, low), high), kind) for x, y, kind in self.value]
        found = []
        for (x, y, kind), after in pairwise(within):
            found += [(x, y), (after[0], y)] if kind == "held" else [(x, y)]
        return (*found, within[-1][:2])

    def show_curve(self, curve: Curve) -> None:
        """Show a curve, and tell nobody; a point that bends nothing yet stays."""
        if bends_of(self.curve) != curve:
            self.set_value(tuple((x, y, "straight") for x, y in curve))


class PointsEditor(Listed):
    """Edits points of time, frequency and amplitude."""

    def __init__(self, spec: PointsSpec, parent: QWidget) -> None:
        names = ", ".join(column_words(one) for one in spec.columns)
        super().__init__(spec, parent, f"{spec.hint}. Each point: {names}; semicolons between")
        self.field = QWidget(parent)
        column = QVBoxLayout(self.field)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        column.addWidget(self.line)
        self.curves: dict[Column, GlideCurve] = {}
        for name, one in zip(_COLUMNS, spec.columns[1:], strict=False):
            curve = GlideCurve(_spec_of(spec.columns[0], one), self.field)
            curve.setObjectName(f"{name}_curve")
            curve.edited.connect(partial(self._draw, name))
            self.curves[name] = curve
            column.addWidget(curve)
        self.field.setFocusProxy(self.line)

    def set_value(self, value: Any) -> None:
        """Show points, and tell nobody."""
        super().set_value(value)
        for name, curve in self.curves.items() if value else ():
            curve.show_curve(curve_of(value, name))

    def _draw(self, name: Column, _points: Breakpoints, gesture: int | None) -> None:
        points = with_curve(self._value, name, self.curves[name].curve)
        if points != self._value:
            self._value = points
            self.edited.emit(points, gesture)

    def _read(self, text: str) -> tuple[tuple[float, ...], ...]:
        return as_known(read_points(text, self._spec), self._value)

    def _text(self, value: tuple[Any, ...]) -> str:
        return points_text(value, self._spec)


def _spec_of(time: NumberSpec, column: NumberSpec) -> BreakpointsSpec:
    hint = f"{column.label} over time, straight from point to point"
    return BreakpointsSpec(label=column.label, hint=hint, x=time, y=column)
