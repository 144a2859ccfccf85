"""The plot of error against run time: all rows, with names beside those of one case."""

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter
from PySide6.QtWidgets import QWidget

from skinsource.studies.accuracy.measuring import Row, cells_of
from skinsource_gui.theme import current_theme
from skinsource_gui.widgets.figure.axes import Axes, Axis, fitted_axes
from skinsource_gui.widgets.figure.figure import Figure

_NOTHING = "Nothing is measured yet"
_LEAST_POWER, _MOST_POWER = -17.0, 1.0
_RADIUS_PX, _OTHER_RADIUS_PX, _REACH_PX = 5.0, 2.5, 12.0
#: Names rise, so that those of neighbours do not lie on each other.
_SLOPE_DEGREES = -55.0


class AccuracyPlot(Figure):
    """A point for each row; the lower left is better."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("accuracy_plot", "Error against run time", parent)
        self._rows: Sequence[Row] = ()
        self._case = ""
        self._axes: Axes | None = None
        self.say(_NOTHING)

    def show_rows(self, rows: Sequence[Row]) -> None:
        """Take over all rows."""
        self._rows = rows
        self.say("" if rows else _NOTHING)

    def show_case(self, case: str) -> None:
        """Write names beside the rows of this case."""
        self._case = case
        self.update()

    def draw(self, painter: QPainter, room: QRectF) -> None:
        metrics = QFontMetricsF(painter.font())
        times_ms = [1e3 * row.time_s for row in self._rows]
        x = Axis(
            shown=(0.5 * min(times_ms), 20.0 * max(times_ms)), title="Fastest run (ms)", log=True
        )
        y = Axis(shown=(_LEAST_POWER, _MOST_POWER), title="Error (power of ten)")
        self._axes = fitted_axes(room, x, y, metrics)
        self._axes.paint(painter, current_theme())
        points = list(zip(self._rows, self._points(self._axes), strict=True))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(current_theme().dim))
        for _, point in points:
            painter.drawEllipse(point, _OTHER_RADIUS_PX, _OTHER_RADIUS_PX)
        for row, point in points:
            if row.case == self._case:
                self._paint_named(painter, row.way, point)

    def read(self, at: QPointF) -> str:
        points = [] if self._axes is None else self._points(self._axes)
        away = [(point - at).manhattanLength() for point in points]
        if not away or min(away) > _REACH_PX:
            return ""
        row = self._rows[int(np.argmin(away))]
        case, way, error, time_ms = cells_of(row)
        return f"{case}, {way}: error {error} in {time_ms} ms"

    def keys_area(self) -> QRectF:
        return QRectF() if self._axes is None or self.message else self._axes.frame

    def _points(self, axes: Axes) -> list[QPointF]:
        errors = np.array([row.error for row in self._rows])
        powers = np.log10(np.clip(errors, 10.0**_LEAST_POWER, 10.0**_MOST_POWER))
        times_ms = np.array([1e3 * row.time_s for row in self._rows])
        return [QPointF(*place) for place in axes.to_screen(times_ms, powers)]

    def _paint_named(self, painter: QPainter, name: str, point: QPointF) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(current_theme().accent))
        painter.drawEllipse(point, _RADIUS_PX, _RADIUS_PX)
        painter.setPen(QColor(current_theme().text))
        painter.save()
        painter.translate(point)
        painter.rotate(_SLOPE_DEGREES)
        painter.drawText(QPointF(2.0 * _RADIUS_PX, _RADIUS_PX), name)
        painter.restore()
