"""The page on which a recording is examined and chosen before it is placed in the design.

A worker reads the file; the page shows what the file holds and what would be imported.  Its form
asks what a file leaves open; its strip shows the whole recording, and the part that is imported is
dragged in it.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np
import pyqtgraph
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QPointF, QSignalBlocker, QSize, Qt, Signal

from skinsource.base.conventions import SAMPLE_RATE_HZ, Band, Floats
from skinsource.base.errors import SkinSourceError, Stopped, counted
from skinsource.base.files import path_text
from skinsource.base.job import Job, Progress, Stop, stop_if
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.recordings import (
    ImportChoice,
    RawPart,
    Taken,
    at_common_peak,
    read_for,
    read_part,
    suggested,
    usual_scale,
)
from skinsource.design.waveforms.samples import Recording
from skinsource.limbs.limb import LimbFacts
from skinsource.readers.limits import LEAST_RATE_HZ, MOST_PART_S, MOST_RATE_HZ
from skinsource.readers.reader import Found, Series, other_axes, signals_beside
from skinsource.readers.reading_process import ReadingProcess
from skinsource.readers.units import UNITS
from skinsource.signals.spectra import share_outside_band
from skinsource.specs.samples import Samples
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.fields.units import axis_unit
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.plots.curves import CurveName, Curves, PlotTexts
from skinsource_gui.plots.plot import Plot
from skinsource_gui.plots.preview import SpectrumPreview
from skinsource_gui.plots.ranges import Range, XAxis, wave_of
from skinsource_gui.qt.buttons import Answer, answers, page_label, progress_bar
from skinsource_gui.qt.layouts import form_of, in_column, in_row, named
from skinsource_gui.qt.resources import choice_of, number_named
from skinsource_gui.qt.theme import UNIT_PX, current_theme, tabular, translucent
from skinsource_gui.state.worker import Worker, fault_text

#: Sample rate of a file that states none, until one is typed.
ASSUMED_RATE_HZ = SAMPLE_RATE_HZ
# Recordings up to the first length are imported whole at first, of longer ones the beginning.
_WHOLE_UP_TO_S, _BEGINNING_S = 60.0, 10.0
_LONGEST_START_S = 1e6
_STEADY = "steady"
_SIGNAL = ChoiceSpec(label="Signal", options=(), hint="Which channel, column or dataset")
_AXES = ChoiceSpec(
    label="Import as",
    options=(),
    hint="As one: energy of all three, phase of their sum (DFT321)",
)
# The option to import each signal, and most signals for which it is offered.
_EACH, _MOST_SIGNALS = "each", 32
_TIMING = ChoiceSpec(label="Time column", options=(), hint="Column with the time of each sample")
_TIME_UNIT = ChoiceSpec(
    label="Time unit", options=(("1", "s"), ("0.001", "ms"), ("1e-06", "µs")), hint="Their unit"
)
_UNIT = ChoiceSpec(
    label="Unit",
    options=tuple((name, unit.title) for name, unit in UNITS.items()),
    hint="Velocities and displacements become accelerations, from 25 Hz on",
)
_SCALE = choice_of("recording_size")
_RATE = number_named("rate_of_recording", minimum=LEAST_RATE_HZ, maximum=MOST_RATE_HZ)
_START = number_named("start_of_part", maximum=_LONGEST_START_S)
_DURATION = number_named("length_of_part", maximum=MOST_PART_S)


#: Values of the fields of a form, by their names.
Made = dict[str, Any]
#: What a file is like, see `ChoiceForm.shape`.
Shape = tuple[object, ...]


class ChoiceForm(QtWidgets.QWidget):
    """Asks for what a file leaves open about a recording."""

    #: The present `ImportChoice`.
    changed = Signal(object)

    def __init__(self, contents: Found, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("import_form")
        self._contents = contents
        self.series = contents.signals()[0]
        self.choice = suggested(contents)
        self._lasts_s: float | None = None
        self._part_chosen = False
        # Chosen length of the part, also where less is left after its start.
        self._part_s = _BEGINNING_S
        self._beside: tuple[Series, ...] = ()
        # Keys of the other axes, by the option.
        self._others: dict[str, tuple[str, ...]] = {}
        self._signal, self._timing = ChoiceField(_SIGNAL), ChoiceField(_TIMING)
        self._axes = ChoiceField(_AXES)
        self._time_unit, self._unit = ChoiceField(_TIME_UNIT), ChoiceField(_UNIT)
        self._scale = ChoiceField(_SCALE)
        self._rate, self._start = NumberField(_RATE), NumberField(_START)
        self._duration = NumberField(_DURATION)
        self._offset = QtWidgets.QCheckBox("Remove DC offset")
        self._missing = QtWidgets.QCheckBox("Missing numbers become 0")
        self._widgets: dict[str, ChoiceField | NumberField | QtWidgets.QCheckBox] = {
            "signal": self._signal,
            "axes": self._axes,
            "timing": self._timing,
            "time_unit": self._time_unit,
            "rate": self._rate,
            "unit": self._unit,
            "scale": self._scale,
            "offset": self._offset,
            "start": self._start,
            "duration": self._duration,
            "missing": self._missing,
        }
        for name, widget in self._widgets.items():
            widget.setObjectName(f"import_{name}")
        self._lay_out()
        _fill(
            self._form, self._signal, [(signal.key, signal.name) for signal in contents.signals()]
        )
        self._take_series(self.series)

    @property
    def assumes_rate(self) -> bool:
        """Whether the rate is assumed: neither the file nor the user has stated it."""
        stated = self._contents.rate_of(self.series) is not None
        return self.choice.time is None and not stated and not self._rate_typed

    @property
    def lasts_s(self) -> float | None:
        """Length of the whole signal; None where it follows from time timestamps not read yet."""
        rate_hz = self.choice.rate_hz
        return self._lasts_s if rate_hz is None else self.series.n_samples / rate_hz

    @property
    def choices(self) -> tuple[ImportChoice, ...]:
        """The present choice; several where each signal gets a clip of its own."""
        if self._axes.value != _EACH:
            return (self.choice,)
        return tuple(replace(self.choice, series=signal.key) for signal in self._beside)

    @property
    def shape(self) -> Shape:
        """What files have in common that leave the same open about the same signals."""
        of = self._contents
        series = ((s.key, s.unit, s.is_time, of.rate_of(s) is None) for s in of.series)
        return (of.format, *series)

    @property
    def made(self) -> Made:
        """The choices that are not those that the file suggests, by the names of their fields."""
        usual = self._usual | {"scale": usual_scale(self._unit.value)}
        made = {name: value for name, value in self._values.items() if value != usual[name]}
        # Another file may be longer, so that its whole is another part.
        whole = self.choice.duration_s > (self.lasts_s or math.inf) - _LEAST_S
        if self._part_chosen and not whole:
            made["part"] = self._start.value_si, self._part_s
        return made

    def repeat(self, made: Made) -> None:
        """Make the choices that were made for another file, as far as this one leaves them open."""
        for name, widget in self._widgets.items():
            if name not in made:
                continue
            value = made[name]
            if isinstance(widget, QtWidgets.QCheckBox):
                widget.setChecked(value)
            elif isinstance(widget, NumberField):
                widget.set_value(value)
                self._take_over(rate_typed=True)
            elif self._form.isRowVisible(widget) and widget.findData(value) >= 0:
                widget.choose(value)
        start_s, length_s = made.get("part", (math.inf, 0.0))
        if start_s < (self.lasts_s or _LONGEST_START_S):
            self.take_part(start_s, length_s)

    def take_part(self, start_s: float, duration_s: float) -> None:
        """Choose another part, as a user does."""
        self._start.set_value(start_s)
        self._choose_part(max(duration_s, _DURATION.minimum))

    def show_length(self, lasts_s: float) -> None:
        """Set the length of the whole signal, and choose all of it unless a part was chosen."""
        self._lasts_s = lasts_s
        self._start.set_spec(replace(_START, maximum=lasts_s))
        whole_s = max(lasts_s, _DURATION.minimum) if lasts_s <= _WHOLE_UP_TO_S else _BEGINNING_S
        if not self._part_chosen:
            self._part_s = whole_s
        before = self.choice
        self._fit()
        if self.choice != before:
            self.changed.emit(self.choice)

    def show_missing(self, n_missing: int) -> None:
        """Offer to count missing numbers as 0, where there are some."""
        visible = n_missing > 0 or self._missing.isChecked()
        self._form.setRowVisible(self._missing, visible)

    @property
    def _values(self) -> Made:
        """What the fields show, but for the part."""
        shown: Made = {"rate": self._rate.value_si}
        for name, widget in self._widgets.items():
            if isinstance(widget, ChoiceField):
                shown[name] = widget.value
            elif isinstance(widget, QtWidgets.QCheckBox):
                shown[name] = widget.isChecked()
        return shown

    def _lay_out(self) -> None:
        self._form = form_of(self)
        for widget in self._widgets.values():
            self._form.addRow(widget.accessibleName(), widget)
        self._form.setRowVisible(self._missing, False)
        self._signal.edited.connect(self._choose_signal)
        self._unit.edited.connect(lambda unit, *_: self._scale.set_value(usual_scale(unit)))
        for field in (self._axes, self._timing, self._time_unit, self._unit, self._scale):
            field.edited.connect(self._take_over)
        self._start.edited.connect(lambda *_: self._choose_part())
        self._duration.edited.connect(lambda length_s, *_: self._choose_part(length_s))
        self._rate.edited.connect(lambda *_: self._take_over(rate_typed=True))
        self._offset.toggled.connect(self._take_over)
        self._missing.toggled.connect(self._take_over)

    def _choose_signal(self, key: str) -> None:
        series = self._contents.one(key)
        if series is not None:
            self._take_series(series)
            self._take_over()

    def _take_series(self, series: Series) -> None:
        """Show a signal with the likeliest choice for it."""
        self.series = series
        first = suggested(self._contents, series)
        stated = self._contents.rate_of(series)
        self._rate_typed = self._part_chosen = False
        self._lasts_s = None
        others = [
            other
            for other in self._contents.series
            if other.n_samples == series.n_samples and other.key != series.key
        ]
        # Without a stated rate, any column may hold the times, whatever its name.
        timestamps = [other for other in others if other.is_time or stated is None][:50]
        steady = "At a steady rate" if stated is None else f"At {stated:g} Hz"
        _fill(
            self._form,
            self._timing,
            [(_STEADY, steady), *((column.key, f"In {column.name}") for column in timestamps)],
        )
        axes = other_axes(self._contents, series)
        combined = f"With {' and '.join(axis.name for axis in axes)}, as one (DFT321)"
        offered = [(" ".join(axis.key for axis in axes), combined)] if axes else []
        self._others = {key: tuple(axis.key for axis in axes) for key, _ in offered}
        self._beside = signals_beside(self._contents, series)
        if 1 < len(self._beside) <= _MOST_SIGNALS:
            offered.append((_EACH, f"Each of {len(self._beside)}, a clip on its own track"))
        chosen = self._axes.value
        _fill(self._form, self._axes, [("", f"{series.name} alone"), *offered])
        if chosen == _EACH and self._axes.findData(_EACH) >= 0:
            self._axes.set_value(_EACH)
        self._timing.set_value(first.time or _STEADY)
        self._rate.set_value(stated or ASSUMED_RATE_HZ)
        self._time_unit.set_value(f"{first.time_unit_s:g}")
        self._unit.set_value(first.unit)
        self._scale.set_value(first.scale)
        self._form.setRowVisible(self._unit, not series.unit)
        self._offset.setChecked(first.remove_offset)
        lasts_s = series.n_samples / (stated or ASSUMED_RATE_HZ)
        known = stated is not None and first.time is None
        if known:
            self._start.set_spec(replace(_START, maximum=lasts_s))
        whole = known and lasts_s <= _WHOLE_UP_TO_S
        self._part_s = max(lasts_s, _DURATION.minimum) if whole else _BEGINNING_S
        self._start.set_value(0.0)
        self._fit()
        self._show_rows()
        first_key = self._contents.signals()[0].key
        self._usual = self._values | {"signal": first_key, "axes": "", "missing": False}

    def _choose_part(self, length_s: float | None = None) -> None:
        self._part_chosen = True
        self._part_s = self._part_s if length_s is None else length_s
        self._take_over()

    def _fit(self) -> None:
        """Update the choice; the part is no longer than what is left after its start."""
        # The length of the whole signal depends on the chosen rate.
        self.choice = self._choice_in_fields()
        most_s = MOST_PART_S
        if self.lasts_s is not None:
            left_s = self.lasts_s - self._start.value_si
            most_s = min(max(left_s, _DURATION.minimum), MOST_PART_S)
        self._duration.set_spec(replace(_DURATION, maximum=most_s))
        self._duration.set_value(min(self._part_s, most_s))
        self.choice = self._choice_in_fields()

    def _take_over(self, *_: object, rate_typed: bool = False) -> None:
        self._rate_typed = self._rate_typed or rate_typed
        self._fit()
        self._show_rows()
        self.changed.emit(self.choice)

    def _show_rows(self) -> None:
        steady = self._timing.value == _STEADY
        stated = self._contents.rate_of(self.series) is not None
        timestamps = self._contents.one(self._timing.value)
        self._form.setRowVisible(self._rate, steady and not stated)
        self._form.setRowVisible(self._time_unit, timestamps is not None and not timestamps.is_time)

    def _choice_in_fields(self) -> ImportChoice:
        timestamps = self._contents.one(self._timing.value)
        unit_s = (
            timestamps.time_unit_s
            if timestamps and timestamps.is_time
            else float(self._time_unit.value)
        )
        stated = self._contents.rate_of(self.series)
        return ImportChoice(
            series=self.series.key,
            rate_hz=None if timestamps else (stated or self._rate.value_si),
            time=timestamps.key if timestamps else None,
            time_unit_s=unit_s,
            unit=self._unit.value,
            scale="keep" if self._scale.value == "keep" else "peak",
            remove_offset=self._offset.isChecked(),
            start_s=self._start.value_si,
            duration_s=self._duration.value_si,
            missing="zero" if self._missing.isChecked() else "refuse",
            others=self._others.get(self._axes.value, ()),
        )


def _fill(form: QtWidgets.QFormLayout, field: ChoiceField, options: list[tuple[str, str]]) -> None:
    field.clear()
    for option, label in options:
        field.addItem(label, option)
    form.setRowVisible(field, len(options) > 1)


class ImportPreview(QtWidgets.QWidget):
    """Shows waveform, spectrum and numbers of a `Taken`, or why there is none."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("import_preview")
        self._waveform, self._spectrum = Plot(), SpectrumPreview()
        self._waveform.setAccessibleName("Waveform")
        self._waveform.navigation.zoom_requested.connect(self._zoom)
        self._axis = XAxis(titles=("",), unit="s")
        self._numbers = page_label("import_numbers")
        self._notes = page_label("import_notes", tone="dim")
        self._numbers.setFont(tabular(self._numbers.font()))
        for label in (self._numbers, self._notes):
            label.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        self._waveform.setMinimumHeight(150)
        self._spectrum.setMinimumHeight(120)
        policy = self._spectrum.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        self._spectrum.setSizePolicy(policy)
        self._numbers.setMinimumHeight(2 * self.fontMetrics().lineSpacing())
        self._notes.setMinimumHeight(3 * self.fontMetrics().lineSpacing())
        pictures = (self._waveform, 1), (self._spectrum, 1)
        labels = self._numbers, self._notes
        in_column(*pictures, *labels, of=self, margins=0, gap_px=UNIT_PX)

    @property
    def text(self) -> str:
        """The text below the pictures, or in their place."""
        return " ".join((self._waveform.message, self._numbers.text(), self._notes.text())).strip()

    def sizeHint(self) -> QSize:
        return QSize(440, 420)

    def show_part(
        self, parts: tuple[Taken, ...], shown: int, choice: ImportChoice, band_hz: Band | None
    ) -> None:
        """Show what ``choice`` imports, and the band in which the limb was measured.

        Of several parts that with the index ``shown`` is.
        """
        taken = parts[shown]
        samples = taken.samples
        rate = samples.sample_rate_hz
        time_s = np.arange(samples.values.size) / rate
        unit, factor = axis_unit(samples.duration_s)
        self._axis = XAxis(titles=(f"Time ({unit})",), unit=unit, factor=factor)
        self._zoom(None)
        values = samples.values[np.newaxis] / (samples.peak or 1.0)
        name = CurveName(number=0, short="", full="Waveform")
        wave = wave_of(time_s, values)
        self._waveform.show_curves(
            Curves(x=time_s, y=values, names=(name,), kind="relative", wave=wave)
        )
        self._spectrum.show_samples(samples.values, rate, band_hz)
        self._spectrum.show()
        rms = float(np.sqrt(np.mean(samples.values**2)))
        unit = f" {samples.unit}" if samples.unit else ""
        also = _in_own_unit(samples, choice)
        which = f"{shown + 1} of {len(parts)}: " if len(parts) > 1 else ""
        self._numbers.setText(
            f"{which}{samples.duration_s:.4g} s · largest sample {samples.peak:.3g}{unit}{also} · "
            f"RMS {rms:.3g}{unit} · {samples.values.size} samples at {rate:g} Hz"
            + ("" if band_hz is None else f"\n{_outside(samples, band_hz)}")
        )
        self._notes.setText(" ".join(taken.notes))
        self.set_pale(False)

    def show_message(self, message: str) -> None:
        """Show a message in place of the pictures."""
        self._waveform.show_message(message)
        self._spectrum.show_samples(None)
        self._spectrum.hide()
        self._numbers.clear()
        self._notes.clear()

    def set_pale(self, pale: bool) -> None:
        """Paint the waveform pale where it is out of date."""
        self._waveform.set_texts(PlotTexts(stale=pale))

    def _zoom(self, shown_s: Range | None) -> None:
        self._waveform.set_view(self._axis, shown_s, stacked=False)


