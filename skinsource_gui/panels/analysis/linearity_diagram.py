"""Diagrams of lines and dots, with labels beside the ends of curves."""

from dataclasses import replace

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QPointF, QRectF, Qt

from skinsource_gui.fields.units import minus
from skinsource_gui.panels.analysis.linearity_content import DOT_PX, Curve, Diagram
from skinsource_gui.plots.figure import Axes, Axis, Figure, draw_legend, fitted_axes
from skinsource_gui.qt.theme import UNIT_PX, Theme, current_theme, scaled

# So much higher than a line of letters is the place of a label, and so small they become.
_LINE_STEP, _LEAST_PART = 0.9, 0.6
# Never less of the frame is left to the curves.
_LEAST_OF_CURVES = 0.3


def x_with_room_for_labels(
    axes: Axes, curves: tuple[Curve, ...], metrics: QtGui.QFontMetricsF
) -> Axis:
    """Return the x axis, longer, so that the longest label fits behind the ends of the curves."""
    labelled = [curve for curve in curves if curve.label]
    if not labelled:
        return axes.x
    needed_px = max(metrics.horizontalAdvance(curve.label) for curve in labelled) + 4.0 * DOT_PX
    part = max(1.0 - needed_px / max(axes.frame.width(), 1.0), _LEAST_OF_CURVES)
    low, last = axes.x.shown[0], max(float(curve.x[-1]) for curve in labelled)
    high = low * (last / low) ** (1.0 / part) if axes.x.log else low + (last - low) / part
    return replace(axes.x, shown=(low, float(high)))


def places_of_labels(
    axes: Axes, curves: tuple[Curve, ...], font: QtGui.QFont
) -> tuple[QtGui.QFont, list[tuple[QRectF, Curve]]]:
    """Return where labels are written, and in which font.

    Labels that overlap are moved apart, in the order of their curves. Where the frame is too low
    for all, they are smaller; those that still do not fit are left out.
    """
    ends = [
        (float(y), float(x), curve)
        for curve in curves
        if curve.label
        for x, y in axes.to_screen(curve.x[-1:], curve.y[-1:])
        if np.isfinite(y)
    ]
    if not ends:
        return font, []
    frame = axes.frame
    metrics = QtGui.QFontMetricsF(font)
    fits = frame.height() / (_LINE_STEP * metrics.height() * len(ends))
    for _, x, curve in ends:
        room_px = frame.right() - x - 2.0 * DOT_PX
        fits = min(fits, room_px / (metrics.horizontalAdvance(curve.label) + 1.0))
    letters = scaled(font, max(fits, _LEAST_PART)) if fits < 1.0 else font
    line = QtGui.QFontMetricsF(letters).height()
    step = _LINE_STEP * line
    ends = sorted(ends[: max(int(frame.height() / step + 1e-6), 1)], key=lambda end: end[0])
    heights = _moved_apart([end[0] for end in ends], step, frame.top(), frame.bottom())
    return letters, [
        (QRectF(x + 2.0 * DOT_PX, y - line / 2, frame.right() - x - 2.0 * DOT_PX, line), curve)
        for y, (_, x, curve) in zip(heights, ends, strict=True)
    ]


def write_labels(
    painter: QtGui.QPainter, axes: Axes, curves: tuple[Curve, ...], theme: Theme
) -> None:
    """Write labels in the colours of their curves."""
    letters, places = places_of_labels(axes, curves, painter.font())
    painter.save()
    painter.setFont(letters)
    for room, curve in places:
        painter.setPen(colour_of(curve, theme))
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, curve.label)
    painter.restore()


def colour_of(curve: Curve, theme: Theme) -> QtGui.QColor:
    """Return the colour of the output of a curve, or that of text."""
    return QtGui.QColor(theme.text if curve.rank is None else theme.output_colour(curve.rank))


def _moved_apart(at: list[float], step: float, top: float, bottom: float) -> list[float]:
    """Return sorted places, moved apart no farther than needed, between two ends."""
    placed: list[float] = []
    for y in at:
        placed.append(max(y, placed[-1] + step if placed else top + step / 2))
    limit = bottom - step / 2
    for k in range(len(placed) - 1, -1, -1):
        placed[k] = min(placed[k], limit)
        limit = placed[k] - step
    return placed


