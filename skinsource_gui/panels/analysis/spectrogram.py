"""The spectrogram of one selected output."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt

from skinsource.base.conventions import Floats
from skinsource.base.decibels import decibels
from skinsource.design.comparing import match_text
from skinsource.design.design import Design, View
from skinsource.design.labels import signal_label
from skinsource.design.panel_settings import (
    CEILING,
    FLOOR,
    WINDOW,
    SpectrogramSettings,
    settings_of,
)
from skinsource.limbs.locations import output_name
from skinsource.limbs.own_limbs import facts_of
from skinsource.signals.analysis.spectrogram import Spectrogram
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.fields.units import axis_unit, minus, output_text
from skinsource_gui.panels.analysis.view import FigureView
from skinsource_gui.plots.colour_maps import colour_indices, colour_table
from skinsource_gui.plots.figure import Axes, Axis, Figure, fitted_axes
from skinsource_gui.plots.ranges import BEFORE_S, Range
from skinsource_gui.qt.fitting import FoldingRow, fit_to_letters, grouped
from skinsource_gui.qt.layouts import Policy, named
from skinsource_gui.qt.theme import UNIT_PX, current_theme
from skinsource_gui.state.compared import SILENT

#: How far below its loudest the colours go.
SPAN_DB = 60.0
_SCALE_PX = 10.0
# The reference is below the highest level where the scale is so many lines high.
_REFERENCE, _ROOM_LINES = "re 1 m/s²", 5.0
_FLAGS = Qt.AlignmentFlag.AlignVCenter


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SpectrogramContent:
    """What the picture shows.

    Attributes
    ----------
    first_s
        Time of the first sample of the record.
    band_hz
        Floor and ceiling.
    matched
        Text on how much louder or softer than stored it is, or "".
    """

    spectrogram: Spectrogram
    first_s: float
    band_hz: Range
    matched: str = ""


class SpectrogramPicture(Figure):
    """Amplitude as colour, over time and frequency."""

    def __init__(self) -> None:
        super().__init__("spectrogram_picture", "Spectrogram")
        self.content: SpectrogramContent | None = None
        self.range_db: Range = (-SPAN_DB, 0.0)
        self._playhead_s: float | None = None
        self._table = colour_table()
        self._pixels: np.ndarray | None = None
        self._image = QtGui.QImage()

    def show_spectrogram(self, content: SpectrogramContent) -> None:
        """Take over what to show."""
        self.content = content
        rows = _rows_within(content)
        levels = decibels(content.spectrogram.amplitude[rows])
        top = self.steady_range.follow(float(levels.min()), float(levels.max()), "level")[1]
        self.range_db = (top - SPAN_DB, top)
        codes = colour_indices(levels, self.range_db)
        self._pixels = np.ascontiguousarray(self._table[codes[::-1]])
        height, width = self._pixels.shape
        self._image = QtGui.QImage(
            self._pixels.data, width, height, 4 * width, QtGui.QImage.Format.Format_RGB32
        )
        self.say("")

    def show_playhead(self, time_s: float) -> None:
        """Take over where the playhead stands."""
        self._playhead_s = time_s
        self.update()

    def draw(self, painter: QtGui.QPainter, room: QRectF) -> None:
        content = self.content
        if content is None:
            return
        metrics = QtGui.QFontMetricsF(painter.font())
        widest_texts = scale_text(-100.0, top=True, matched=content.matched)
        widest = max(map(metrics.horizontalAdvance, widest_texts))
        scale_px = widest + _SCALE_PX + 2 * UNIT_PX
        inner = room.adjusted(0, 0, -scale_px, 0)
        frequency = Axis(shown=content.band_hz, title="Frequency (Hz)")
        self.axes = axes = fitted_axes(inner, _time_axis(content), frequency, metrics)
        painter.setRenderHint(QtGui.QPainter.RenderHint.SmoothPixmapTransform)
        painter.save()
        painter.setClipRect(axes.frame)
        painter.fillRect(axes.frame, QtGui.QColor(int(self._table[0])))
        painter.drawImage(self._image_place(axes, content), self._image)
        self._draw_lines(painter, axes)
        painter.restore()
        axes.paint(painter, current_theme(), grid=False)
        self._draw_scale(painter, axes, room, metrics)

    def read(self, at: QPointF) -> str:
        axes = self.axes
        place = None if axes is None else axes.value_at(at)
        if axes is None or place is None or self.content is None:
            return ""
        time_s, frequency_hz = place
        level = float(
            decibels(self.content.spectrogram.at(time_s - self.content.first_s, frequency_hz))
        )
        long = axes.x.factor == 1.0
        when = f"{time_s:.4f} s" if long else f"{time_s * 1e3:.1f} ms"
        return minus(f"{when} · {frequency_hz:.1f} Hz · {level:z.1f} dB re 1 m/s²")

    def _image_place(self, axes: Axes, content: SpectrogramContent) -> QRectF:
        """Return where the image lies: its columns and rows are the middles of their cells."""
        spectrogram = content.spectrogram
        x = _edges(spectrogram.time_s + content.first_s)
        y = _edges(spectrogram.frequency_hz[_rows_within(content)])
        corners = axes.to_screen(np.array(x), np.array(y))
        return QRectF(QPointF(*corners[0]), QPointF(*corners[1])).normalized()

    def _draw_lines(self, painter: QtGui.QPainter, axes: Axes) -> None:
        frame = axes.frame
        if self._playhead_s is not None:
            x = float(axes.to_screen(np.array([self._playhead_s]), np.zeros(1))[0, 0])
            line = QLineF(x, frame.top(), x, frame.bottom())
            # The colour of every playhead, on a ground that shows it on dark colours too.
            for colour, width_px in ((current_theme().base, 3.5), (current_theme().error, 1.5)):
                painter.setPen(QtGui.QPen(QtGui.QColor(colour), width_px))
                painter.drawLine(line)
        if self.cursor_at is not None:
            pen = QtGui.QPen(QtGui.QColor("#ffffff"), 1, Qt.PenStyle.DashLine)
            painter.setPen(pen)
            painter.drawLine(
                QLineF(self.cursor_at.x(), frame.top(), self.cursor_at.x(), frame.bottom())
            )
            painter.drawLine(
                QLineF(frame.left(), self.cursor_at.y(), frame.right(), self.cursor_at.y())
            )

    def _draw_scale(
        self, painter: QtGui.QPainter, axes: Axes, room: QRectF, metrics: QtGui.QFontMetricsF
    ) -> None:
        frame, line = axes.frame, metrics.height()
        ramp = QRectF(frame.right() + 2 * UNIT_PX, frame.top(), _SCALE_PX, frame.height())
        colours = np.ascontiguousarray(self._table[::-1, None])
        image = QtGui.QImage(colours.data, 1, len(colours), 4, QtGui.QImage.Format.Format_RGB32)
        painter.drawImage(ramp, image)
        painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().border), 1))
        painter.drawRect(ramp)
        painter.setPen(QtGui.QColor(current_theme().dim))
        low, high = self.range_db
        matched = "" if self.content is None else self.content.matched
        for part in (0.0, 0.5, 1.0):
            y = ramp.bottom() - part * ramp.height()
            place = QRectF(ramp.right() + 4, y - line / 2, room.right() - ramp.right() - 4, line)
            has_reference = matched or ramp.height() > _ROOM_LINES * line
            top = bool(has_reference) and part == 1.0
            for text in scale_text(low + part * (high - low), top=top, matched=matched):
                painter.drawText(place, _FLAGS, text)
                place.translate(0.0, line)


def scale_text(level_db: float, *, top: bool, matched: str = "") -> tuple[str, ...]:
    """Return the lines for a level beside the scale, at its ``top`` with the reference."""
    text = minus(f"{level_db:.0f} dB")
    below = matched.rsplit(" ", 1) if matched else ()
    return (text, _REFERENCE, *below) if top else (text,)


def _rows_within(content: SpectrogramContent) -> slice:
    frequency_hz, (low, high) = content.spectrogram.frequency_hz, content.band_hz
    first = int(np.searchsorted(frequency_hz, low, "left"))
    end = int(np.searchsorted(frequency_hz, high, "right"))
    # One beyond each end: the picture is cut at the frame, not before it.
    return slice(max(first - 1, 0), min(max(end, first + 1) + 1, frequency_hz.size))


def _edges(middles: Floats) -> Range:
    half = 0.5 * float(middles[1] - middles[0]) if middles.size > 1 else 0.5e-3
    return float(middles[0]) - half, float(middles[-1]) + half


def _time_axis(content: SpectrogramContent) -> Axis:
    time_s = content.spectrogram.time_s + content.first_s
    # As in traces, the record before the pulse of the measurement is left out.
    first, last = max(float(time_s[0]), -BEFORE_S), float(time_s[-1])
    last = last if last > first else first + 1e-3
    unit, factor = axis_unit(last)
    return Axis(shown=(first, last), title=f"Time ({unit})", factor=factor)


_NARROWEST_HZ, _MOST_NUMBER_PX = 5.0, 84


class SpectrogramView(FigureView):
    """How much of each frequency there is in an output, and when."""

    name: ClassVar[str] = "spectrogram"
    needs = frozenset(
        {"output_spectrogram", "spectrogram_output", "response_time_s", "sample_rate_hz"}
        | {"axes", "match_gain", "method", "limb_data"}
    )
    copies: ClassVar[bool] = False

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        self.picture = SpectrogramPicture()
        super().__init__(self.picture, parent)
        self.settings = SpectrogramSettings()
        self.output = ChoiceField(ChoiceSpec(label="Output", options=()), empty="Select outputs")
        self.output.setObjectName("spectrogram_output")
        self.window_length = named(ChoiceField(WINDOW), "spectrogram_window")
        self.floor = NumberField(FLOOR, widest_unit="Hz")
        self.ceiling = NumberField(CEILING, widest_unit="Hz")
        for choice in (self.output, self.window_length):
            # Never narrower than its text.
            choice.setMinimumContentsLength(0)
            choice.setSizeAdjustPolicy(QtWidgets.QComboBox.SizeAdjustPolicy.AdjustToContents)
        self.window_length.setSizePolicy(Policy.Maximum, Policy.Fixed)
        for field in (self.floor, self.ceiling):
            fit_to_letters(field, _MOST_NUMBER_PX, at_most=True)
        gap_px = UNIT_PX // 2
        what = grouped(self.output, self.window_length, gap_px=gap_px)
        dash = QtWidgets.QLabel("–")
        band = grouped(self.floor, dash, self.ceiling, None, gap_px=gap_px)
        self.choices.addWidget(FoldingRow((what, band), gap_px))
        self.output.edited.connect(lambda number, _: self.change_settings(output=float(number)))
        self.window_length.edited.connect(
            lambda window_ms, _: self.change_settings(window_ms=window_ms)
        )
        self.floor.edited.connect(lambda value_hz, _: self.change_settings(floor_hz=value_hz))
        self.ceiling.edited.connect(lambda value_hz, _: self.change_settings(ceiling_hz=value_hz))
        self.figure.say(self.no_outputs)

    @property
    def picture_text(self) -> str:
        return f"Window {self.window_length.currentText()}"

    def show_state(self, design: Design, view: View) -> None:
        settings = settings_of(view, self.name, SpectrogramSettings)
        redrawn = (settings.floor_hz, settings.ceiling_hz) != (
            self.settings.floor_hz,
            self.settings.ceiling_hz,
        )
        self._view, self.settings = view, settings
        self._show_choices(design.limb)
        self.picture.show_playhead(view.playhead_s)
        if self.show_selection(view) and redrawn and self._results is not None:
            self._draw(self._results)

    def show_playhead(self, view: View) -> None:
        self._view = view
        self.picture.show_playhead(view.playhead_s)

    def show_results(self, results: Mapping[str, Any]) -> None:
        if results["output_spectrogram"] is None:
            self.say_instead(self.no_outputs)
            return
        if not results["output_spectrogram"].amplitude.any():
            self.say_instead(SILENT)
            return
        self._results = dict(results)
        self._draw(results)

    def _show_choices(self, limb: str) -> None:
        settings, outputs = self.settings, self._view.outputs
        known = [self.output.itemText(k) for k in range(self.output.count())]
        names = [f"{number} {output_name(number, limb).short_name}" for number in outputs]
        if known != names:
            self.output.clear()
            for number, name in zip(outputs, names, strict=True):
                self.output.addItem(name, str(number))
        chosen = settings.output if settings.output in outputs else (outputs or (0,))[-1]
        self.output.set_value(str(chosen) if chosen else "")
        self.output.setEnabled(len(outputs) > 1)
        self.window_length.set_value(settings.window_ms)
        self.floor.set_value(settings.floor_hz)
        self.ceiling.set_value(min(settings.ceiling_hz, facts_of(limb).sample_rate_hz / 2.0))

    def _draw(self, results: Mapping[str, Any]) -> None:
        spectrogram = results["output_spectrogram"]
        band = _band(self.settings, results["sample_rate_hz"] / 2.0)
        first_s = float(results["response_time_s"][0])
        matched = match_text(results["match_gain"])
        self.picture.show_spectrogram(
            SpectrogramContent(
                spectrogram=spectrogram, first_s=first_s, band_hz=band, matched=matched
            )
        )
        number = results["spectrogram_output"]
        limb = results["limb_data"]
        parts = [output_text(number, limb.name), "amplitude"]
        parts.append(signal_label(results["axes"], results["method"]))
        if results["method"] == "mag" and len(results["axes"]) > 1:
            parts.append("of a magnitude: rectified, doubled frequencies")
        if limb.synthetic:
            parts.append("synthetic limb")
        self.show_result(" · ".join(parts))


def _band(settings: SpectrogramSettings, highest_hz: float) -> Range:
    """Return floor and ceiling within the known frequencies, some hertz apart."""
    floor = min(settings.floor_hz, highest_hz - _NARROWEST_HZ)
    ceiling = min(settings.ceiling_hz, highest_hz)
    return (floor, ceiling) if ceiling - floor >= _NARROWEST_HZ else (floor, highest_hz)
