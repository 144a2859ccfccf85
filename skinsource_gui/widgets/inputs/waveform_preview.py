"""A small picture of what an input plays."""

import math
from functools import partial

import numpy as np
from pyqtgraph.functions import arrayToQPath
from PySide6.QtCore import QLineF, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from skinsource.base.arrays import Floats
from skinsource_gui.theme import current_theme, letter_scale, tabular
from skinsource_gui.widgets.fields.units import axis_unit
from skinsource_gui.widgets.kept_picture import KeptPicture
from skinsource_gui.widgets.paper import dots_in_px, is_on_paper, thin_pen
from skinsource_gui.widgets.plot.curve_points import course_of
from skinsource_gui.widgets.plot.decimation import KeptColumns
from skinsource_gui.widgets.plot.wave import wave_of
from skinsource_gui.widgets.tooltips import show_tooltip

_AXIS_PX, _CURVE_PX = 18, 46
_MARGIN_PX = 4
# Between ticks, in letters of the usual size.
_TICK_SPACING_PX = 52
# Strokes of this mean length, of 2, make a block, whose edge needs no smoothing.
_BLOCK = 0.8
# A single sample needs some time around it to be seen as one.
_SHORTEST_S = 0.005
_PALE = 0.35


def tick_step(span: float, most: int) -> float:
    """The smallest of 1, 2, 5, 10, … that divides ``span`` into at most ``most`` parts."""
    least = span / max(most, 1)
    decade = 10.0 ** math.floor(math.log10(least))
    return next(decade * factor for factor in (1, 2, 5, 10, 20) if decade * factor >= least)


