"""The points of a curve, and what is written beside the chosen one."""

from collections.abc import Collection
from functools import lru_cache

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen, QPixmap

from skinsource.base.arrays import Floats
from skinsource.specs.fields import Breakpoint
from skinsource_gui.panels.clip_editor.content import EditorContent
from skinsource_gui.panels.clip_editor.tools.curve_look import CurveLook
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.fields.units import value_text
from skinsource_gui.widgets.plot.ticks import number_text

_POINT_PX, _HOVERED_PX = 3.5, 5.0
# Room for a point and its line.
_DOT_PX = 10


def paint_points(
    painter: QPainter,
    places: tuple[Floats, Floats],
    chosen: Collection[int],
    hovered: int | None,
    look: CurveLook,
    theme: Theme,
) -> None:
    """Paint points at places in px, (n_points,) each; the chosen ones are filled."""
    x, y = places
    colour = getattr(theme, look.colour)
    painter.setPen(QPen(QColor(colour), 1.5))
    painter.setBrush(QColor(theme.base))
    dot = _dot(colour, theme.base, painter.device().devicePixelRatioF())
    for place in map(QPointF, (x - _DOT_PX / 2).tolist(), (y - _DOT_PX / 2).tolist()):
        painter.drawPixmap(place, dot)
    # The others are painted again, over those beside them.
    for index in {*chosen, *(() if hovered is None else (hovered,))}:
        if index < len(x):
            radius = _HOVERED_PX if index == hovered else _POINT_PX
            painter.setBrush(QColor(theme.accent if index in chosen else theme.base))
            painter.drawEllipse(QPointF(x[index], y[index]), radius, radius)


def write_point(
    painter: QPainter, content: EditorContent, point: Breakpoint, look: CurveLook, theme: Theme
) -> None:
    """Write where a point is, above it, on ground of its own."""
    time_s, value, kind = point
    when = value_text(time_s, "s", digits=5)
    if look.bends:
        words = f"{when} · {number_text(value, 3)} · {kind}"
    else:
        words = f"{look.label} · {when} · {value:.5g} {look.unit}".rstrip()
    at, area = content.at(time_s, value), content.area
    line = QFontMetricsF(painter.font())
    width, height = line.horizontalAdvance(words) + 12, line.height() + 4
    left = min(max(at.x() - width / 2, area.left() + 2), area.right() - width - 2)
    # Below the point where there is no room above it.
    top = at.y() - height - 10 if at.y() - height - 10 > area.top() else at.y() + 10
    room = QRectF(left, top, width, height)
    painter.setBrush(QColor(theme.raised))
    painter.setPen(QPen(QColor(theme.border), 1))
    painter.drawRect(room)
    painter.setPen(QColor(theme.text))
    painter.drawText(room, Qt.AlignmentFlag.AlignCenter, words)


@lru_cache(maxsize=8)
def _dot(line: str, ground: str, ratio: float) -> QPixmap:
    """Picture of a point, painted once."""
    dot = QPixmap(round(_DOT_PX * ratio), round(_DOT_PX * ratio))
    dot.setDevicePixelRatio(ratio)
    dot.fill(Qt.GlobalColor.transparent)
    painter = QPainter(dot)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(QPen(QColor(line), 1.5))
    painter.setBrush(QColor(ground))
    painter.drawEllipse(QPointF(_DOT_PX / 2, _DOT_PX / 2), _POINT_PX, _POINT_PX)
    painter.end()
    return dot
