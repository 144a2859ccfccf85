"""A small spectrum of a signal, with the measured band."""

import numpy as np
from pyqtgraph.functions import arrayToQPath
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from skinsource.base.arrays import Floats
from skinsource.base.published import SAMPLE_RATE_HZ, Band
from skinsource_gui.theme import current_theme, tabular
from skinsource_gui.widgets.paper import thin_pen

LOWEST_HZ, FLOOR_DB = 10.0, -80.0
_TICKS_HZ = (10, 25, 50, 100, 200, 600, 2000, 6000, 20_000)
_TICKS_DB = (0, -40, -80)
_LEFT_PX, _BOTTOM_PX, _EDGE_PX = 40, 18, 6
_BAND_ALPHA = 24


class SpectrumPreview(QWidget):
    """The largest line of each pixel, in dB below the largest of all, from 10 Hz to half the rate.

    The band in which the limb was measured is shaded.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._lines: tuple[Floats, Floats] | None = None
        self._highest_hz = SAMPLE_RATE_HZ / 2.0
        self._band_hz: Band | None = None
        self.setObjectName("spectrum_preview")
        self.setAccessibleName("Spectrum")
        self.setFont(tabular(self.font()))
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def show_samples(
        self,
        samples: Floats | None,
        sample_rate_hz: float = SAMPLE_RATE_HZ,
        band_hz: Band | None = None,
    ) -> None:
        """Draw the spectrum of ``samples``, (n_times,), and the band; nothing without any."""
        self._band_hz = band_hz
        self._highest_hz = sample_rate_hz / 2.0
        self._lines = None if samples is None else _lines(samples, sample_rate_hz)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        plot = QRectF(self.rect()).adjusted(_LEFT_PX, _EDGE_PX, -_EDGE_PX, -_BOTTOM_PX)
        if self._band_hz is not None:
            band = QColor(current_theme().accent)
            band.setAlpha(_BAND_ALPHA)
            left, right = (
                self._x(plot, min(max(hz, LOWEST_HZ), self._highest_hz)) for hz in self._band_hz
            )
            painter.fillRect(QRectF(left, plot.top(), right - left, plot.height()), band)
        self._paint_ticks(painter, plot)
        if self._lines is not None:
            self._paint_lines(painter, plot, *self._lines)

    def _x(self, plot: QRectF, hz: float) -> float:
        whole = np.log(self._highest_hz / LOWEST_HZ)
        return plot.left() + plot.width() * float(np.log(hz / LOWEST_HZ) / whole)

    def _y(self, plot: QRectF, db: float) -> float:
        return plot.top() + plot.height() * db / FLOOR_DB

    def _paint_ticks(self, painter: QPainter, plot: QRectF) -> None:
        grid, words = QPen(QColor(current_theme().grid), 1), QPen(QColor(current_theme().dim))
        metrics = self.fontMetrics()
        for db in _TICKS_DB:
            y = self._y(plot, db)
            painter.setPen(grid)
            painter.drawLine(QLineF(plot.left(), y, plot.right(), y))
            painter.setPen(words)
            text = f"{db}".replace("-", "−") if db else "0 dB"
            room = QRectF(0, y - 8, plot.left() - 4, 16)
            # The lowest and the highest stay inside.
            room.moveTop(min(max(room.top(), 0.0), plot.bottom() - 14))
            painter.drawText(
                room, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, text
            )
        free = plot.left() - 8.0
        seen = [hz for hz in _TICKS_HZ if hz < self._highest_hz]
        last = seen[-1] if seen else 0
        for hz in seen:
            x = self._x(plot, hz)
            painter.setPen(grid)
            painter.drawLine(QLineF(x, plot.top(), x, plot.bottom() + 3))
            text = f"{hz} Hz" if hz == last else f"{hz}"
            width = metrics.horizontalAdvance(text)
            start = min(x - width / 2, self.width() - width - 1)
            if start > free:
                painter.setPen(words)
                painter.drawText(QPointF(start, self.height() - 5), text)
                free = start + width + 4

    def _paint_lines(self, painter: QPainter, plot: QRectF, hz: Floats, db: Floats) -> None:
        inside = (hz >= LOWEST_HZ) & (hz <= self._highest_hz)
        if not inside.any():
            return
        whole = np.log(self._highest_hz / LOWEST_HZ)
        column = (plot.width() * np.log(hz[inside] / LOWEST_HZ) / whole).astype(np.intp)
        firsts = np.flatnonzero(np.diff(column, prepend=-1))
        x = plot.left() + column[firsts].astype(np.float64)
        highest = np.maximum.reduceat(db[inside], firsts)
        y = plot.top() + plot.height() * np.clip(highest, FLOOR_DB, 0.0) / FLOOR_DB
        painter.setPen(thin_pen(QColor(current_theme().text)))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.drawPath(arrayToQPath(x, y, finiteCheck=False))


def _lines(samples: Floats, sample_rate_hz: float) -> tuple[Floats, Floats]:
    """Frequencies and their levels, in dB below the largest."""
    # Short signals are padded: a line for each pixel.
    length = max(samples.size, 4096)
    magnitude = np.abs(np.fft.rfft(samples, length))
    largest = max(float(magnitude.max(initial=0.0)), np.finfo(np.float64).tiny)
    level_db = 20.0 * np.log10(np.maximum(magnitude / largest, 1e-12))
    return np.asarray(np.fft.rfftfreq(length, 1.0 / sample_rate_hz), np.float64), level_db
