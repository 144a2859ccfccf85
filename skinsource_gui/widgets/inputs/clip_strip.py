"""Clips of several tracks on a small ruler."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from skinsource.base.arrays import Floats
from skinsource.design.clips import Clip, Fragment
from skinsource.design.effects import Effect, played
from skinsource.design.waveforms import Waveform
from skinsource_gui.theme import UNIT_PX, current_theme, tabular
from skinsource_gui.widgets.fields.units import axis_unit
from skinsource_gui.widgets.inputs.swatch import paint_swatch
from skinsource_gui.widgets.inputs.waveform_preview import tick_step
from skinsource_gui.widgets.kept_picture import KeptPicture

_HEAD_PX, _AXIS_PX = 34, 20
_SWATCH_PX = 24.0
_LANE_PX = (16.0, 40.0)
_TICK_SPACING_PX = 64


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ShownClip:
    """A clip on the ruler.

    Attributes
    ----------
    start_s, duration_s
        When it plays.
    samples : (n_times,)
        What it plays; 1 is the full height of its lane.
    """

    start_s: float
    duration_s: float
    samples: Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Lane:
    """A track: its place, number of its colour, and clips."""

    place: int
    colour: int
    clips: tuple[ShownClip, ...]


class ShownClips:
    """Draws clips; what is alike is drawn once, however often it comes: some motions repeat much.

    Parameters
    ----------
    sample_rate_hz
        Of what is shown.
    """

    def __init__(self, sample_rate_hz: float) -> None:
        self._rate_hz = sample_rate_hz
        self._drawn: dict[tuple[Waveform, tuple[Effect, ...], float], Floats] = {}

    def of(self, clip: Clip, factor: float) -> ShownClip:
        """A clip, its samples times its gain and ``factor``; those that pass 1 are not cut off."""
        key = (clip.waveform, clip.effects, clip.gain * factor)
        samples = self._drawn.get(key)
        if samples is None:
            plain = played(clip.waveform, clip.effects, self._rate_hz)
            reach = max(float(np.abs(plain).max(initial=0.0)), 1.0)
            samples = self._drawn[key] = plain * (clip.gain * factor / reach)
        return ShownClip(start_s=clip.onset_s, duration_s=clip.duration_s, samples=samples)


def strip_lanes(fragment: Fragment, sample_rate_hz: float) -> tuple[Lane, ...]:
    """The tracks of a fragment, the strongest clip at full height.

    Raises
    ------
    InvalidInputError
        It holds something that cannot be played at this rate.
    """
    largest = max(
        (abs(lane.amplitude * clip.gain) for lane in fragment.lanes for clip in lane.clips),
        default=1.0,
    )
    factor, shown = 1.0 / (largest or 1.0), ShownClips(sample_rate_hz)
    return tuple(
        Lane(
            place=lane.location,
            colour=number,
            clips=tuple(shown.of(clip, lane.amplitude * factor) for clip in lane.clips),
        )
        for number, lane in enumerate(fragment.lanes)
    )


class ClipStrip(QWidget):
    """A lane for each track above an axis of time; or words where there is nothing to show."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._lanes: tuple[Lane, ...] = ()
        self._words = ""
        self._picture = KeptPicture()
        # Outlines of what is painted, by samples and size.
        self._outlines: dict[tuple[int, float, float], QPainterPath] = {}
        self.setObjectName("clip_strip")
        self.setAccessibleName("Clips")
        self.setFont(tabular(self.font()))
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    @property
    def lanes(self) -> tuple[Lane, ...]:
        """What is shown."""
        return self._lanes

    @property
    def words(self) -> str:
        """What stands in place of lanes, or ""."""
        return self._words

    def show_lanes(self, lanes: tuple[Lane, ...]) -> None:
        """Show these tracks."""
        self._lanes, self._words = lanes, ""
        self.updateGeometry()
        self.update()

    def show_words(self, words: str) -> None:
        """Show no track, and say why."""
        self._lanes, self._words = (), words
        self.update()

    def minimumSizeHint(self) -> QSize:
        lanes = max(len(self._lanes), 2)
        return QSize(300, round(lanes * _LANE_PX[0]) + _AXIS_PX + 4)

    def sizeHint(self) -> QSize:
        lanes = max(len(self._lanes), 3)
        return QSize(520, round(lanes * _LANE_PX[1]) + _AXIS_PX + 4)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        if self._words:
            painter.setPen(QColor(current_theme().warning))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(self.rect(), flags, self._words)
            return
        if self._lanes:
            shown = (current_theme(), self._lanes, self.font().toString())
            whole = QRectF(self.rect())
            self._picture.paint(
                painter, whole, shown, self._paint_all, self.palette().window().color()
            )

    def _paint_all(self, painter: QPainter) -> None:
        start_s = min(clip.start_s for lane in self._lanes for clip in lane.clips)
        end_s = max(clip.start_s + clip.duration_s for lane in self._lanes for clip in lane.clips)
        span_s = max(end_s - start_s, 1e-3)
        plot = QRectF(self.rect()).adjusted(_HEAD_PX, 2, -UNIT_PX, -_AXIS_PX)
        height = min(plot.height() / len(self._lanes), _LANE_PX[1])
        plot.setHeight(height * len(self._lanes))
        self._paint_axis(painter, plot, start_s, span_s)
        x_of = partial(_x_at, plot, start_s, span_s)
        for row, lane in enumerate(self._lanes):
            area = QRectF(plot.left(), plot.top() + row * height, plot.width(), height)
            colour = current_theme().input_colour(lane.colour)
            self._paint_head(painter, area, lane, colour)
            painter.setPen(QPen(QColor(current_theme().border), 1))
            painter.drawLine(QLineF(area.left(), area.bottom(), area.right(), area.bottom()))
            for clip in lane.clips:
                self._paint_clip(painter, area, colour, clip, x_of)
        self._outlines.clear()

    def _paint_head(self, painter: QPainter, area: QRectF, lane: Lane, colour: QColor) -> None:
        high = min(area.height() - 2.0, _SWATCH_PX)
        place = QRectF(0.0, area.center().y() - high / 2, _SWATCH_PX, high)
        paint_swatch(painter, place, lane.place, colour, QColor(current_theme().text), silent=False)

    def _paint_clip(
        self,
        painter: QPainter,
        area: QRectF,
        colour: QColor,
        clip: ShownClip,
        x_of: Callable[[float], float],
    ) -> None:
        left, right = x_of(clip.start_s), x_of(clip.start_s + clip.duration_s)
        box = QRectF(left, area.top() + 2, max(right - left, 2.0), area.height() - 4)
        ground = QColor(colour)
        ground.setAlphaF(0.22)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(colour, 1))
        painter.setBrush(ground)
        painter.drawRoundedRect(box, 3, 3)
        painter.setBrush(colour)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.drawPath(self._outline(clip.samples, box))

    def _outline(self, samples: Floats, box: QRectF) -> QPainterPath:
        size = QRectF(0.0, 0.0, round(box.width(), 3), round(box.height(), 3))
        key = (id(samples), size.width(), size.height())
        if key not in self._outlines:
            self._outlines[key] = _outline(samples, size)
        return self._outlines[key].translated(box.topLeft())

    def _paint_axis(self, painter: QPainter, plot: QRectF, start_s: float, span_s: float) -> None:
        unit, per_s = axis_unit(start_s + span_s)
        step = tick_step(span_s * per_s, int(plot.width() / _TICK_SPACING_PX))
        first = int(np.ceil(start_s * per_s / step - 1e-9))
        last = int(np.floor((start_s + span_s) * per_s / step + 1e-9))
        unit_px = self.fontMetrics().horizontalAdvance(f" {unit}") + 2
        baseline = plot.bottom() + _AXIS_PX - 5
        for k in range(first, last + 1):
            x = _x_at(plot, start_s, span_s, k * step / per_s)
            painter.setPen(QPen(QColor(current_theme().grid), 1))
            painter.drawLine(QLineF(x, plot.top(), x, plot.bottom() + 3))
            label = f"{k * step:g}"
            width = self.fontMetrics().horizontalAdvance(label)
            where = min(max(x - width / 2, plot.left()), plot.right() - width)
            # The last tick makes room for the unit of all.
            if where + width <= plot.right() - unit_px:
                painter.setPen(QColor(current_theme().dim))
                painter.drawText(QPointF(where, baseline), label)
        painter.setPen(QColor(current_theme().dim))
        painter.drawText(QPointF(plot.right() - unit_px + 2, baseline), f" {unit}")


def _x_at(plot: QRectF, start_s: float, span_s: float, time_s: float) -> float:
    return plot.left() + (time_s - start_s) / span_s * plot.width()


def _outline(samples: Floats, box: QRectF) -> QPainterPath:
    """What lies between the highest and the lowest sample of each pixel."""
    columns = max(int(box.width()), 1)
    edges = np.linspace(0, samples.size, min(columns, max(samples.size, 1)) + 1).astype(int)
    if samples.size == 0:
        return QPainterPath()
    starts = edges[:-1]
    high = np.maximum(np.maximum.reduceat(samples, starts), 0.0)
    low = np.minimum(np.minimum.reduceat(samples, starts), 0.0)
    x = box.left() + box.width() * (np.arange(starts.size) + 0.5) / starts.size
    reach = box.height() / 2 - 1
    middle = box.center().y()
    path = QPainterPath(QPointF(x[0] - 0.5, middle))
    for across, value in zip(x, high, strict=True):
        path.lineTo(across, middle - reach * value - 0.3)
    for across, value in zip(x[::-1], low[::-1], strict=True):
        path.lineTo(across, middle - reach * value + 0.3)
    path.closeSubpath()
    return path
