"""Diagrams of lines and dots, as they are drawn."""

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFont, QFontInfo, QFontMetricsF, QPainter, QPen
from PySide6.QtWidgets import QWidget

from skinsource_gui.panels.linearity.curve import DOT_PX, Curve, Diagram
from skinsource_gui.panels.linearity.end_labels import (
    colour_of,
    write_labels,
    x_with_room_for_labels,
)
from skinsource_gui.theme import UNIT_PX, Theme, current_theme, scaled
from skinsource_gui.widgets.fields.level_text import minus
from skinsource_gui.widgets.figure.axes import Axes, fitted_axes
from skinsource_gui.widgets.figure.figure import Figure
from skinsource_gui.widgets.figure.output_legend import draw_legend

# Where a diagram is narrower than so many lines its letters are smaller, down to a part and to px.
_LINES_WIDE, _LEAST_PART, _LEAST_PX = 10.0, 0.5, 11.0


class DiagramsPicture(Figure):
    """Diagrams beside each other where there is room, else over each other."""

    def __init__(self, name: str, accessible_name: str, parent: QWidget | None = None) -> None:
        super().__init__(name, accessible_name, parent)
        self.diagrams: tuple[Diagram, ...] = ()
        self.outputs: tuple[int, ...] = ()
        self._placed: list[tuple[QPointF, Axes]] = []

    def show_diagrams(self, diagrams: tuple[Diagram, ...], outputs: tuple[int, ...]) -> None:
        """Take over what to show, and the numbers of the outputs, in the order of their ranks."""
        self.diagrams, self.outputs = diagrams, outputs
        self.say("")
        self.read_again()

    def draw(self, painter: QPainter, room: QRectF) -> None:
        head = room.adjusted(UNIT_PX, 0, -UNIT_PX, 0)
        head.setHeight(QFontMetricsF(painter.font()).height())
        areas = _areas(room.adjusted(0, head.height(), 0, 0), len(self.diagrams))
        painter.setFont(font_in(areas, painter.font()))
        metrics = QFontMetricsF(painter.font())
        draw_legend(painter, head, self.outputs, current_theme())
        self._placed = []
        for area, one in zip(areas, self.diagrams, strict=True):
            painter.save()
            # Labels of y begin at the left edge of their area.
            painter.translate(area.topLeft())
            inner = QRectF(QPointF(), area.size())
            axes = fitted_axes(inner, one.x, one.y, metrics)
            longer = x_with_room_for_labels(axes, one.curves, metrics)
            axes = fitted_axes(inner, longer, one.y, metrics)
            axes.paint(painter, current_theme())
            painter.setClipRect(axes.frame.adjusted(-DOT_PX, -DOT_PX, DOT_PX, DOT_PX))
            for curve in one.curves:
                _draw(painter, axes, curve, current_theme())
            write_labels(painter, axes, one.curves, current_theme())
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
    colour = colour_of(curve, theme)
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
            painter.drawEllipse(QPointF(x, y), DOT_PX, DOT_PX)
