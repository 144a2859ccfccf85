"""Delays and levels over the way along a line, and the straight lines through them."""

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen
from PySide6.QtWidgets import QWidget

from skinsource.base.arrays import Booleans, Floats
from skinsource.engine.analysis_rules import LineWave
from skinsource_gui.theme import UNIT_PX, current_theme
from skinsource_gui.widgets.fields.level_text import minus
from skinsource_gui.widgets.figure.axes import Axes, Axis, fitted_axes
from skinsource_gui.widgets.figure.figure import Figure

_DOT_PX, _REACH_PX = 4.0, 14.0
_WAY = "Way along the line (mm)"


class WavePicture(Figure):
    """Two diagrams side by side: delay and level."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("wave_picture", "Delay and level along the line", parent)
        self.shown: LineWave | None = None
        self._ranks: tuple[int, ...] = ()
        self._matched = ""
        self._diagrams: list[tuple[Axes, Floats]] = []

    def show_wave(self, shown: LineWave, ranks: tuple[int, ...], matched: str) -> None:
        """Take over what to show; ``ranks`` are those of the outputs in the selection.

        ``matched``: by how much it is louder or softer than it was stored, or "".
        """
        self.shown, self._ranks, self._matched = shown, ranks, matched
        self.say("")
        self.read_again()

    def draw(self, painter: QPainter, room: QRectF) -> None:
        if self.shown is None:
            return
        wave = self.shown.wave
        metrics = QFontMetricsF(painter.font())
        halves = _halves(room)
        way = Axis(shown=_around(wave.distance_m), title=_WAY, factor=1e3)
        delay = Axis(shown=_around(wave.delay_s), title="Delay (ms)", factor=1e3)
        title = ", ".join(filter(None, (f"Level {self.shown.axis} (dB)", self._matched)))
        level = Axis(shown=_around(wave.level_db), title=title)
        self._diagrams = []
        slowness = 1.0 / wave.speed_m_per_s
        for area, axis, values, slope, used in (
            (halves[0], delay, wave.delay_s, slowness, wave.timed),
            (halves[1], level, wave.level_db, -wave.attenuation_db_per_cm * 100.0, wave.counted),
        ):
            painter.save()
            # Labels of y begin at the left edge of their half.
            painter.translate(area.left(), area.top())
            axes = fitted_axes(QRectF(0, 0, area.width(), area.height()), way, axis, metrics)
            axes.paint(painter, current_theme())
            painter.setClipRect(axes.frame.adjusted(-_DOT_PX, -_DOT_PX, _DOT_PX, _DOT_PX))
            self._draw_fit(painter, axes, values[used], wave.distance_m[used], slope)
            places = self._draw_dots(painter, axes, values, used)
            painter.restore()
            self._diagrams.append((axes, places + np.array([area.left(), area.top()])))

    def read(self, at: QPointF) -> str:
        if self.shown is None:
            return ""
        wave, outputs = self.shown.wave, self.shown.outputs
        for _, places in self._diagrams:
            ways = np.hypot(*(places - (at.x(), at.y())).T)
            if np.isfinite(ways).any() and np.nanmin(ways) <= _REACH_PX:
                k = int(np.nanargmin(ways))
                left_out = "" if wave.counted[k] else " · left out: silent or mostly noise"
                if wave.counted[k] and not wave.timed[k]:
                    left_out = " · no delay: too unlike the first"
                delay = f"{wave.delay_s[k] * 1e3:.2f} ms, " if np.isfinite(wave.delay_s[k]) else ""
                return minus(
                    f"{outputs[k]}: {wave.distance_m[k] * 1e3:.0f} mm, {delay}"
                    f"{wave.level_db[k]:z.1f} dB, alike {wave.alike[k]:.0%}{left_out}"
                )
        return ""

    def _draw_fit(
        self, painter: QPainter, axes: Axes, values: Floats, x: Floats, slope: float
    ) -> None:
        if not np.isfinite(slope):
            return
        ends = np.array([x.min(), x.max()])
        middle = float(values.mean())
        painter.setPen(QPen(QColor(current_theme().dim), 1.2, Qt.PenStyle.DashLine))
        painter.drawPolyline(axes.polygon(ends, middle + slope * (ends - x.mean())))

    def _draw_dots(self, painter: QPainter, axes: Axes, values: Floats, used: Booleans) -> Floats:
        if self.shown is None:
            return np.zeros((0, 2))
        wave = self.shown.wave
        places = axes.to_screen(wave.distance_m, values)
        for rank, place, counted in zip(self._ranks, places, used, strict=True):
            if not np.isfinite(place).all():
                continue
            colour = current_theme().output_colour(rank)
            painter.setPen(QPen(colour, 1.5))
            painter.setBrush(colour if counted else Qt.BrushStyle.NoBrush)
            painter.drawEllipse(QPointF(*place), _DOT_PX, _DOT_PX)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        return places


def _halves(room: QRectF) -> tuple[QRectF, QRectF]:
    """Side by side where it is wide enough, else over each other."""
    if room.width() >= 1.2 * room.height():
        half = room.width() / 2
        left = QRectF(room.left(), room.top(), half - UNIT_PX / 2, room.height())
        return left, left.translated(half + UNIT_PX / 2, 0)
    half = room.height() / 2
    top = QRectF(room.left(), room.top(), room.width(), half)
    return top, top.translated(0, half)


def _around(values: Floats) -> tuple[float, float]:
    """A range with some air around values; any range where there are none."""
    known = values[np.isfinite(values)]
    if not known.size:
        return 0.0, 1.0
    low, high = float(known.min()), float(known.max())
    air = 0.08 * (high - low) or max(abs(high) * 0.1, 1e-3)
    return low - air, high + air
