"""The canvas of the clip editor: one clip with its axes, and the spectrum below it."""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from pyqtgraph.functions import arrayToQPath
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QLineF, QObject, QPointF, QRectF, QSize, Qt, Signal

from skinsource.base.conventions import Band, Floats
from skinsource.design.clips import Clip
from skinsource.signals.spectra import share_outside_band
from skinsource_gui.fields.units import axis_unit
from skinsource_gui.plots.curves import visible_course
from skinsource_gui.plots.plot import Canvas, CanvasItem
from skinsource_gui.plots.preview import SpectrumPreview
from skinsource_gui.plots.ranges import Points, columns_of, linear_ticks, wave_of, within
from skinsource_gui.plots.time_scale import Range, TimeScale, panned, range_by_wheel, zoomed
from skinsource_gui.qt.buttons import passing_menu
from skinsource_gui.qt.frames import CachedPicture, Same
from skinsource_gui.qt.labels import FittingLabel
from skinsource_gui.qt.layouts import in_column, named, show_tooltip
from skinsource_gui.qt.theme import (
    Theme,
    current_theme,
    dots_in_px,
    is_on_paper,
    scaled,
    set_tone,
    tabular,
    thin_pen,
)

#: Values up to this are always visible, so that there is room to draw.
REACH = 1.1


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EditorContent:
    """One clip, and where it is painted.

    Attributes
    ----------
    drawn : (n_times,)
        What it would play if effects did nothing but trim, or None where that is not known.
    played : (n_times,)
        What the clip plays after its effects, or None.
    sample_rate_hz
        Rate of both.
    scale
        From the clip's own time to pixels.
    area
        Where the curve is, px.
    low, high
        The values at its lower and its upper edge.
    """

    clip: Clip
    drawn: Floats | None
    played: Floats | None
    sample_rate_hz: float
    scale: TimeScale = field(default_factory=lambda: TimeScale(shown_s=(0.0, 1.0)))
    area: QRectF = field(default_factory=QRectF)
    low: float = -REACH
    high: float = REACH

    @property
    def px_per_value(self) -> float:
        """Height of a value of 1, px."""
        return self.area.height() / (self.high - self.low)

    def y(self, value: float) -> float:
        """Return the height of a value, px."""
        return self.area.bottom() - (value - self.low) * self.px_per_value

    def value(self, y_px: float) -> float:
        """Return the value at a height."""
        return self.low + (self.area.bottom() - y_px) / self.px_per_value

    def at(self, time_s: float, value: float) -> QPointF:
        """Return the place of a value at a time, px."""
        return QPointF(self.scale.x(time_s), self.y(value))

    def curve(self, times_s: Floats, values: Floats) -> tuple[Floats, Floats]:
        """Return the places of values at times, (n,) each, px."""
        x = self.scale.left_px + (times_s - self.scale.shown_s[0]) * self.scale.px_per_s
        return x, self.area.bottom() - (values - self.low) * self.px_per_value

    def place(self, at: QPointF) -> tuple[float, float]:
        """Return time and value at a place."""
        return self.scale.time(at.x()), self.value(at.y())


def reach_of(*signals: Floats | None) -> float:
    """Return the largest value to show: round, and never less than a peak of 1 needs."""
    peaks = [
        float(np.abs(signal).max()) for signal in signals if signal is not None and signal.size
    ]
    peak = max(peaks, default=0.0)
    if peak <= 1.0:
        return REACH
    step = 10.0 ** np.floor(np.log10(peak)) / 2
    return float(np.ceil(peak * 1.02 / step) * step)


Modifier = Qt.KeyboardModifier
Button = Qt.MouseButton


class Tool(QObject):
    """What the pointer does in the editor; this one does nothing.

    Attributes
    ----------
    cursor
        Shape of the pointer.
    """

    cursor = Qt.CursorShape.ArrowCursor

    @property
    def hint(self) -> str:
        """Return how to begin, while nothing has begun; empty where that is clear."""
        return ""

    def press(self, content: EditorContent, at: QPointF, button: Button, held: Modifier) -> None:
        """Begin what a button does that goes down."""

    def move(self, content: EditorContent, at: QPointF, held: Modifier) -> None:
        """Follow the pointer, with a button down or without."""

    def release(self, content: EditorContent) -> None:
        """End what the button did."""

    def double_click(self, content: EditorContent, at: QPointF) -> None:
        """Do what a double click with the left button does."""

    def fill_menu(self, menu: QtWidgets.QMenu, content: EditorContent, at: QPointF | None) -> None:
        """Fill the menu of the right button there, or that of what the keys are about.

        A tool that needs the button itself offers nothing.
        """

    def cancel(self) -> bool:
        """Give up what has begun; return whether anything had."""
        return False

    def paint(self, painter: QtGui.QPainter, content: EditorContent, theme: Theme) -> None:
        """Paint what belongs to the tool over the curve."""