def _in_own_unit(samples: Samples, choice: ImportChoice) -> str:
    """Return the peak in the file's unit of acceleration, if not m/s²: ``" (0.50 g)"``."""
    unit = UNITS[choice.unit]
    if choice.scale != "keep" or unit.factor == 1.0 or unit.derivatives:
        return ""
    peak = samples.peak / unit.factor
    return f" ({peak:.2f} {unit.name})" if peak >= 0.1 else f" ({peak:.2g} {unit.name})"


def _outside(samples: Samples, band_hz: Band) -> str:
    share = _percent(share_outside_band(samples.values, samples.sample_rate_hz, band_hz))
    low_hz, high_hz = band_hz
    return f"{share} of the energy lies outside the measured band, {low_hz:g} to {high_hz:g} Hz"


def _percent(share: float) -> str:
    if share < 0.001:
        return "Less than 0.1 %"
    return f"{100.0 * share:.1f} %" if share < 0.1 else f"{100.0 * share:.0f} %"


_HEIGHT_PX, _REACH_PX = 44, 6.0
_SHADE_ALPHA = 46
# Shorter drags choose nothing.
_LEAST_S = 1e-3


class OverviewStrip(pyqtgraph.PlotWidget):
    """Shows a whole recording; a drag moves the imported part or one of its ends.

    Where the part is the whole recording, a drag chooses a new part.  A double click chooses the
    whole recording.

    Parameters
    ----------
    longest_s
        Longest part.

    Attributes
    ----------
    extremes
        Least and largest value of each column, (2, columns); None: they are not known yet.
    """

    #: Start and length of the chosen part, s.
    part_chosen = Signal(float, float)

    def __init__(self, longest_s: float) -> None:
        super().__init__()
        self.extremes: Floats | None = None
        self._landmarks_s: Floats | None = None
        self._longest_s, self._lasts_s = longest_s, 1.0
        # Where a new part was begun.
        self._begun_s: float | None = None
        self.setObjectName("import_overview")
        self.setAccessibleName("Whole recording; type the part in Start and Length")
        self.setToolTip("Drag over the part to import; double click: all of it")
        self.setFixedHeight(_HEIGHT_PX)
        self.setBackground(QtGui.QColor(current_theme().base))
        self.setMouseEnabled(x=False, y=False)
        self.setMenuEnabled(False)
        self.hideButtons()
        for axis in ("left", "bottom"):
            self.hideAxis(axis)
        self.setDefaultPadding(0.0)
        self._curve = self.plot(connect="pairs", pen=current_theme().dim)
        edge = current_theme().accent
        shade = translucent(edge, _SHADE_ALPHA)
        self._part = pyqtgraph.LinearRegionItem(brush=shade, hoverBrush=shade, pen=edge)
        self.addItem(self._part)
        self._part.sigRegionChanged.connect(self._tell)

    def show_extremes(self, extremes: Floats | None) -> None:
        """Draw least and largest values, (2, columns); None: they are not known yet."""
        self.extremes = extremes
        self._show_curve()

    def show_landmarks(self, landmarks_s: Floats | None) -> None:
        """Set the times of samples spaced evenly by number; None: the rate is steady."""
        self._landmarks_s = landmarks_s
        self._show_curve()

    def show_part(self, lasts_s: float, start_s: float, duration_s: float) -> None:
        """Mark the part of a recording of that length."""
        if lasts_s != self._lasts_s:
            self._lasts_s = lasts_s
            self._show_curve()
        self.setXRange(0.0, lasts_s, padding=0.0)
        with QSignalBlocker(self._part):
            self._part.setBounds((0.0, lasts_s))
            self._part.setRegion((start_s, min(start_s + duration_s, lasts_s)))

    def x_of(self, time_s: float) -> float:
        """Return the position of a time, px."""
        return float(self.mapFromScene(self.getViewBox().mapViewToScene(QPointF(time_s, 0))).x())

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        start_s, end_s = self._part.getRegion()
        at_s = self._time_at(event)
        whole = end_s - start_s > self._lasts_s - _LEAST_S
        near = min(abs(self.x_of(end) - event.position().x()) for end in (start_s, end_s))
        if event.button() != Qt.MouseButton.LeftButton or near <= _REACH_PX:
            super().mousePressEvent(event)
        elif whole:
            self._begun_s = at_s
        else:
            if not start_s <= at_s <= end_s:
                half_s = (end_s - start_s) / 2.0
                middle_s = min(max(at_s, half_s), self._lasts_s - half_s)
                self._part.setRegion((middle_s - half_s, middle_s + half_s))
            super().mousePressEvent(event)

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        if self._begun_s is None:
            super().mouseMoveEvent(event)
        elif abs(self._time_at(event) - self._begun_s) > _LEAST_S:
            self._part.setRegion(sorted((self._begun_s, self._time_at(event))))

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        super().mouseReleaseEvent(event)
        self._begun_s = None

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        self._part.setRegion((0.0, min(self._lasts_s, self._longest_s)))

    def _time_at(self, event: QtGui.QMouseEvent) -> float:
        at = self.mapToScene(event.position().toPoint())
        time_s = float(self.getViewBox().mapSceneToView(at).x())
        return min(max(time_s, 0.0), self._lasts_s)

    def _tell(self) -> None:
        start_s, end_s = self._part.getRegion()
        self.part_chosen.emit(start_s, min(end_s - start_s, self._longest_s))

    def _show_curve(self) -> None:
        if self.extremes is None:
            self._curve.clear()
            return
        # An offset would leave little height for the signal.
        known = np.nan_to_num(self.extremes - np.nanmean(np.nan_to_num(self.extremes)))
        share = (np.arange(known.shape[1]) + 0.5) / known.shape[1]
        times_s = share * self._lasts_s
        if self._landmarks_s is not None:
            among = np.linspace(0.0, 1.0, self._landmarks_s.size)
            times_s = np.interp(share, among, self._landmarks_s)
        self._curve.setData(np.repeat(times_s, 2), known.T.ravel())


