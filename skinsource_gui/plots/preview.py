"""Small pictures of what a design plays: a spectrum, and clips on tracks."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache, partial

import numpy as np
from pyqtgraph.functions import arrayToQPath
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QLineF, QPointF, QRectF, QSize, QSizeF, Qt

from skinsource.base.conventions import SAMPLE_RATE_HZ, Band, Floats
from skinsource.design.clips import Clip, Fragment
from skinsource.design.effects.playing import played
from skinsource.engine.memory import Memory
from skinsource_gui.fields.units import axis_unit
from skinsource_gui.plots.curves import visible_course
from skinsource_gui.plots.figure import Axes, Axis, fitted_axes
from skinsource_gui.plots.ranges import Range, columns_of, linear_ticks, wave_of
from skinsource_gui.qt.buttons import paint_swatch
from skinsource_gui.qt.layouts import Policy, named
from skinsource_gui.qt.theme import (
    UNIT_PX,
    current_theme,
    dots_in_px,
    is_on_paper,
    tabular,
    thin_pen,
    translucent,
)

_LOWEST_HZ, _FLOOR_DB = 10.0, -80.0
_BAND_ALPHA = 24


class _Preview(QtWidgets.QWidget):
    """A small picture, which takes the room that there is."""

    def __init__(self, name: str, title: str) -> None:
        super().__init__()
        named(self, name, title)
        self.setFont(tabular(self.font()))
        self.setSizePolicy(Policy.Expanding, Policy.Expanding)


class SpectrumPreview(_Preview):
    """A spectrum from 10 Hz to half the rate: the largest line of each pixel, in dB below the peak.

    The measured band of the limb is shaded.
    """

    def __init__(self) -> None:
        super().__init__("spectrum_preview", "Spectrum")
        self._lines: tuple[Floats, Floats] | None = None
        self._highest_hz = SAMPLE_RATE_HZ / 2.0
        self._band_hz: Band | None = None

    def show_samples(
        self,
        samples: Floats | None,
        sample_rate_hz: float = SAMPLE_RATE_HZ,
        band_hz: Band | None = None,
    ) -> None:
        """Draw the spectrum of ``samples``, (n_times,), and the band; None: nothing."""
        self._band_hz = band_hz
        self._highest_hz = sample_rate_hz / 2.0
        self._lines = None if samples is None else _lines(samples, sample_rate_hz)
        self.update()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter, theme = QtGui.QPainter(self), current_theme()
        frequency = Axis(shown=(_LOWEST_HZ, self._highest_hz), title="Hz", log=True)
        level = Axis(shown=(_FLOOR_DB, 0.0), title="dB")
        axes = fitted_axes(
            QRectF(self.rect()), frequency, level, QtGui.QFontMetricsF(painter.font())
        )
        if self._band_hz is not None:
            band = translucent(theme.accent, _BAND_ALPHA)
            ends_hz = np.clip(self._band_hz, _LOWEST_HZ, self._highest_hz)
            (left, top), (right, bottom) = axes.to_screen(ends_hz, np.array(level.shown[::-1]))
            painter.fillRect(QRectF(QPointF(left, top), QPointF(right, bottom)), band)
        axes.paint(painter, theme)
        if self._lines is not None:
            self._paint_lines(painter, axes, *self._lines)

    def _paint_lines(self, painter: QtGui.QPainter, axes: Axes, hz: Floats, db: Floats) -> None:
        inside = (hz >= _LOWEST_HZ) & (hz <= self._highest_hz)
        if not inside.any():
            return
        across, up = axes.to_screen(hz[inside], np.clip(db[inside], _FLOOR_DB, 0.0)).T
        column = across.astype(np.intp)
        firsts = np.flatnonzero(np.diff(column, prepend=-1))
        highest = np.minimum.reduceat(up, firsts)
        painter.setPen(thin_pen(QtGui.QColor(current_theme().text)))
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        painter.drawPath(arrayToQPath(across[firsts], highest, finiteCheck=False))


def _lines(samples: Floats, sample_rate_hz: float) -> tuple[Floats, Floats]:
    """Return frequencies and their levels, in dB below the largest."""
    # Short signals are padded, so that each pixel has a line.
    length = max(samples.size, 4096)
    magnitude = np.abs(np.fft.rfft(samples, length))
    largest = max(float(magnitude.max(initial=0.0)), np.finfo(np.float64).tiny)
    level_db = 20.0 * np.log10(np.maximum(magnitude / largest, 1e-12))
    return np.asarray(np.fft.rfftfreq(length, 1.0 / sample_rate_hz), np.float64), level_db


_BUDGET_BYTES = 24 * 2**20
_BYTES_PER_PIXEL = 4
# Strokes of this mean length, of 2, make a block, whose edge needs no smoothing.
_BLOCK = 0.8


@dataclass(frozen=True, slots=True)
class ClipStyle:
    """How the curve of a clip is drawn.

    Attributes
    ----------
    sample_rate_hz
        Of what the clip plays.
    colour
        Colour of the curve, as a number.
    reach
        Height of a sample of 1, as a share of half the picture; negative: upside down.
    part
        Which part of the whole is shown, from 0 to 1.
    ratio
        Dots in a px.
    """

    sample_rate_hz: float
    colour: int
    reach: float
    part: tuple[float, float] = (0.0, 1.0)
    ratio: float = 1.0


def paint_samples(painter: QtGui.QPainter, samples: Floats, area: QRectF, style: ClipStyle) -> None:
    """Paint samples, (n_times,), as a curve; of few, the wave between them."""
    if not samples.size:
        return
    time_s = np.arange(samples.size) / style.sample_rate_hz
    first_s, end_s = (share * samples.size / style.sample_rate_hz for share in style.part)
    across = max(round(area.width() * style.ratio), 1)
    wave = wave_of(time_s, samples[np.newaxis])
    known = columns_of(time_s, (first_s, end_s), across)
    curve = visible_course(known, samples[np.newaxis], wave, area.width(), style.ratio)
    heights = style.reach * curve.line.y[0]
    if curve.wave:
        # Between samples it may be higher than there is room for them.
        heights = heights / max(float(np.abs(heights).max()), 1.0)
    strokes = np.abs(heights[1::2] - heights[::2]) if curve.line.strokes else 0.0
    block = not is_on_paper() and np.mean(strokes) > _BLOCK * abs(style.reach)
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing, not block)
    painter.setPen(thin_pen(QtGui.QColor.fromRgba(style.colour)))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    middle = area.center().y()
    x = area.left() + (curve.line.x - first_s) / (end_s - first_s) * area.width()
    y = middle - np.clip(heights, -1, 1) * (area.height() / 2 - 1)
    if x.size == 1:
        painter.drawLine(QPointF(x[0], middle), QPointF(x[0], y[0]))
        painter.setBrush(painter.pen().color())
        painter.drawEllipse(QPointF(x[0], y[0] + (2 if y[0] < middle else -2)), 2, 2)
    else:
        # A path, because Qt leaves gaps in a polyline of upright strokes.
        painter.drawPath(arrayToQPath(x, y, finiteCheck=False))


class ClipPictures:
    """Curves of clips, painted once for each size and style; the oldest are dropped first."""

    def __init__(self) -> None:
        self.forget()

    def paint(
        self, painter: QtGui.QPainter, samples: Floats, area: QRectF, style: ClipStyle
    ) -> None:
        """Paint what a clip plays; on paper as lines."""
        if is_on_paper():
            paint_samples(painter, samples, area, style)
            return
        painter.drawPixmap(area.topLeft(), self.picture(samples, area.size(), style))

    def picture(self, samples: Floats, size: QSizeF, style: ClipStyle) -> QtGui.QPixmap:
        """Return the picture of what a clip plays; size in px."""
        # The samples are stored with the picture, so that no other array gets their id.
        key = (id(samples), size.width(), size.height(), style)
        return self._pictures.get(key, lambda: self._painted(samples, size, style))[1]

    def forget(self) -> None:
        """Keep nothing."""
        self._pictures = Memory[_Picture](_BUDGET_BYTES, _size)

    def _painted(self, samples: Floats, size: QSizeF, style: ClipStyle) -> "_Picture":
        made = QtGui.QPixmap((size * style.ratio).toSize().expandedTo(QSizeF(1, 1).toSize()))
        made.setDevicePixelRatio(style.ratio)
        made.fill(Qt.GlobalColor.transparent)
        on_picture = QtGui.QPainter(made)
        room = QRectF(QPointF(), size)
        paint_samples(on_picture, samples, room, style)
        on_picture.end()
        return samples, made


#: Samples, and what is painted of them.
_Picture = tuple[Floats, QtGui.QPixmap]


def _size(picture: _Picture) -> int:
    samples, made = picture
    return samples.nbytes + made.width() * made.height() * _BYTES_PER_PIXEL


_HEAD_PX, _STRIP_AXIS_PX = 34, 20
_SWATCH_PX = 24.0
_LANE_PX = (16.0, 40.0)
_STRIP_TICK_SPACING_PX = 64


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StripClip:
    """A clip on a `ClipStrip`; a sample of 1 has the full height of the lane."""

    start_s: float
    duration_s: float
    samples: Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Lane:
    """A track of a `ClipStrip`: numbers of its place and its colour, and its clips."""

    place: int
    colour: int
    clips: tuple[StripClip, ...]


# Some motions repeat equal clips often.
@lru_cache(maxsize=32)
def _plain_samples(clip: Clip, sample_rate_hz: float) -> Floats:
    samples = played(clip.waveform, clip.effects, sample_rate_hz)
    return samples / max(float(np.abs(samples).max(initial=0.0)), 1.0)


def strip_clip(clip: Clip, factor: float, sample_rate_hz: float) -> StripClip:
    """Return a clip, its samples scaled down to at most 1, times its gain and ``factor``."""
    plain = _plain_samples(replace(clip, id=0, onset_s=0.0, gain=1.0), sample_rate_hz)
    samples = plain * (clip.gain * factor)
    return StripClip(start_s=clip.onset_s, duration_s=clip.duration_s, samples=samples)


def strip_lanes(fragment: Fragment, sample_rate_hz: float) -> tuple[Lane, ...]:
    """Return the tracks of a fragment, the strongest clip at full height.

    Raises
    ------
    InvalidInputError
        Something in the fragment cannot be played at this rate.
    """
    largest = max(
        (abs(lane.amplitude * clip.gain) for lane in fragment.lanes for clip in lane.clips),
        default=1.0,
    )
    factor, rate_hz = 1.0 / (largest or 1.0), sample_rate_hz
    return tuple(
        Lane(
            place=lane.location,
            colour=number,
            clips=tuple(strip_clip(clip, lane.amplitude * factor, rate_hz) for clip in lane.clips),
        )
        for number, lane in enumerate(fragment.lanes)
    )


class ClipStrip(_Preview):
    """A lane for each of ``lanes`` above an axis of time, or a ``message`` in place of them."""

    def __init__(self) -> None:
        super().__init__("clip_strip", "Clips")
        #: What is shown, and the message in its place, or "".
        self.lanes: tuple[Lane, ...] = ()
        self.message = ""

    def show_lanes(self, lanes: tuple[Lane, ...]) -> None:
        """Show these tracks."""
        self.lanes, self.message = lanes, ""
        self.updateGeometry()
        self.update()

    def show_message(self, message: str) -> None:
        """Show a message instead of tracks."""
        self.lanes, self.message = (), message
        self.update()

    def minimumSizeHint(self) -> QSize:
        lanes = max(len(self.lanes), 2)
        return QSize(300, round(lanes * _LANE_PX[0]) + _STRIP_AXIS_PX + 4)

    def sizeHint(self) -> QSize:
        lanes = max(len(self.lanes), 3)
        return QSize(520, round(lanes * _LANE_PX[1]) + _STRIP_AXIS_PX + 4)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        if self.message:
            painter.setPen(QtGui.QColor(current_theme().warning))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(self.rect(), flags, self.message)
        elif self.lanes:
            self._paint_all(painter)

    def _paint_all(self, painter: QtGui.QPainter) -> None:
        start_s = min(clip.start_s for lane in self.lanes for clip in lane.clips)
        end_s = max(clip.start_s + clip.duration_s for lane in self.lanes for clip in lane.clips)
        span_s = max(end_s - start_s, 1e-3)
        plot = QRectF(self.rect()).adjusted(_HEAD_PX, 2, -UNIT_PX, -_STRIP_AXIS_PX)
        height = min(plot.height() / len(self.lanes), _LANE_PX[1])
        plot.setHeight(height * len(self.lanes))
        x_of = partial(_x_at, plot, start_s, span_s)
        self._paint_axis(painter, plot, (start_s, start_s + span_s), x_of)
        for row, lane in enumerate(self.lanes):
            area = QRectF(plot.left(), plot.top() + row * height, plot.width(), height)
            colour = current_theme().input_colour(lane.colour)
            self._paint_head(painter, area, lane, colour)
            painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().border), 1))
            painter.drawLine(QLineF(area.left(), area.bottom(), area.right(), area.bottom()))
            for clip in lane.clips:
                self._paint_clip(painter, area, colour, clip, x_of)

    def _paint_axis(
        self, painter: QtGui.QPainter, plot: QRectF, ends_s: Range, x_of: Callable[[float], float]
    ) -> None:
        """Draw grid, labels and unit of the axis of time."""
        metrics, baseline = self.fontMetrics(), plot.bottom() + _STRIP_AXIS_PX - 5
        unit, per_s = axis_unit(ends_s[1])
        unit_px = metrics.horizontalAdvance(f" {unit}") + 2
        for tick in linear_ticks(*ends_s, int(plot.width() / _STRIP_TICK_SPACING_PX), per_s):
            x = x_of(tick.value)
            painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().grid), 1))
            painter.drawLine(QLineF(x, plot.top(), x, plot.bottom() + 3))
            width = metrics.horizontalAdvance(tick.label)
            left = min(max(x - width / 2, plot.left()), plot.right() - width)
            painter.setPen(QtGui.QColor(current_theme().dim))
            # The last tick makes room for the unit of all.
            if left + width <= plot.right() - unit_px:
                painter.drawText(QPointF(left, baseline), tick.label)
        painter.drawText(QPointF(plot.right() - unit_px + 2, baseline), f" {unit}")

    def _paint_head(
        self, painter: QtGui.QPainter, area: QRectF, lane: Lane, colour: QtGui.QColor
    ) -> None:
        height = min(area.height() - 2.0, _SWATCH_PX)
        place = QRectF(0.0, area.center().y() - height / 2, _SWATCH_PX, height)
        paint_swatch(
            painter, place, lane.place, colour, QtGui.QColor(current_theme().text), silent=False
        )

    def _paint_clip(
        self,
        painter: QtGui.QPainter,
        area: QRectF,
        colour: QtGui.QColor,
        clip: StripClip,
        x_of: Callable[[float], float],
    ) -> None:
        left, right = x_of(clip.start_s), x_of(clip.start_s + clip.duration_s)
        box = QRectF(left, area.top() + 2, max(right - left, 2.0), area.height() - 4)
        ground = translucent(colour, 56)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        painter.setPen(QtGui.QPen(colour, 1))
        painter.setBrush(ground)
        painter.drawRoundedRect(box, 3, 3)
        rate_hz = clip.samples.size / clip.duration_s
        style = ClipStyle(rate_hz, colour.rgba(), 1.0, ratio=dots_in_px(painter))
        paint_samples(painter, clip.samples, box, style)


def _x_at(plot: QRectF, start_s: float, span_s: float, time_s: float) -> float:
    return plot.left() + (time_s - start_s) / span_s * plot.width()