_TICK_PX, _ROW_PX = 64.0, 28.0
_PALE = 0.4
_UPDATING, _GREY = "updating…", "grey: before effects"
# From so many px for each sample on, all are marked.
_DOTS_PX = 6.0


class EditorItem(CanvasItem):
    """Paints a clip and what its tool shows."""

    def __init__(self) -> None:
        super().__init__()
        self._content: EditorContent | None = None
        self._tool: Tool | None = None
        self._stale = False
        # What the pointer leaves as it is: axes, the waveform, and what it plays.
        self._course = CachedPicture()

    def show_content(self, content: EditorContent | None, tool: Tool, rect: QRectF) -> None:
        """Paint something else, in this rectangle."""
        self._set_rect(rect)
        self._content, self._tool = content, tool
        self.update()

    def show_staleness(self, stale: bool) -> None:
        """Show whether the curve belongs to an older design."""
        if stale != self._stale:
            self._stale = stale
            self.update()

    def paint(self, painter: QtGui.QPainter, option: Any, widget: Any) -> None:
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
        painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().border), 1))
        painter.drawRect(content.area)

    def _paint_course(self, painter: QtGui.QPainter, content: EditorContent) -> None:
        """Paint what the clip plays, over what it would play without effects."""
        played, ground = content.played, QtGui.QColor(current_theme().base)
        drawn = content.drawn
        place = (current_theme().name, content.scale, content.area, content.high)

        def paint_course(on_image: QtGui.QPainter) -> None:
            self._paint_axes(on_image, content)
            on_image.setClipRect(content.area.adjusted(-1, -1, 1, 1))
            self._paint_end(on_image, content)
            if drawn is not None and drawn is not played:
                dim = QtGui.QColor(current_theme().dim)
                self._paint_curve(on_image, content, drawn, dim, _PALE)
                on_image.setPen(dim)
                corner = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignBottom
                on_image.drawText(content.area.adjusted(4, 0, 0, -2), corner, _GREY)
            if played is not None:
                opacity = _PALE if self._stale else 1.0
                self._paint_curve(
                    on_image, content, played, QtGui.QColor(current_theme().accent), opacity
                )
            if self._stale:
                on_image.setPen(QtGui.QColor(current_theme().dim))
                corner = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignTop
                on_image.drawText(content.area.adjusted(0, 2, -4, 0), corner, _UPDATING)

        # Samples are compared by identity: an array is never changed in place.
        key = (*place, content.sample_rate_hz, Same(drawn), Same(played), self._stale)
        self._course.paint(painter, self._rect, key, paint_course, ground)

    def _paint_axes(self, painter: QtGui.QPainter, content: EditorContent) -> None:
        area, metrics = content.area, QtGui.QFontMetricsF(self._font)
        grid, text_colour = (
            QtGui.QPen(QtGui.QColor(current_theme().grid), 1),
            QtGui.QColor(current_theme().dim),
        )
        values = linear_ticks(content.low, content.high, max(area.height() / _ROW_PX, 2))
        for tick in values:
            y = content.y(tick.value)
            painter.setPen(grid)
            painter.drawLine(QLineF(area.left(), y, area.right(), y))
            painter.setPen(text_colour)
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
                painter.setPen(text_colour)
                painter.drawText(QPointF(left, area.bottom() + metrics.ascent() + 3), tick.label)
                free_from = left + width + 6
        painter.setPen(text_colour)
        painter.drawText(QPointF(unit_left, area.bottom() + metrics.ascent() + 3), unit)
        painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().border), 1))
        painter.drawLine(QLineF(area.left(), content.y(0.0), area.right(), content.y(0.0)))

    def _paint_end(self, painter: QtGui.QPainter, content: EditorContent) -> None:
        """Shade what lies behind the end of the clip."""
        played = content.played
        if played is None:
            return
        end = content.scale.x(played.size / content.sample_rate_hz)
        if end < content.area.right():
            behind = QRectF(content.area)
            behind.setLeft(max(end, content.area.left()))
            painter.fillRect(behind, QtGui.QColor(current_theme().window))

    def _paint_curve(
        self,
        painter: QtGui.QPainter,
        content: EditorContent,
        samples: Floats,
        colour: QtGui.QColor,
        opacity: float,
    ) -> None:
        if not samples.size:
            return
        ratio, width_px = dots_in_px(painter), content.area.width()
        time_s = np.arange(samples.size) / content.sample_rate_hz
        wave, across = wave_of(time_s, samples[np.newaxis]), max(round(width_px * ratio), 1)
        columns = columns_of(time_s, content.scale.shown_s, across)
        curve = visible_course(columns, samples[np.newaxis], wave, width_px, ratio)
        x, y = content.curve(curve.line.x, curve.line.y[0])
        painter.setOpacity(opacity)
        sharp = curve.line.strokes and not is_on_paper()
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing, not sharp)
        painter.setPen(thin_pen(colour))
        if x.size == 1:
            painter.drawLine(QLineF(x[0], content.y(0.0), x[0], y[0]))
        else:
            painter.drawPath(arrayToQPath(x, y, finiteCheck=False))
        if not curve.line.strokes and content.scale.px_per_s / content.sample_rate_hz >= _DOTS_PX:
            self._paint_samples(painter, content, columns.points(samples[np.newaxis]))
        painter.setOpacity(1.0)

    def _paint_samples(
        self, painter: QtGui.QPainter, content: EditorContent, points: Points
    ) -> None:
        """Mark each sample."""
        painter.setBrush(painter.pen().color())
        for place in zip(*content.curve(points.x, points.y[0]), strict=True):
            painter.drawEllipse(QPointF(*place), 2, 2)
        painter.setBrush(Qt.BrushStyle.NoBrush)