# Reading that takes longer is given up for a newer request.
_PATIENCE_S = 0.5
# Columns of the picture of the whole recording.
_COLUMNS = 600


_PART, _OVERVIEW = "part", "overview"
#: What is imported of each signal.
Choices = tuple[ImportChoice, ...]


class ReadingWorker(Worker):
    """Inspects a file and imports parts of it; samples in memory are not read again.

    Parameters
    ----------
    path
        The file.
    to_hz
        Sample rate of the imported parts.
    """

    #: The choices that failed, None for the inspection of the file, and a sentence on why.
    failed = Signal(object, str)
    #: `Found`.
    inspected = Signal(object)
    #: `RawPart` that was read for the present choice.
    read = Signal(object)
    #: Each `ImportChoice`, and its `Taken`.
    converted = Signal(object, object)
    #: Key of a series, and the least and largest of each stretch of it, (2, columns).
    surveyed = Signal(str, object)
    #: Samples read, and of how many.
    progressed = Signal(int, int)

    def __init__(self, path: Path, to_hz: float, parent: QObject | None = None) -> None:
        super().__init__("skinsource-import", parent)
        self._path, self._to_hz = path, to_hz
        self._process = ReadingProcess()
        self._found: Found | None = None
        self._raw: dict[object, RawPart] = {}

    def look(self) -> None:
        """Find out what the file holds."""
        self.run_newest(_PART, self._look, partial(self._receive, None))

    def take(self, choices: Choices) -> None:
        """Import signals in place of those before."""
        work = partial(self._import, choices)
        self.run_newest(_PART, work, partial(self._receive, choices))

    def survey(self, series: Series) -> None:
        """Compute the picture of a whole series once nothing else is to be done."""
        self.run_newest(_OVERVIEW, partial(self._read_overview, series), again=True)

    def end(self) -> None:
        """Stop reading, and the process that reads."""
        self.close()
        self._process.close()

    def _receive(self, choices: Choices | None, _: None, error: Exception | None) -> None:
        if error is not None and not isinstance(error, Stopped):
            self.failed.emit(choices, fault_text(error))

    def _look(self) -> None:
        self._found = self._process.look(self._path, stop=lambda: self.closed)
        self.tell(self.inspected.emit, self._found)

    def _import(self, choices: Choices) -> None:
        job = Job(f"Importing {self._path.name}", partial(self._take, choices))
        self.tell(self.converted.emit, choices, job.run(self._tell_progress, self._stop()))

    def _read_overview(self, series: Series) -> None:
        try:
            extremes = self._process.overview(
                self._path, series.key, series.n_samples, _COLUMNS, stop=self._should_wait
            )
        except SkinSourceError as error:
            if isinstance(error, Stopped):
                raise  # it is tried again later, unless the page is closed
            return  # the import of the part reports the error
        self.tell(self.surveyed.emit, series.key, extremes)

    def _should_wait(self) -> bool:
        return self.is_outdated(_PART) or self.is_outdated(_OVERVIEW)

    def _take(self, choices: Choices, *, progress: Progress, stop: Stop) -> tuple[Taken, ...]:
        if self._found is None:
            raise Stopped  # the file was not inspected yet
        wanted = {read_for(choice) for choice in choices}
        self._raw = {key: raw for key, raw in self._raw.items() if key in wanted}
        for choice in choices:
            if read_for(choice) not in self._raw:
                self._raw[read_for(choice)] = read_part(
                    self._path,
                    self._found,
                    choice,
                    process=self._process,
                    progress=progress,
                    stop=stop,
                )
        raw = [self._raw[read_for(choice)] for choice in choices]
        self.tell(self.read.emit, raw[0])
        stop_if(stop)
        together = len(choices) > 1 and choices[0].scale == "peak"
        if together:
            # Each by its own peak would lose how strong they are beside each other.
            choices = tuple(replace(choice, scale="keep") for choice in choices)
        parts = tuple(
            part.converted(choice, self._to_hz) for part, choice in zip(raw, choices, strict=True)
        )
        return at_common_peak(parts) if together else parts

    def _stop(self) -> Stop:
        until_s = monotonic() + _PATIENCE_S

        def stop() -> bool:
            return self.closed or (self.is_outdated(_PART) and monotonic() > until_s)

        return stop

    def _tell_progress(self, done: int, total: int, _: str) -> None:
        self.tell(self.progressed.emit, done, total)


