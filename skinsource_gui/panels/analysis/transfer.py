"""Transfer functions from the selected track's place to the selected outputs."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt

from skinsource.base.decibels import decibels
from skinsource.design.design import Design, View
from skinsource.design.panel_settings import settings_of
from skinsource.limbs.locations import input_name
from skinsource.signals.analysis.transfer import LEAST_COHERENCE, Transfer
from skinsource_gui.fields.units import minus
from skinsource_gui.panels.analysis.settings import TransferSettings
from skinsource_gui.panels.analysis.view import FigureView
from skinsource_gui.plots.figure import Axes, Axis, Figure, draw_legend, fitted_axes
from skinsource_gui.plots.ranges import LEVEL_SPAN_DB
from skinsource_gui.qt.buttons import tool_button
from skinsource_gui.qt.labels import how_to_add
from skinsource_gui.qt.questions import tab_separated
from skinsource_gui.qt.theme import UNIT_PX, current_theme, translucent

# Bars of many outputs share this part of the height, above which the curves are visible.
_BAR_PX, _BARS_PART = 3.0, 0.1


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TransferContent:
    """Transfer functions to ``outputs``, in a unit; with ``coherence`` that is drawn instead."""

    transfer: Transfer
    outputs: tuple[int, ...]
    unit: str
    coherence: bool


class TransferPicture(Figure):
    """One curve of each output; below, where it is more than noise."""

    def __init__(self) -> None:
        super().__init__("transfer_picture", "Transfer functions")
        self.content: TransferContent | None = None
        self._top_db = 0.0

    def show_transfer(self, content: TransferContent) -> None:
        """Take over what to show."""
        self.content = content
        highest = float(decibels(content.transfer.magnitude).max())
        self._top_db = self.steady_range.follow(highest, highest, "level")[1]
        self.say("")

    def draw(self, painter: QtGui.QPainter, room: QRectF) -> None:
        content = self.content
        if content is None:
            return
        frequency_hz = content.transfer.frequency_hz
        x = Axis(shown=(0.0, float(frequency_hz[-1])), title="Frequency (Hz)")
        if content.coherence:
            y = Axis(shown=(0.0, 1.0), title="Coherence")
        else:
            shown = self._top_db - LEVEL_SPAN_DB, self._top_db
            y = Axis(shown=shown, title=f"dB re {content.unit}")
        metrics = QtGui.QFontMetricsF(painter.font())
        head = QRectF(room.left(), room.top(), room.width(), metrics.height())
        inner = head.adjusted(UNIT_PX, 0, -UNIT_PX, 0)
        draw_legend(painter, inner, content.outputs, current_theme(), broken=True)
        self.axes = axes = fitted_axes(room.adjusted(0, head.height(), 0, 0), x, y, metrics)
        self._shade(painter, axes, content)
        axes.paint(painter, current_theme())
        painter.save()
        painter.setClipRect(axes.frame)
        self._draw_bars(painter, axes, content)
        for rank in range(len(content.outputs)):
            self._draw_curve(painter, axes, content, rank)
        if self.cursor_at is not None:
            painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().dim), 1, Qt.PenStyle.DashLine))
            at = self.cursor_at.x()
            painter.drawLine(QLineF(at, axes.frame.top(), at, axes.frame.bottom()))
        painter.restore()

    def read(self, at: QPointF) -> str:
        place = None if self.axes is None else self.axes.value_at(at)
        if place is None or self.content is None:
            return ""
        transfer = self.content.transfer
        k = int(np.argmin(np.abs(transfer.frequency_hz - place[0])))
        parts = [f"{transfer.frequency_hz[k]:.1f} Hz, dB and coherence"]
        for rank, output in enumerate(self.content.outputs):
            level = float(decibels(transfer.magnitude[rank, k]))
            parts.append(f"{output}: {level:z.1f}, {transfer.coherence[rank, k]:.2f}")
        return minus(" · ".join(parts))

    def _shade(self, painter: QtGui.QPainter, axes: Axes, content: TransferContent) -> None:
        """Shade the frequencies that were not measured, where that is known."""
        if content.transfer.band_hz is None:
            return
        band_hz = np.array(content.transfer.band_hz)
        colour = translucent(current_theme().grid, 140)
        frame = axes.frame
        low, high = (float(p[0]) for p in axes.to_screen(band_hz, np.zeros(1)))
        painter.fillRect(QRectF(frame.topLeft(), QPointF(low, frame.bottom())), colour)
        if high < frame.right():
            painter.fillRect(QRectF(QPointF(high, frame.top()), frame.bottomRight()), colour)

    def _draw_curve(
        self, painter: QtGui.QPainter, axes: Axes, content: TransferContent, rank: int
    ) -> None:
        transfer = content.transfer
        values = (
            transfer.coherence[rank] if content.coherence else decibels(transfer.magnitude[rank])
        )
        painter.setPen(current_theme().output_pen(rank, 1.4))
        painter.drawPolyline(axes.polygon(transfer.frequency_hz, values))
        if not content.coherence and transfer.noise[rank].any():
            pen = QtGui.QPen(current_theme().output_colour(rank), 1.0, Qt.PenStyle.DotLine)
            painter.setPen(pen)
            painter.drawPolyline(
                axes.polygon(transfer.frequency_hz, decibels(transfer.noise[rank]))
            )

    def _draw_bars(self, painter: QtGui.QPainter, axes: Axes, content: TransferContent) -> None:
        """Draw the bands that can be used, as bars at the foot."""
        bands = content.transfer.usable_hz
        step, thick = bar_sizes(len(bands), axes.frame.height())
        foot = axes.frame.bottom() - UNIT_PX / 2
        for rank, (low, high) in enumerate(bands):
            y = foot - rank * step
            painter.setPen(QtGui.QPen(current_theme().output_colour(rank), thick))
            if np.isfinite(low):
                left, right = axes.to_screen(np.array([low, high]), np.zeros(1))[:, 0]
                painter.drawLine(QLineF(left, y, right, y))


def bar_sizes(n: int, height_px: float) -> tuple[float, float]:
    """Return the step from one of ``n`` bars to the next, and their thickness, px."""
    step = min(_BAR_PX + 1.0, _BARS_PART * height_px / max(n, 1))
    return step, step * _BAR_PX / (_BAR_PX + 1.0)


#: What has to be known for it.
OF_UNIT = frozenset({"actuation", "limb_data", "scaling"})


def transfer_unit(results: Mapping[str, Any]) -> str:
    """Return the unit of a magnitude; where drives have no known unit, per sample of 1."""
    actuation = results["actuation"]
    if actuation is not None and actuation.equaliser is None:
        return "1 (m/s²)/V"
    answers_probe = actuation is not None or not results["limb_data"].per_unit_drive
    known = results["scaling"] == "probe" and answers_probe
    return "1 (m/s²)/(m/s²)" if known else "1 m/s² per sample of 1"


# More outputs than these are written as ranges.
_MOST_NUMBERS = 12


class TransferView(FigureView):
    """Magnitude or coherence of each output over frequency, with what can be used of it."""

    name: ClassVar[str] = "transfer"
    needs = frozenset({"transfer", "transfer_place", "shown_outputs", *OF_UNIT, "limb_data"})

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        self.picture = TransferPicture()
        super().__init__(self.picture, parent)
        self.settings = TransferSettings()
        self._has_inputs = True
        hint = "Draw the coherence: the share of power that is not noise"
        self.coherence = tool_button(None, "transfer_coherence", "Coherence", hint, checkable=True)
        self.coherence.clicked.connect(lambda on: self.change_settings(coherence=on))
        self.place = self.add_above("transfer_place")
        self.choices.addWidget(self.coherence)
        self.choices.addStretch(1)
        self.heads.addWidget(self.place)
        self.figure.say(self.no_outputs)

    def show_state(self, design: Design, view: View) -> None:
        settings = settings_of(view, self.name, TransferSettings)
        redrawn = settings != self.settings
        self._view, self.settings = view, settings
        self.coherence.setChecked(settings.coherence)
        self._has_inputs = bool(design.inputs)
        if not view.outputs or not design.inputs:
            self._show_empty()
        elif self._results is None:
            self.await_results()
        elif redrawn:
            self._draw(self._results)

    def show_results(self, results: Mapping[str, Any]) -> None:
        if results["transfer"] is None:
            self._show_empty()
            return
        self._results = dict(results)
        self._draw(results)

    def table_text(self) -> str:
        if self._results is None:
            return ""
        transfer: Transfer = self._results["transfer"]
        outputs = self._results["shown_outputs"]
        header = ["frequency_hz"]
        for name in ("magnitude", "noise_rms", "coherence"):
            header += [f"{name}_{output}" for output in outputs]
        columns = (
            transfer.frequency_hz[None],
            transfer.magnitude,
            transfer.noise,
            transfer.coherence,
        )
        return tab_separated((header, *np.vstack(columns).T.tolist()))

    def _show_empty(self) -> None:
        self.say_instead(self.no_outputs if self._has_inputs else how_to_add())

    def say_instead(self, message: str) -> None:
        super().say_instead(message)
        self.place.say("")

    def _draw(self, results: Mapping[str, Any]) -> None:
        transfer, outputs = results["transfer"], results["shown_outputs"]
        self.offer_copy(True)
        unit = transfer_unit(results)
        self.picture.show_transfer(
            TransferContent(
                transfer=transfer, outputs=outputs, unit=unit, coherence=self.settings.coherence
            )
        )
        place, limb = results["transfer_place"], results["limb_data"]
        if limb.synthetic:
            note = " · synthetic limb, without noise"
        elif not transfer.noise.any():
            note = " · noise not known"
        else:
            # Of a coherence nothing dotted is drawn.
            note = "" if self.settings.coherence else " · dotted: noise"
        self.place.say(f"From place {place}, {input_name(place, limb.name).name}{note}")
        self.show_result(_usable_text(transfer, outputs))


def _usable_text(transfer: Transfer, outputs: tuple[int, ...]) -> str:
    """Return where the response is more than noise; outputs with the same band are one entry."""
    outputs_by_band: dict[str, list[int]] = {}
    for output, (low, high) in zip(outputs, transfer.usable_hz, strict=True):
        band = f"{low:.0f}–{high:.0f} Hz" if np.isfinite(low) else "nowhere"
        outputs_by_band.setdefault(band, []).append(output)
    parts = [f"{_numbers(those)}: {band}" for band, those in outputs_by_band.items()]
    low, high = transfer.band_hz or (0.0, float(transfer.frequency_hz[-1]))
    return f"Coherence ≥ {LEAST_COHERENCE:g} from {low:g} to {high:g} Hz: {' · '.join(parts)}"


def _numbers(outputs: list[int]) -> str:
    """Return the numbers of outputs, many of them as ranges."""
    if len(outputs) <= _MOST_NUMBERS:
        return ", ".join(map(str, outputs))
    ordered = np.unique(outputs)
    runs = np.split(ordered, np.flatnonzero(np.diff(ordered) > 1) + 1)
    ranges = (f"{run[0]}–{run[-1]}" if len(run) > 1 else f"{run[0]}" for run in runs)
    return f"{len(ordered)} outputs ({', '.join(ranges)})"