# Behind the end there is room to draw on.
_BEHIND = 0.06
_LEAST_S = 0.01


_TEXT = 0.9
_LEFT_PX, _RIGHT_PX, _TOP_PX, _BOTTOM_PX = 40.0, 10.0, 6.0, 20.0


class EditorView(Canvas):
    """One clip over its own time; the tool decides what the pointer does.

    Attributes
    ----------
    item
        The layer that is painted.
    content
        What is shown; None where there is no clip.
    tool
        The tool that is used.
    """

    key_place = "clip_editor"

    #: The key event of a key that belongs to the editor.
    key_pressed = Signal(object)

    def __init__(self, tool: Tool) -> None:
        super().__init__()
        named(self, "clip_editor_view", "Waveform of the clip")
        self.setMouseTracking(True)
        self.setMinimumSize(160, 80)
        self.item = EditorItem()
        self.addItem(self.item)
        self.tool = tool
        self.content: EditorContent | None = None
        # The visible part of the time; None: all of the clip.
        self._shown_s: Range | None = None
        # Whether it stays during a drag, with the height of the values.
        self._held = False
        self.update_style()

    def show_clip(
        self, clip: Clip | None, drawn: Floats | None, played: Floats | None, rate_hz: float
    ) -> None:
        """Show a clip: its samples before its effects, and after them, (n_times,)."""
        before = self.content
        if clip is None or before is None or clip.id != before.clip.id:
            self._shown_s = None
        if clip is None:
            self.content = None
        else:
            content = EditorContent(clip=clip, drawn=drawn, played=played, sample_rate_hz=rate_hz)
            if before is not None:
                content = replace(content, scale=before.scale, high=before.high)
            self.content = content
        self.lay_out()

    def use(self, tool: Tool) -> None:
        """Use another tool."""
        self.tool.cancel()
        self.tool = tool
        self.viewport().setCursor(tool.cursor)
        self.lay_out()

    def pan(self, by_s: float) -> None:
        """See what lies so much later; what is held, too, goes along with what drags it."""
        content = self.content
        if content is not None:
            whole_s = self._whole_s(content)
            shown_s = panned(content.scale.shown_s, by_s, whole_s)
            self.content = replace(
                content, scale=replace(content.scale, shown_s=shown_s or whole_s)
            )
            self._show_part(shown_s)

    def zoom(self, factor: float) -> None:
        """See so many times less, around the middle."""
        if self.content is not None:
            shown = self.content.scale.shown_s
            whole_s = self._whole_s(self.content)
            self._show_part(zoomed(shown, sum(shown) / 2, factor, whole_s))

    def show_everything(self) -> None:
        """See all of the clip."""
        self._show_part(None)

    def update_style(self) -> None:
        super().update_style()
        self.item.show_font(scaled(tabular(self.font()), _TEXT))

    def cancel(self) -> bool:
        """Cancel what the tool has begun; return whether anything had."""
        cancelled = self.tool.cancel()
        self._release()
        return cancelled

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        event.accept()
        if self.content is not None:
            # Nothing moves under the pen, however long or loud the clip becomes.
            self._held = True
            self.tool.press(self.content, event.position(), event.button(), event.modifiers())
            self.lay_out()

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        event.accept()
        if self.content is not None:
            self.tool.move(self.content, event.position(), event.modifiers())
            self.item.update()

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        event.accept()
        if self.content is not None:
            self.tool.release(self.content)
        self._release()

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        event.accept()
        if self.content is not None and event.button() == Qt.MouseButton.LeftButton:
            self.tool.double_click(self.content, event.position())
            self.lay_out()

    def contextMenuEvent(self, event: QtGui.QContextMenuEvent) -> None:
        event.accept()
        if self.content is None:
            return
        by_key = event.reason() == QtGui.QContextMenuEvent.Reason.Keyboard
        menu = passing_menu(self, "clip_editor_menu")
        self.tool.fill_menu(menu, self.content, None if by_key else QPointF(event.pos()))
        if menu.isEmpty():
            # The right button belongs to the tool.
            menu.deleteLater()
            return
        # The menu takes the release of the button.
        self._release()
        menu.popup(event.globalPos())

    def wheelEvent(self, event: QtGui.QWheelEvent) -> None:
        event.accept()
        if self.content is not None:
            whole_s = self._whole_s(self.content)
            self._show_part(range_by_wheel(event, self.content.scale, whole_s))

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.cancel():
            return
        event.ignore()
        self.key_pressed.emit(event)

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        if self.content is not None and not self._held:
            self.tool.move(self.content, QPointF(-1, -1), Qt.KeyboardModifier.NoModifier)
            self.item.update()

    def lay_out(self) -> None:
        room, content = QRectF(self.rect()), self.content
        if content is not None:
            area = room.adjusted(_LEFT_PX, _TOP_PX, -_RIGHT_PX, -_BOTTOM_PX)
            shown_s, high = content.scale.shown_s, content.high
            if not self._held:
                shown_s, high = self._whole_s(content), reach_of(content.drawn, content.played)
                if self._shown_s is not None:
                    shown_s = within(self._shown_s, shown_s) or shown_s
            scale = TimeScale(shown_s=shown_s, left_px=area.left(), width_px=max(area.width(), 1.0))
            self.content = replace(content, area=area, scale=scale, low=-high, high=high)
        self.item.show_content(self.content, self.tool, room)

    def _whole_s(self, content: EditorContent) -> Range:
        signals = (content.drawn, content.played)
        counts = [samples.size for samples in signals if samples is not None]
        length = max(max(counts, default=0) / content.sample_rate_hz, _LEAST_S)
        return (0.0, length * (1 + _BEHIND))

    def _show_part(self, shown_s: Range | None) -> None:
        self._shown_s = shown_s
        self.lay_out()

    def _release(self) -> None:
        """Let the visible part follow the clip again."""
        self._held = False
        self.lay_out()