_LEFT_PX = 300
_READING = "Reading…"
_ASSUMED = f"The file does not state its sample rate; {ASSUMED_RATE_HZ:g} Hz is assumed."


class ImportPage(ToolPage):
    """Shows what a file holds, asks what it leaves open, and shows what will be imported.

    Parameters
    ----------
    path
        The file.
    limb
        Limb of the design, with its rate and band.
    places
        Name and text of each place that the recording can go to, the likeliest one first.
    put_at
        Makes the edit that puts recordings at one of them, and those of the files that follow at
        the next, which says where that is.
    made
        Choices that were made for other files, as ``made`` of their forms has them.  A file of one
        of these shapes is imported with the same without asking, where that is possible; others
        begin with those of None.

    Attributes
    ----------
    same
        Whether the choices hold for further files; hidden where there are none.
    asks
        Whether the user is to see the page; else it shows itself once it has something to ask.
    """

    #: A `skinsource.design.waveforms.samples.Recording` for each signal; the name of the place.
    chosen = Signal(object, str)

    def __init__(
        self,
        path: Path,
        limb: LimbFacts,
        places: tuple[tuple[str, str], ...],
        put_at: Callable[[tuple[Recording, ...], str], Edit | Refusal],
        parent: QtWidgets.QWidget | None = None,
        made: Mapping[Shape | None, Made] | None = None,
    ) -> None:
        super().__init__(parent, "import_page", f"Import {path_text(Path(path.name))}", (820, 520))
        self._band_hz, self._made = limb.band_hz, made or {}
        self.asks = not any(self._made)
        hint = "Each file that is scaled gets a peak of 1"
        self.same = named(QtWidgets.QCheckBox(), "import_same", hint=hint)
        self.same.hide()
        self.form: ChoiceForm | None = None
        self._recordings: tuple[Recording, ...] = ()
        self._surveyed = ""
        self._about = page_label("import_about", _READING)
        self._warning = page_label("import_warning", _ASSUMED, tone="warning")
        self._place = ChoiceField(ChoiceSpec(label="Destination", options=places))
        self._put_at, self._where = put_at, page_label("import_where", tone="dim")
        self.preview, self._strip = ImportPreview(), OverviewStrip(MOST_PART_S)
        self._strip.hide()
        self._bar = progress_bar("import_progress", "Progress of reading", keeps_room=True)
        self._bar.setRange(0, 0)
        self._buttons = answers(self)
        self._import_button = self._buttons.button(Answer.Ok)
        self._import_button.setText("Import")
        self._import_button.setEnabled(False)
        self._place.setObjectName("import_place")
        self._warning.hide()
        left = QtWidgets.QWidget()
        left.setFixedWidth(_LEFT_PX)
        place = QtWidgets.QLabel("Destination"), self._place, self._where
        parts = self._about, self._warning, None, *place
        self._left = in_column(*parts, of=left, margins=0, gap_px=UNIT_PX)
        right = in_column(self._strip, (self.preview, 1), gap_px=UNIT_PX)
        columns = in_row(left, (right, 1), gap_px=2 * UNIT_PX)
        foot = in_row(self.same, (self._buttons, 1))
        in_column((columns, 1), self._bar, foot, of=self)
        self.preview.show_message(_READING)
        self._worker = ReadingWorker(path, limb.sample_rate_hz, self)
        worker = self._worker
        worker.inspected.connect(self._show_contents)
        worker.read.connect(self._show_read)
        worker.converted.connect(self._show_taken)
        worker.surveyed.connect(self._show_overview)
        worker.failed.connect(self._show_failed)
        worker.progressed.connect(self._show_progress)
        self._place.edited.connect(self._show_where)
        self._worker.look()

    @property
    def busy(self) -> bool:
        """Whether the latest choice is not shown yet."""
        return self._bar.isVisible()

    @property
    def ready(self) -> bool:
        """Whether the latest choice is shown and can be imported."""
        return self._import_button.isEnabled()

    def done(self, result: int) -> None:
        """Close the page, with or without a recording."""
        recordings, place = self._recordings, self._place.value
        self._worker.end()
        super().done(result)
        if result == QtWidgets.QDialog.DialogCode.Accepted and recordings:
            self.chosen.emit(recordings, place)

    def _show_contents(self, contents: Found) -> None:
        self._about.setText(about(contents))
        self.form = ChoiceForm(contents, self)
        self.form.repeat(self._made.get(self.form.shape, self._made.get(None, {})))
        self.form.changed.connect(self._import)
        self._left.insertWidget(2, self.form)
        self._strip.part_chosen.connect(self.form.take_part)
        self._import(self.form.choice)

    def _import(self, choice: ImportChoice) -> None:
        self._recordings = ()
        self._import_button.setEnabled(False)
        self._warning.setVisible(self.form is not None and self.form.assumes_rate)
        self.preview.set_pale(True)
        self._bar.show()
        self._bar.setRange(0, 0)
        self._worker.take((choice,) if self.form is None else self.form.choices)
        self._show_part(choice)

    def _show_part(self, choice: ImportChoice) -> None:
        form = self.form
        lasts_s = form.lasts_s if form is not None else None
        self._strip.setVisible(lasts_s is not None)
        if form is None or lasts_s is None:
            return
        self._strip.show_part(lasts_s, choice.start_s, choice.duration_s)
        if self._surveyed != choice.series:
            self._surveyed = choice.series
            self._strip.show_extremes(None)
            self._worker.survey(form.series)

    def _show_overview(self, key: str, extremes: Floats) -> None:
        if self.form is not None and key == self.form.choice.series:
            self._strip.show_extremes(extremes)

    def _show_read(self, raw: RawPart) -> None:
        if self.form is not None:
            self.form.show_missing(raw.n_missing)
            self._strip.show_landmarks(raw.landmarks_s)
            self.form.show_length(raw.lasts_s)
            self._show_part(self.form.choice)

    def _show_taken(self, choices: Choices, taken: tuple[Taken, ...]) -> None:
        if self.form is None or choices != self.form.choices:
            return
        self._recordings = tuple(part.waveform for part in taken)
        self._bar.hide()
        shown = [choice.series for choice in choices].index(self.form.series.key)
        self.preview.show_part(taken, shown, choices[shown], self._band_hz)
        self._import_button.setEnabled(True)
        self._import_button.setDefault(True)
        self._show_where()
        self._ask(self._made.get(self.form.shape))

    def _show_where(self, *_: object) -> None:
        """Say where the recordings will be; while they are read it is not known."""
        if self._recordings:
            edit = self._put_at(self._recordings, self._place.value)
            self._where.setText(edit.said if isinstance(edit, Edit) else edit.sentence)

    def _show_failed(self, choices: Choices | None, reason: str) -> None:
        if choices is None:
            self._about.setText("This file cannot be imported.")
        elif self.form is None or choices != self.form.choices:
            return
        self._bar.hide()
        self.preview.show_message(reason)
        self._ask(None)

    def _ask(self, made: Made | None) -> None:
        """Let the user decide, unless the first choices shown are those made for such a file."""
        asked, self.asks = self.asks, True
        if not asked:
            (self.accept if self.form and self.form.made == made else self.show)()

    def _show_progress(self, done: int, total: int) -> None:
        self._bar.setRange(0, 1000)
        self._bar.setValue(1000 * done // max(total, 1))


def about(contents: Found) -> str:
    """Return a few lines on the content of a file."""
    signals = contents.signals()
    signal = signals[0]
    rate_hz = contents.rate_of(signal)
    many = f"{len(signals)} signals" if len(signals) > 1 else "one signal"
    facts = [f"{contents.format}, {many} of {counted(signal.n_samples, 'sample')}"]
    if rate_hz is not None:
        facts.append(f"{rate_hz:g} Hz, {signal.n_samples / rate_hz:.4g} s")
    if signal.unit:
        facts.append(f"in {signal.unit}")
    # Numbers stay with their units.
    text = ", ".join(fact.replace(" Hz", "\u00a0Hz").replace(" s", "\u00a0s") for fact in facts)
    return text + "." + "".join(f"\n{note}" for note in contents.notes[:3])
