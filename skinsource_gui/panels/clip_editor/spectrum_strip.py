"""Spectrum of one clip, with the measured band."""

import numpy as np
from pyqtgraph.functions import arrayToQPath
from PySide6.QtCore import QLineF, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from skinsource.base.arrays import Floats
from skinsource.base.published import Band
from skinsource.signals.spectra import share_outside_band
from skinsource_gui.theme import current_theme, scaled, tabular
from skinsource_gui.widgets.kept_picture import KeptPicture
from skinsource_gui.widgets.paper import dots_in_px, thin_pen
from skinsource_gui.widgets.plot.decimation import visible_points
from skinsource_gui.widgets.plot.ticks import linear_ticks
from skinsource_gui.widgets.tooltips import show_tooltip

_TEXT = 0.9
_LEFT_PX, _RIGHT_PX, _BOTTOM_PX = 40, 10, 18
_SPAN_DB = 60.0
_TICK_PX = 64.0
# Above this share a designer has to know: the actuator, or the skin model, sees it.
_NOTEWORTHY = 0.01


def spectrum_db(samples: Floats, sample_rate_hz: float) -> tuple[Floats, Floats]:
    """Frequencies in Hz, and magnitude in dB below the largest, (n_frequencies,) each."""
    # Of numpy, which is imported before the window is painted.
    n = 1 << (max(2 * samples.size, 512) - 1).bit_length()
    peak = float(np.abs(samples).max(initial=0.0))
    spectrum = np.abs(np.fft.rfft(samples / peak if peak > 0 else samples, n))
    largest = float(spectrum.max(initial=0.0))
    floor = largest * 1e-10
    levels = 20 * np.log10(np.maximum(spectrum, floor) / largest) if largest > 0 else spectrum - 1e3
    return np.arange(spectrum.size) * sample_rate_hz / n, levels


class SpectrumStrip(QWidget):
    """Magnitude over frequency, and how much of the energy lies outside the band."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("clip_spectrum")
        self.setAccessibleName("Spectrum of the clip")
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self.setMinimumHeight(78)
        # All of it is painted: nothing behind needs to be.
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self._axes = KeptPicture()
        self._frequency_hz: Floats | None = None
        self._levels_db: Floats | None = None
        self._outside = 0.0
        self._samples: Floats | None = None
        self._rate_hz = 0.0
        self._band_hz: Band | None = None

    @property
    def outside(self) -> float:
        """Share of the energy outside the measured band, from 0 to 1."""
        return self._outside

    def sizeHint(self) -> QSize:
        return QSize(200, 106)

    def show_samples(
        self, samples: Floats | None, sample_rate_hz: float, band_hz: Band | None
    ) -> None:
        """Show the spectrum of ``samples``, (n_times,), and the share of energy out of band.

        Of a limb of which the band is not known neither is that.
        """
        shown = sample_rate_hz, band_hz
        if samples is self._samples and shown == (self._rate_hz, self._band_hz):
            return
        self._samples, self._rate_hz, self._outside = samples, sample_rate_hz, 0.0
        self._band_hz = band_hz
        if samples is None or not samples.size:
            self._frequency_hz = self._levels_db = None
        else:
            if band_hz is not None:
                self._outside = share_outside_band(samples, sample_rate_hz, band_hz)
            self._frequency_hz, self._levels_db = spectrum_db(samples, sample_rate_hz)
        show_tooltip(self, self.words)
        self.update()

    @property
    def words(self) -> str:
        """How much of the energy lies outside the band."""
        if self._band_hz is None:
            return "In which band this limb was measured is not known"
        low, high = self._band_hz
        share = 100 * self._outside
        number = "0" if share == 0 else "< 0.1" if share < 0.1 else f"{share:.3g}"
        return f"{number} % of the energy outside {low:g} to {high:g} Hz"

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setFont(scaled(tabular(self.font()), _TEXT))
        # The words stand above: on the curve neither could be read.
        top = painter.fontMetrics().height() + 3
        area = QRectF(self.rect()).adjusted(_LEFT_PX, top, -_RIGHT_PX, -_BOTTOM_PX)
        ground = QColor(current_theme().window)
        if self._frequency_hz is None or self._levels_db is None:
            painter.fillRect(self.rect(), ground)
            painter.fillRect(area, QColor(current_theme().base))
            return
        highest = float(self._frequency_hz[-1])

        def paint_axes(on_image: QPainter) -> None:
            on_image.fillRect(area, QColor(current_theme().base))
            self._paint_band(on_image, area, highest)
            self._paint_axes(on_image, area, highest)

        key = (current_theme().name, highest, self._band_hz)
        self._axes.paint(painter, QRectF(self.rect()), key, paint_axes, ground)
        columns = max(int(area.width() * dots_in_px(painter)), 1)
        points = visible_points(
            self._frequency_hz, self._levels_db[np.newaxis], (0.0, highest), columns
        )
        x = area.left() + points.x / highest * area.width()
        y = area.top() - np.maximum(points.y[0], -_SPAN_DB) / _SPAN_DB * area.height()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(thin_pen(QColor(current_theme().accent)))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawPath(arrayToQPath(x, y, finiteCheck=False))
        painter.setPen(QPen(QColor(current_theme().border), 1))
        painter.drawRect(area)
        self._write(painter, area)

    def _paint_band(self, painter: QPainter, area: QRectF, highest: float) -> None:
        if self._band_hz is None:
            return
        low, high = (area.left() + min(one / highest, 1.0) * area.width() for one in self._band_hz)
        for left, right in ((area.left(), low), (high, area.right())):
            outside = QRectF(left, area.top(), right - left, area.height())
            painter.fillRect(outside, QColor(current_theme().window))

    def _paint_axes(self, painter: QPainter, area: QRectF, highest: float) -> None:
        metrics = QFontMetricsF(painter.font())
        right = area.right() - metrics.horizontalAdvance("Hz") - 4
        for tick in linear_ticks(0.0, highest, max(area.width() / _TICK_PX, 2)):
            x = area.left() + tick.value / highest * area.width()
            painter.setPen(QPen(QColor(current_theme().grid), 1))
            painter.drawLine(QLineF(x, area.top(), x, area.bottom()))
            width = metrics.horizontalAdvance(tick.label)
            if x + width / 2 < right:
                painter.setPen(QColor(current_theme().dim))
                at = QPointF(x - width / 2, area.bottom() + metrics.ascent() + 2)
                painter.drawText(at, tick.label)
        painter.setPen(QColor(current_theme().dim))
        painter.drawText(QPointF(right + 4, area.bottom() + metrics.ascent() + 2), "Hz")
        for level, text in ((0.0, "0 dB"), (-_SPAN_DB, f"\u2212{_SPAN_DB:g}")):
            y = area.top() - level / _SPAN_DB * area.height()
            room = QRectF(0, y - metrics.height() / 2, area.left() - 4, metrics.height())
            room.moveTop(min(max(room.top(), 0.0), self.height() - metrics.height()))
            flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
            painter.drawText(room, flags, text)

    def _write(self, painter: QPainter, area: QRectF) -> None:
        metrics = QFontMetricsF(painter.font())
        noteworthy = self._outside > _NOTEWORTHY
        painter.setPen(QColor(current_theme().warning if noteworthy else current_theme().dim))
        flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        text = metrics.elidedText(self.words, Qt.TextElideMode.ElideRight, area.width())
        painter.drawText(QRectF(area.left(), 0.0, area.width(), area.top() - 2), flags, text)