class WaveformPreview(QWidget):
    """Samples over their time, optionally with an axis in milliseconds, or seconds.

    The height is 1, or the peak where that is more.
    """

    def __init__(self, parent: QWidget | None = None, *, axis: bool = False) -> None:
        super().__init__(parent)
        self._has_axis = axis
        self._samples: Floats | None = None
        self._sample_rate_hz = self._height = 1.0
        self._words = ""
        self._colour: int | None = None
        self._flipped, self._problem = False, ""
        self._pale = False
        self._axis, self._columns = KeptPicture(), KeptColumns()
        self.setObjectName("waveform_preview")
        self.setAccessibleName("Waveform")
        self.setFont(tabular(self.font()))
        # With an axis all of it is painted: nothing behind needs to be.
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent, axis)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def minimumSizeHint(self) -> QSize:
        return QSize(0, _CURVE_PX + self._axis_px if self._has_axis else 0)

    @property
    def _axis_px(self) -> int:
        return round(_AXIS_PX * letter_scale(self.font()))

    @property
    def words(self) -> str:
        """What stands in place of a curve, or ""."""
        return self._words

    @property
    def duration_s(self) -> float | None:
        """Length of what is drawn, or None."""
        return None if self._samples is None else self._samples.size / self._sample_rate_hz

    def show_samples(self, samples: Floats, sample_rate_hz: float) -> None:
        """Draw ``samples``, (n_times,)."""
        old = self._samples
        same = old is samples or (old is not None and np.array_equal(old, samples))
        self._samples = samples
        if same and not self._words and self._sample_rate_hz == sample_rate_hz:
            return
        self._sample_rate_hz, self._words = sample_rate_hz, ""
        self._height = max(float(np.abs(samples).max(initial=0.0)), 1.0)
        show_tooltip(self, "")
        self.update()

    def show_words(self, words: str) -> None:
        """Draw no curve, and say why."""
        self._samples, self._words = None, words
        self.setToolTip(words)
        self.update()

    def set_look(self, colour: int, *, flipped: bool = False, problem: str = "") -> None:
        """Colour of the curve, by `Input.colour`; whether a negative amplitude turns it over.

        With a ``problem``, the curve has the colour of errors.
        """
        if (colour, flipped, problem) != (self._colour, self._flipped, self._problem):
            self._colour, self._flipped, self._problem = colour, flipped, problem
            self.setAccessibleDescription(problem)
            self.update()

    def set_pale(self, pale: bool) -> None:
        """Whether the curve is out of date."""
        if pale != self._pale:
            self._pale = pale
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        drawn = not self._words and self._samples is not None and self._samples.size > 0
        ground = self.palette().window().color()
        if self._has_axis and not drawn:
            painter.fillRect(self.rect(), ground)
        if self._words:
            painter.setPen(QColor(current_theme().dim))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(self.rect(), flags, self._words_that_fit(flags))
            return
        if not drawn or self._samples is None:
            return
        plot = QRectF(self.rect()).adjusted(_MARGIN_PX, 2, -_MARGIN_PX, -2)
        if self._has_axis:
            plot.setBottom(plot.bottom() - self._axis_px)
            span_s = self._span_s(self._samples)
            shown = (current_theme(), span_s)
            self._axis.paint(
                painter,
                QRectF(self.rect()),
                shown,
                partial(self._paint_axis, plot=plot, span_s=span_s),
                ground,
            )
        painter.setPen(QPen(QColor(current_theme().border), 1))
        painter.drawLine(QLineF(plot.left(), plot.center().y(), plot.right(), plot.center().y()))
        self._paint_curve(painter, plot, self._samples)

    def _words_that_fit(self, flags: int) -> str:
        # The whole is in the tooltip, and where it concerns the whole window, at its top.
        shown, words = self._words, self._words.split(" ")
        room, metrics = self.rect(), self.fontMetrics()
        while words and metrics.boundingRect(room, flags, shown).height() > room.height():
            words.pop()
            shown = " ".join(words) + " …"
        return shown

    def _span_s(self, samples: Floats) -> float:
        return max(samples.size / self._sample_rate_hz, _SHORTEST_S)

    def _drawn_colour(self) -> QColor:
        theme, number = current_theme(), self._colour
        if self._problem:
            return QColor(theme.error)
        return QColor(theme.text) if number is None else theme.input_colour(number)

    def _paint_curve(self, painter: QPainter, plot: QRectF, drawn: Floats) -> None:
        if self._pale:
            painter.setOpacity(_PALE)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(self._drawn_colour(), 1))
        sign = -1 if self._flipped else 1
        shown_px = plot.width() * drawn.size / self._sample_rate_hz / self._span_s(drawn)
        ratio = dots_in_px(painter)
        time_s, end_s = (
            np.arange(drawn.size) / self._sample_rate_hz,
            drawn.size / self._sample_rate_hz,
        )
        wave, across = wave_of(time_s, drawn[np.newaxis]), max(int(shown_px * ratio), 1)
        found = self._columns.of(time_s, (0.0, end_s), across)
        points = course_of(found, drawn[np.newaxis], wave, shown_px, ratio).line
        samples = points.y[0]
        # Between samples it may be higher than they are.
        highest = max(self._height, float(np.abs(samples).max()))
        middle, reach = plot.center().y(), sign * plot.height() / 2 / highest
        if points.strokes and not is_on_paper():
            block = bool(np.mean(np.abs(samples[1::2] - samples[::2])) > _BLOCK)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, not block)
        x = plot.left() + shown_px * points.x / end_s
        y = middle - reach * samples
        if samples.size == 1:
            top = QPointF(x[0] + 1, y[0])
            painter.drawLine(QPointF(x[0] + 1, middle), top)
            painter.setBrush(self._drawn_colour())
            painter.drawEllipse(top + QPointF(0, 2 if y[0] < middle else -2), 2, 2)
            return
        # A path, because Qt leaves gaps in a polyline of upright strokes.
        painter.setPen(thin_pen(self._drawn_colour()))
        painter.drawPath(arrayToQPath(x, y, finiteCheck=False))

    def _paint_axis(self, painter: QPainter, plot: QRectF, span_s: float) -> None:
        unit, per_s = axis_unit(span_s)
        span = span_s * per_s
        spacing_px = _TICK_SPACING_PX * letter_scale(self.font())
        step = tick_step(span, int(plot.width() / spacing_px))
        unit_px = self.fontMetrics().horizontalAdvance(f" {unit}") + 2
        for k in range(int(span / step * (1 + 1e-9)) + 1):
            x = plot.left() + k * step / span * plot.width()
            painter.setPen(QPen(QColor(current_theme().grid), 1))
            painter.drawLine(QLineF(x, plot.top(), x, plot.bottom() + 3))
            label = f"{k * step:g}"
            width = self.fontMetrics().horizontalAdvance(label)
            left = min(max(x - width / 2, plot.left()), plot.right() - width)
            if left + width > plot.right() - unit_px:
                # The last tick makes room for the unit of all.
                continue
            painter.setPen(QColor(current_theme().dim))
            painter.drawText(QPointF(left, self.height() - 5), label)
        painter.setPen(QColor(current_theme().dim))
        painter.drawText(QPointF(plot.right() - unit_px + 2, self.height() - 5), f" {unit}")
