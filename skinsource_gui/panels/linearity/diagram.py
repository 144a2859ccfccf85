"""A diagram of lines and dots, and what is drawn of it."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontInfo, QFontMetricsF, QPainter, QPen
from PySide6.QtWidgets import QWidget

from skinsource.arrays import Floats
from skinsource_gui.theme import UNIT_PX, Theme, scaled
from skinsource_gui.widgets.fields.level_text import minus
from skinsource_gui.widgets.figure.axes import Axes, Axis, fitted_axes
from skinsource_gui.widgets.figure.figure import Figure

_DOT_PX = 3.5
# Where a diagram is narrower than so many lines its letters are smaller, down to a part and to px.
_LINES_WIDE, _LEAST_PART, _LEAST_PX = 10.0, 0.5, 11.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Curve:
    """A line, or dots.

    Attributes
    ----------
    x, y : (n_points,)
        Where it goes.
    rank
        Of the output in the selection: its colour; None: that of words.
    width_px
        Of the line; 0: dots.
    label
        Written at its end.
    pale
        0 to 1: how much of the colour is left out, so that what lies over it is seen.
    """

    x: Floats
    y: Floats
    rank: int | None
    width_px: float
    pale: float = 0.0
    label: str = ""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Diagram:
    """Curves, the first lowest, over two axes."""

    x: Axis
    y: Axis
    curves: tuple[Curve, ...]


class DiagramsPicture(Figure):
    """Diagrams beside each other where there is room, else over each other."""

    def __init__(self, name: str, accessible_name: str, parent: QWidget | None = None) -> None:
        super().__init__(name, accessible_name, parent)
        self.diagrams: tuple[Diagram, ...] = ()
        self._placed: list[tuple[QPointF, Axes]] = []

    def show_diagrams(self, diagrams: tuple[Diagram, ...]) -> None:
        """Take over what to show."""
        self.diagrams = diagrams
        self.say("")
        self.read_again()

    def draw(self, painter: QPainter, room: QRectF) -> None:
        areas = _areas(room, len(self.diagrams))
        painter.setFont(font_in(areas, painter.font()))
        metrics = QFontMetricsF(painter.font())
        self._placed = []
        for area, one in zip(areas, self.diagrams, strict=True):
            painter.save()
            # Labels of y begin at the left edge of their area.
            painter.translate(area.topLeft())
            axes = fitted_axes(QRectF(QPointF(), area.size()), one.x, one.y, metrics)
            axes.paint(painter, self.theme)
            painter.setClipRect(axes.frame.adjusted(-_DOT_PX, -_DOT_PX, _DOT_PX, _DOT_PX))
            for curve in one.curves:
                _draw(painter, axes, curve, self.theme)
            _write_labels(painter, axes, one.curves, self.theme)
            painter.restore()
            self._placed.append((area.topLeft(), axes))

    def read(self, at: QPointF) -> str:
        for origin, axes in self._placed:
            found = axes.value_at(at - origin)
            if found is not None:
                across, up = (
                    f"{axis.title}: {value * axis.factor:.4g}"
                    for axis, value in zip((axes.x, axes.y), found, strict=True)
                )
                return minus(f"{across} · {up}")
        return ""


def _areas(room: QRectF, count: int) -> list[QRectF]:
    """Equal parts of a room, side by side where it is wide enough."""
    if room.width() >= room.height():
        wide = (room.width() - UNIT_PX * (count - 1)) / count
        return [
            QRectF(room.left() + k * (wide + UNIT_PX), room.top(), wide, room.height())
            for k in range(count)
        ]
    high = room.height() / count
    return [QRectF(room.left(), room.top() + k * high, room.width(), high) for k in range(count)]


def font_in(areas: list[QRectF], font: QFont) -> QFont:
    """The font, or a smaller one that can be read, in which numbers at axes have room."""
    wide = min((area.width() for area in areas), default=0.0)
    fits = wide / (_LINES_WIDE * QFontMetricsF(font).height())
    least = max(_LEAST_PART, _LEAST_PX / QFontInfo(font).pixelSize())
    return scaled(font, max(fits, least)) if max(fits, least) < 1.0 else font


def _draw(painter: QPainter, axes: Axes, curve: Curve, theme: Theme) -> None:
    colour = QColor(theme.text) if curve.rank is None else QColor(theme.output_colour(curve.rank))
    colour.setAlphaF(1.0 - curve.pale)
    if curve.width_px:
        pen = QPen(colour, curve.width_px)
        pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
        painter.setPen(pen)
        painter.drawPolyline(axes.polygon(curve.x, curve.y))
        return
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(colour)
    for x, y in axes.to_screen(curve.x, curve.y):
        if np.isfinite(x) and np.isfinite(y):
            painter.drawEllipse(QPointF(x, y), _DOT_PX, _DOT_PX)


def _write_labels(painter: QPainter, axes: Axes, curves: tuple[Curve, ...], theme: Theme) -> None:
    """Beside the ends of curves; none over another one."""
    line, taken = painter.fontMetrics().height(), list[float]()
    for curve in curves:
        if not curve.label:
            continue
        x, y = axes.to_screen(curve.x[-1:], curve.y[-1:])[0]
        room = QRectF(x + 2.0 * _DOT_PX, y - line / 2, axes.frame.right() - x, line)
        if np.isfinite(y) and not any(abs(y - other) < 0.9 * line for other in taken):
            taken.append(y)
            colour = theme.text if curve.rank is None else theme.output_colour(curve.rank)
            painter.setPen(QColor(colour))
            painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, curve.label)