# Where a diagram is narrower than so many lines its letters are smaller, down to a part and to px.
_LINES_WIDE, _DIAGRAM_LEAST_PART, _LEAST_PX = 10.0, 0.5, 11.0


class DiagramsPicture(Figure):
    """Diagrams side by side where there is room, else one above the other."""

    def __init__(
        self, name: str, accessible_name: str, parent: QtWidgets.QWidget | None = None
    ) -> None:
        super().__init__(name, accessible_name, parent)
        self.diagrams: tuple[Diagram, ...] = ()
        self.outputs: tuple[int, ...] = ()
        #: Where each diagram begins, and its axes there.
        self.placed: list[tuple[QPointF, Axes]] = []

    def show_diagrams(self, diagrams: tuple[Diagram, ...], outputs: tuple[int, ...]) -> None:
        """Take over what to show, and the numbers of the outputs, in the order of their ranks."""
        self.diagrams, self.outputs = diagrams, outputs
        self.say("")
        self.read_again()

    def draw(self, painter: QtGui.QPainter, room: QRectF) -> None:
        head = room.adjusted(UNIT_PX, 0, -UNIT_PX, 0)
        head.setHeight(QtGui.QFontMetricsF(painter.font()).height())
        areas = _areas(room.adjusted(0, head.height(), 0, 0), len(self.diagrams))
        painter.setFont(font_in(areas, painter.font()))
        metrics = QtGui.QFontMetricsF(painter.font())
        draw_legend(painter, head, self.outputs, current_theme())
        self.placed = []
        for area, diagram in zip(areas, self.diagrams, strict=True):
            painter.save()
            # Labels of y begin at the left edge of their area.
            painter.translate(area.topLeft())
            inner = QRectF(QPointF(), area.size())
            axes = fitted_axes(inner, diagram.x, diagram.y, metrics)
            longer = x_with_room_for_labels(axes, diagram.curves, metrics)
            axes = fitted_axes(inner, longer, diagram.y, metrics)
            axes.paint(painter, current_theme())
            painter.setClipRect(axes.frame.adjusted(-DOT_PX, -DOT_PX, DOT_PX, DOT_PX))
            for curve in diagram.curves:
                _draw(painter, axes, curve, current_theme())
            write_labels(painter, axes, diagram.curves, current_theme())
            painter.restore()
            self.placed.append((area.topLeft(), axes))

    def read(self, at: QPointF) -> str:
        for origin, axes in self.placed:
            values = axes.value_at(at - origin)
            if values is not None:
                across, up = (
                    f"{axis.title}: {value * axis.factor:.4g}"
                    for axis, value in zip((axes.x, axes.y), values, strict=True)
                )
                return minus(f"{across} · {up}")
        return ""


def _areas(room: QRectF, count: int) -> list[QRectF]:
    """Return equal parts of a room, side by side where it is wide enough."""
    if room.width() >= room.height():
        wide = (room.width() - UNIT_PX * (count - 1)) / count
        return [
            QRectF(room.left() + k * (wide + UNIT_PX), room.top(), wide, room.height())
            for k in range(count)
        ]
    high = room.height() / count
    return [QRectF(room.left(), room.top() + k * high, room.width(), high) for k in range(count)]


def font_in(areas: list[QRectF], font: QtGui.QFont) -> QtGui.QFont:
    """Return the font, or a smaller readable one, in which numbers at axes have room."""
    wide = min((area.width() for area in areas), default=0.0)
    fits = wide / (_LINES_WIDE * QtGui.QFontMetricsF(font).height())
    least = max(_DIAGRAM_LEAST_PART, _LEAST_PX / QtGui.QFontInfo(font).pixelSize())
    return scaled(font, max(fits, least)) if max(fits, least) < 1.0 else font


def _draw(painter: QtGui.QPainter, axes: Axes, curve: Curve, theme: Theme) -> None:
    colour = colour_of(curve, theme)
    colour.setAlphaF(1.0 - curve.pale)
    if curve.width_px:
        pen = QtGui.QPen(colour, curve.width_px)
        pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
        painter.setPen(pen)
        painter.drawPolyline(axes.polygon(curve.x, curve.y))
        return
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(colour)
    for x, y in axes.to_screen(curve.x, curve.y):
        if np.isfinite(x) and np.isfinite(y):
            painter.drawEllipse(QPointF(x, y), DOT_PX, DOT_PX)
