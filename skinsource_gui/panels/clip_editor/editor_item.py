"""The curve of one clip, with its axes."""

from typing import Any

import numpy as np
import pyqtgraph
from pyqtgraph.functions import arrayToQPath
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPen

from skinsource.base.arrays import Floats
from skinsource_gui.panels.clip_editor.content import EditorContent
from skinsource_gui.panels.clip_editor.tools.tool import Tool
from skinsource_gui.theme import current_theme
from skinsource_gui.widgets.fields.units import axis_unit
from skinsource_gui.widgets.kept_picture import KeptPicture, Same
from skinsource_gui.widgets.paper import dots_in_px, is_on_paper, thin_pen
from skinsource_gui.widgets.plot.curve_points import course_of
from skinsource_gui.widgets.plot.decimation import Points, columns_of
from skinsource_gui.widgets.plot.ticks import linear_ticks
from skinsource_gui.widgets.plot.wave import wave_of

_TICK_PX, _ROW_PX = 64.0, 28.0
_PALE = 0.4
_UPDATING = "updating…"
# From so many px for each sample on, all are marked.
_DOTS_PX = 6.0


class EditorItem(pyqtgraph.GraphicsObject):
    """Paints a clip and what its tool shows; knows nothing of the mouse."""

    def __init__(self) -> None:
        super().__init__()
        self._content: EditorContent | None = None
        self._tool: Tool | None = None
        self._font = QFont()
        self._rect = QRectF(0, 0, 1, 1)
        self._late = False
        # What the drag of a point leaves as it is: axes, the waveform, and what it plays.
        self._still, self._course = KeptPicture(), KeptPicture()

    def show_content(self, content: EditorContent | None, tool: Tool, rect: QRectF) -> None:
        """Paint something else, in this rectangle."""
        if rect != self._rect:
            self.prepareGeometryChange()
            self._rect = rect
        self._content, self._tool = content, tool
        self.update()

    def show_font(self, font: QFont) -> None:
        """Take over a font."""
        self._font = font
        self.update()

    def show_late(self, late: bool) -> None:
        """Whether the curve belongs to an older design."""
        if late != self._late:
            self._late = late
            self.update()

    def boundingRect(self) -> QRectF:
        return self._rect

    def paint(self, painter: QPainter, option: Any, widget: Any) -> None:
        content, tool = self._content, self._tool
        if content is None or tool is None:
            return
        painter.setFont(self._font)
        self._paint_course(painter, content)
        painter.save()
        painter.setClipRect(content.area.adjusted(-1, -1, 1, 1))
        tool.paint(painter, content, current_theme())
        painter.restore()
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(QColor(current_theme().border), 1))
        painter.drawRect(content.area)

    def _paint_course(self, painter: QPainter, content: EditorContent) -> None:
        """Paint what the clip plays, over its waveform before any effect."""
        played, ground = content.played, QColor(current_theme().base)
        drawn = content.drawn
        n_played = None if played is None else played.size
        place = (current_theme().name, content.scale, content.area, content.reach)
        # Samples by identity: an array that is kept here cannot become another one.
        still = (*place, content.sample_rate_hz, n_played, Same(content.drawn))
        is_other = content.drawn is not None and content.drawn is not played

        def paint_still(on_image: QPainter) -> None:
            self._paint_axes(on_image, content)
            on_image.setClipRect(content.area.adjusted(-1, -1, 1, 1))
            self._paint_end(on_image, content)
            if drawn is not None and is_other:
                dim = QColor(current_theme().dim)
                self._paint_curve(on_image, content, drawn, dim, _PALE)

        def paint_course(on_image: QPainter) -> None:
            self._still.paint(on_image, self._rect, (*still, is_other), paint_still, ground)
            on_image.setClipRect(content.area.adjusted(-1, -1, 1, 1))
            if played is not None:
                opacity = _PALE if self._late else 1.0
                self._paint_curve(
                    on_image, content, played, QColor(current_theme().accent), opacity
                )
            if self._late:
                on_image.setPen(QColor(current_theme().dim))
                corner = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignTop
                on_image.drawText(content.area.adjusted(0, 2, -4, 0), corner, _UPDATING)

        key = (*still, is_other, Same(played), self._late)
        self._course.paint(painter, self._rect, key, paint_course, ground)

    def _paint_axes(self, painter: QPainter, content: EditorContent) -> None:
        area, metrics = content.area, QFontMetricsF(self._font)
        grid, words = QPen(QColor(current_theme().grid), 1), QColor(current_theme().dim)
        values = linear_ticks(-content.reach, content.reach, max(area.height() / _ROW_PX, 2))
        for tick in values:
            y = content.y(tick.value)
            painter.setPen(grid)
            painter.drawLine(QLineF(area.left(), y, area.right(), y))
            painter.setPen(words)
            room = QRectF(0, y - metrics.height() / 2, area.left() - 4, metrics.height())
            painter.drawText(
                room, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, tick.label
            )
        shown = content.scale.shown_s
        unit, factor = axis_unit(shown[1])
        ticks = linear_ticks(*shown, max(area.width() / _TICK_PX, 2), factor)
        unit_left = area.right() - metrics.horizontalAdvance(unit)
        free_from = area.left() - 20
        for tick in ticks:
            x = content.scale.x(tick.value)
            painter.setPen(grid)
            painter.drawLine(QLineF(x, area.top(), x, area.bottom()))
            width = metrics.horizontalAdvance(tick.label)
            left = x - width / 2
            if left >= free_from and left + width < unit_left - 4:
                painter.setPen(words)
                painter.drawText(QPointF(left, area.bottom() + metrics.ascent() + 3), tick.label)
                free_from = left + width + 6
        painter.setPen(words)
        painter.drawText(QPointF(unit_left, area.bottom() + metrics.ascent() + 3), unit)
        painter.setPen(QPen(QColor(current_theme().border), 1))
        painter.drawLine(QLineF(area.left(), content.y(0.0), area.right(), content.y(0.0)))

    def _paint_end(self, painter: QPainter, content: EditorContent) -> None:
        """Shade what lies behind the end of the clip."""
        played = content.played
        if played is None:
            return
        end = content.scale.x(played.size / content.sample_rate_hz)
        if end < content.area.right():
            behind = QRectF(content.area)
            behind.setLeft(max(end, content.area.left()))
            painter.fillRect(behind, QColor(current_theme().window))

    def _paint_curve(
        self,
        painter: QPainter,
        content: EditorContent,
        samples: Floats,
        colour: QColor,
        opacity: float,
    ) -> None:
        if not samples.size:
            return
        ratio, width_px = dots_in_px(painter), content.area.width()
        time_s = np.arange(samples.size) / content.sample_rate_hz
        wave, across = wave_of(time_s, samples[np.newaxis]), max(round(width_px * ratio), 1)
        found = columns_of(time_s, content.scale.shown_s, across)
        seen = course_of(found, samples[np.newaxis], wave, width_px, ratio)
        x, y = _places(content, seen.line)
        painter.setOpacity(opacity)
        sharp = seen.line.strokes and not is_on_paper()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, not sharp)
        painter.setPen(thin_pen(colour))
        if x.size == 1:
            painter.drawLine(QLineF(x[0], content.y(0.0), x[0], y[0]))
        else:
            painter.drawPath(arrayToQPath(x, y, finiteCheck=False))
        if not seen.line.strokes and content.scale.px_per_s / content.sample_rate_hz >= _DOTS_PX:
            self._paint_samples(painter, *_places(content, found.points(samples[np.newaxis])))
        painter.setOpacity(1.0)

    def _paint_samples(self, painter: QPainter, x: Floats, y: Floats) -> None:
        """Mark each sample."""
        painter.setBrush(painter.pen().color())
        for place in zip(x, y, strict=True):
            painter.drawEllipse(QPointF(*place), 2, 2)
        painter.setBrush(Qt.BrushStyle.NoBrush)


def _places(content: EditorContent, points: Points) -> tuple[Floats, Floats]:
    """Where points of the curve are, px."""
    scale, area = content.scale, content.area
    x = scale.left_px + (points.x - scale.shown_s[0]) * scale.px_per_s
    return x, area.center().y() - points.y[0] / content.reach * area.height() / 2