# Above this share a designer has to know: the actuator, or the skin model, sees it.
_NOTEWORTHY = 0.01


class SpectrumStrip(QtWidgets.QWidget):
    """The spectrum of a clip, and how much of its energy lies outside the measured band.

    Attributes
    ----------
    outside
        Share of the energy outside the band, from 0 to 1.
    """

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("clip_spectrum")
        self._preview, self._label = SpectrumPreview(), FittingLabel()
        self._preview.setAccessibleName("Spectrum of the clip")
        self.setMinimumHeight(78)
        in_column(self._label, (self._preview, 1), of=self, margins=0, gap_px=0)
        self.outside = 0.0
        self._shown: tuple[object, ...] = ()

    def sizeHint(self) -> QSize:
        return QSize(200, 106)

    def show_samples(
        self, samples: Floats | None, sample_rate_hz: float, band_hz: Band | None
    ) -> None:
        """Show the spectrum of ``samples``, (n_times,), and the share of energy out of band.

        Where the band of the limb is not known, ``band_hz`` is None and there is no share.
        """
        shown = Same(samples), sample_rate_hz, band_hz
        if shown == self._shown:
            return
        self._shown, self.outside = shown, 0.0
        text, short = "The measured band of this limb is unknown", "Band not known"
        if samples is not None and not samples.size:
            samples = None
        if band_hz is not None:
            if samples is not None:
                self.outside = share_outside_band(samples, sample_rate_hz, band_hz)
            share = 100 * self.outside
            number = "0" if share == 0 else "< 0.1" if share < 0.1 else f"{share:.3g}"
            text = f"{number} % outside {band_hz[0]:g} to {band_hz[1]:g} Hz"
            short = f"{number} % outside the band"
        self._preview.show_samples(samples, sample_rate_hz, band_hz)
        self._label.show_phrases((text, short))
        set_tone(self._label, "warning" if self.outside > _NOTEWORTHY else "dim")
        show_tooltip(self, text)
