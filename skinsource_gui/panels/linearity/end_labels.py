"""Labels beside the ends of curves: whole, in the frame, and none over another one."""

from dataclasses import replace

import numpy as np
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter

from skinsource_gui.panels.linearity.curve import DOT_PX, Curve
from skinsource_gui.theme import Theme, scaled
from skinsource_gui.widgets.figure.axes import Axes, Axis

# So much higher than a line of letters is the place of a label, and so small they become.
_APART, _LEAST_PART = 0.9, 0.6
# Never less of the frame is left to the curves.
_LEAST_OF_CURVES = 0.3


def x_with_room_for_labels(axes: Axes, curves: tuple[Curve, ...], metrics: QFontMetricsF) -> Axis:
    """The x axis, on until the longest label fits between the ends of curves and the frame."""
    labelled = [curve for curve in curves if curve.label]
    if not labelled:
        return axes.x
    needed_px = max(metrics.horizontalAdvance(one.label) for one in labelled) + 4.0 * DOT_PX
    part = max(1.0 - needed_px / max(axes.frame.width(), 1.0), _LEAST_OF_CURVES)
    low, last = axes.x.shown[0], max(float(one.x[-1]) for one in labelled)
    high = low * (last / low) ** (1.0 / part) if axes.x.log else low + (last - low) / part
    return replace(axes.x, shown=(low, float(high)))


def places_of_labels(
    axes: Axes, curves: tuple[Curve, ...], font: QFont
) -> tuple[QFont, list[tuple[QRectF, Curve]]]:
    """Where labels are written, and in which letters.

    Those that would lie on each other move apart, in the order of their curves; where the frame
    is too low for all they are smaller, and then the rest is left out.
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
    metrics = QFontMetricsF(font)
    fits = frame.height() / (_APART * metrics.height() * len(ends))
    for _, x, curve in ends:
        room_px = frame.right() - x - 2.0 * DOT_PX
        fits = min(fits, room_px / (metrics.horizontalAdvance(curve.label) + 1.0))
    letters = scaled(font, max(fits, _LEAST_PART)) if fits < 1.0 else font
    line = QFontMetricsF(letters).height()
    apart = _APART * line
    ends = sorted(ends[: max(int(frame.height() / apart + 1e-6), 1)], key=lambda one: one[0])
    return letters, [
        (QRectF(x + 2.0 * DOT_PX, y - line / 2, frame.right() - x - 2.0 * DOT_PX, line), curve)
        for y, (_, x, curve) in zip(
            _apart([one[0] for one in ends], apart, frame.top(), frame.bottom()), ends, strict=True
        )
    ]


def write_labels(painter: QPainter, axes: Axes, curves: tuple[Curve, ...], theme: Theme) -> None:
    """Write labels in the colours of their curves."""
    letters, places = places_of_labels(axes, curves, painter.font())
    painter.save()
    painter.setFont(letters)
    for room, curve in places:
        painter.setPen(colour_of(curve, theme))
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, curve.label)
    painter.restore()


def colour_of(curve: Curve, theme: Theme) -> QColor:
    """Of its output, or that of words."""
    return QColor(theme.text if curve.rank is None else theme.output_colour(curve.rank))


def _apart(at: list[float], apart: float, top: float, bottom: float) -> list[float]:
    """Sorted places, moved apart no farther than needed, between two ends."""
    placed: list[float] = []
    for wish in at:
        placed.append(max(wish, placed[-1] + apart if placed else top + apart / 2))
    limit = bottom - apart / 2
    for k in range(len(placed) - 1, -1, -1):
        placed[k] = min(placed[k], limit)
        limit = placed[k] - apart
    return placed
