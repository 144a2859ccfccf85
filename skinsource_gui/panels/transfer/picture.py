"""Transfer functions over frequency: magnitude, noise floor, and the band that can be used."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen
from PySide6.QtWidgets import QWidget

from skinsource.base.decibels import decibels
from skinsource.signals.analysis.transfer import Transfer
from skinsource_gui.theme import UNIT_PX, current_theme
from skinsource_gui.widgets.fields.level_text import minus
from skinsource_gui.widgets.figure.axes import Axes, Axis, fitted_axes
from skinsource_gui.widgets.figure.figure import Figure
from skinsource_gui.widgets.figure.output_legend import draw_legend
from skinsource_gui.widgets.plot.ranges import LEVEL_SPAN_DB, HeldRange

# Bars of many outputs share this part of the height: the curves are seen beside them.
_BAR_PX, _BARS_PART = 3.0, 0.1


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Shown:
    """What is drawn: transfer functions, the outputs they lead to, their unit, and which part.

    ``coherence`` says whether it is drawn in place of magnitudes.
    """

    found: Transfer
    outputs: tuple[int, ...]
    unit: str
    coherence: bool


class TransferPicture(Figure):
    """One curve of each output; below, where it is more than noise."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("transfer_picture", "Transfer functions", parent)
        self.shown: Shown | None = None
        self.axes: Axes | None = None
        self._held = HeldRange()
        self._top_db = 0.0

    def begin_anew(self) -> None:
        """Decide the range of the next picture without a look at the one before."""
        self._held.let_go()

    def show_transfer(self, shown: Shown) -> None:
        """Take over what to show."""
        self.shown = shown
        highest = float(decibels(shown.found.magnitude).max())
        self._top_db = self._held.follow(highest, highest, "level")[1]
        self.say("")
        self.read_again()

    def draw(self, painter: QPainter, room: QRectF) -> None:
        shown = self.shown
        if shown is None:
            return
        frequency_hz = shown.found.frequency_hz
        x = Axis(shown=(0.0, float(frequency_hz[-1])), title="Frequency (Hz)")
        if shown.coherence:
            y = Axis(shown=(0.0, 1.0), title="Coherence")
        else:
            y = Axis(
                shown=(self._top_db - LEVEL_SPAN_DB, self._top_db), title=f"dB re {shown.unit}"
            )
        metrics = QFontMetricsF(painter.font())
        head = QRectF(room.left(), room.top(), room.width(), metrics.height())
        inner = head.adjusted(UNIT_PX, 0, -UNIT_PX, 0)
        draw_legend(painter, inner, shown.outputs, current_theme(), broken=True)
        self.axes = axes = fitted_axes(room.adjusted(0, head.height(), 0, 0), x, y, metrics)
        self._shade(painter, axes)
        axes.paint(painter, current_theme())
        painter.save()
        painter.setClipRect(axes.frame)
        self._draw_bars(painter, axes, shown)
        for rank in range(len(shown.outputs)):
            self._draw_curve(painter, axes, shown, rank)
        if self.cursor_at is not None:
            painter.setPen(QPen(QColor(current_theme().dim), 1, Qt.PenStyle.DashLine))
            at = self.cursor_at.x()
            painter.drawLine(QLineF(at, axes.frame.top(), at, axes.frame.bottom()))
        painter.restore()

    def read(self, at: QPointF) -> str:
        place = None if self.axes is None else self.axes.value_at(at)
        if place is None or self.shown is None:
            return ""
        found = self.shown.found
        k = int(np.argmin(np.abs(found.frequency_hz - place[0])))
        said = [f"{found.frequency_hz[k]:.1f} Hz, dB and coherence"]
        for rank, output in enumerate(self.shown.outputs):
            level = float(decibels(found.magnitude[rank, k]))
            said.append(f"{output}: {level:z.1f}, {found.coherence[rank, k]:.2f}")
        return minus(" · ".join(said))

    def keys_area(self) -> QRectF:
        return QRectF() if self.axes is None or self.message else self.axes.frame

    def _shade(self, painter: QPainter, axes: Axes) -> None:
        """What was not measured, where that is known."""
        if self.shown is None or self.shown.found.band_hz is None:
            return
        band_hz = np.array(self.shown.found.band_hz)
        colour = QColor(current_theme().grid)
        colour.setAlpha(140)
        frame = axes.frame
        low, high = (float(p[0]) for p in axes.to_screen(band_hz, np.zeros(1)))
        painter.fillRect(QRectF(frame.topLeft(), QPointF(low, frame.bottom())), colour)
        if high < frame.right():
            painter.fillRect(QRectF(QPointF(high, frame.top()), frame.bottomRight()), colour)

    def _draw_curve(self, painter: QPainter, axes: Axes, shown: Shown, rank: int) -> None:
        found = shown.found
        values = found.coherence[rank] if shown.coherence else decibels(found.magnitude[rank])
        painter.setPen(current_theme().output_pen(rank, 1.4))
        painter.drawPolyline(axes.polygon(found.frequency_hz, values))
        if not shown.coherence and found.noise[rank].any():
            pen = QPen(current_theme().output_colour(rank), 1.0, Qt.PenStyle.DotLine)
            painter.setPen(pen)
            painter.drawPolyline(axes.polygon(found.frequency_hz, decibels(found.noise[rank])))

    def _draw_bars(self, painter: QPainter, axes: Axes, shown: Shown) -> None:
        """Bands that can be used, as bars at the foot."""
        bands = shown.found.usable_hz
        step, thick = bar_sizes(len(bands), axes.frame.height())
        foot = axes.frame.bottom() - UNIT_PX / 2
        for rank, (low, high) in enumerate(bands):
            y = foot - rank * step
            painter.setPen(QPen(current_theme().output_colour(rank), thick))
            if np.isfinite(low):
                left, right = axes.to_screen(np.array([low, high]), np.zeros(1))[:, 0]
                painter.drawLine(QLineF(left, y, right, y))


def bar_sizes(n: int, height_px: float) -> tuple[float, float]:
    """From one of ``n`` bars to the next, and how thick they are, px."""
    step = min(_BAR_PX + 1.0, _BARS_PART * height_px / max(n, 1))
    return step, step * _BAR_PX / (_BAR_PX + 1.0)
