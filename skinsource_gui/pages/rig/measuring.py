"""The fields of a measurement: the sensor, where it is wired, and the sweep."""

import json
from collections.abc import Sequence
from dataclasses import asdict, replace
from functools import partial
from threading import Event
from typing import Any

import numpy as np
from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QDialog, QHBoxLayout, QLabel, QProgressBar, QVBoxLayout, QWidget

from skinsource.actuators.actuator import Actuator
from skinsource.actuators.catalog import names, profile
from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.base.arrays import Floats
from skinsource.base.decibels import decibels
from skinsource.base.errors import InvalidInputError, SkinSourceError, Stopped
from skinsource.base.published import BAND_HZ
from skinsource.base.quoting import sentence
from skinsource.lab.rig_measuring.duplex import InputDevice, input_devices
from skinsource.lab.rig_measuring.measurement import (
    ChannelMeasurement,
    MeasuringSetup,
    measurable,
    measure,
)
from skinsource.specs.models import specs_of
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.grid import FieldGrid
from skinsource_gui.fields.units import minus
from skinsource_gui.plots.curves import CurveName, Curves
from skinsource_gui.plots.ranges import XAxis
from skinsource_gui.plots.signal_view import SignalView
from skinsource_gui.qt.buttons import page_button
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.state.playing import SoundSettings, SoundThread

_DEVICE = "input_device"
_SAME = ("", "The one played on, if it has inputs")


class MeasureFields(QObject):
    """Cells for a `MeasuringSetup`.

    Attributes
    ----------
    grid
        Where they stand.
    setup
        What they say.
    """

    #: Why a value was not taken.
    refused = Signal(str)
    #: `setup` is another one.
    changed = Signal()

    def __init__(self, setup: MeasuringSetup, parent: QObject) -> None:
        super().__init__(parent)
        self.setup = setup
        self.grid = FieldGrid()
        self._cells = {name: self._cell(name, spec) for name, spec in specs_of(setup).items()}
        self._cells[_DEVICE] = self._devices(())
        self._show()

    def cell(self, name: str) -> FieldCell:
        """The cell of a field."""
        return self._cells[name]

    def show_inputs(self, devices: Sequence[InputDevice]) -> None:
        """Offer these devices to record from."""
        old = self._cells[_DEVICE]
        self._cells[_DEVICE] = self._devices(devices)
        self._show()
        old.label.deleteLater()
        old.deleteLater()

    def _cell(self, name: str, spec: Any) -> FieldCell:
        cell = FieldCell(name, spec)
        cell.edited.connect(self._edit)
        return cell

    def _devices(self, devices: Sequence[InputDevice]) -> FieldCell:
        titles = dict.fromkeys(device.title for device in devices)
        chosen = self.setup.input_device
        if chosen:
            # One that is not there now may come back.
            titles.setdefault(chosen)
        options = (_SAME, *((title, title) for title in titles))
        return self._cell(_DEVICE, ChoiceSpec(label="Input device", options=options))

    def _show(self) -> None:
        self.grid.show_cells(list(self._cells.values()))
        for name, cell in self._cells.items():
            cell.set_value(getattr(self.setup, name))

    def _edit(self, name: str, value: Any, _gesture: int | None) -> None:
        try:
            self.setup = replace(self.setup, **{name: value})
        except InvalidInputError as error:
            self.refused.emit(str(error))
            self._cells[name].set_value(getattr(self.setup, name))
        else:
            self.changed.emit()


def setup_text(setup: MeasuringSetup) -> str:
    """Write down what was said of the sensor and the sweep."""
    return json.dumps(asdict(setup))


def setup_of(text: str) -> MeasuringSetup:
    """Read what `setup_text` wrote; the usual one where that is something else."""
    try:
        return MeasuringSetup(**json.loads(text))
    except (ValueError, TypeError, RecursionError):
        # Nothing is kept yet, or by another version of the studio.
        return MeasuringSetup()


# What was measured of an actuator, beside what is known of it.

_MEASURED = CurveName(number=1, short="Measured", full="What was measured now")
_MODEL = CurveName(number=2, short="Model", full="What the library knows of the actuator")
_BEFORE = CurveName(number=3, short="Before", full="What the channel has from before")


def model_of(channel: RigChannel) -> Actuator | None:
    """How the channel moves as far as a model says; None: there is none."""
    if channel.model is not None:
        return channel.model
    if channel.actuator in names():
        model = profile(channel.actuator).model
        return model if isinstance(model, Actuator) else None
    return None


def axis_of(measurement: ChannelMeasurement) -> XAxis:
    """Frequencies of the measurement."""
    points = measurement.response.points
    return XAxis(
        titles=("Frequency (Hz)",),
        unit="Hz",
        column="frequency_hz",
        extent=(points[0][0], points[-1][0]),
        log=True,
        # An actuator belongs to no limb: shown is where most know how skin answers.
        band=BAND_HZ,
    )


def measured_curves(measurement: ChannelMeasurement, channel: RigChannel) -> Curves:
    """Gains at the points that were measured: measured, of the model, and of the time before."""
    hz = np.array([point[0] for point in measurement.response.points])
    rows: list[tuple[CurveName, Floats]] = [(_MEASURED, _db(measurement.response, hz))]
    model = model_of(channel)
    if model is not None:
        rows.append((_MODEL, _db(model, hz)))
    if channel.measured is not None and channel.measured != measurement.response:
        rows.append((_BEFORE, _db(channel.measured, hz)))
    return Curves(
        x=hz,
        y=np.stack([values for _, values in rows]),
        names=tuple(name for name, _ in rows),
        kind="level",
        level_words="dB re 1 m/s² per V",
        columns=tuple(f"{name.short.lower()}_db" for name, _ in rows),
    )


def model_difference_text(measurement: ChannelMeasurement, channel: RigChannel) -> tuple[str, ...]:
    """How far the gain is from that of the model, as a sentence; nothing without a model."""
    model = model_of(channel)
    if model is None:
        return ()
    hz = np.array([point[0] for point in measurement.response.points])
    apart_db = _db(measurement.response, hz) - _db(model, hz)
    worst = int(np.abs(apart_db).argmax())
    away = minus(f"{apart_db[worst]:+z.1f} dB")
    return (f"It is at most {away} from the model, at {hz[worst]:.3g} Hz.",)


def _db(model: Actuator, hz: Floats) -> Floats:
    return decibels(np.abs(model.response(hz)))


# The plot of what was measured.

_NOTHING = "Nothing is measured yet"


class MeasuredView(SignalView):
    """Gain over frequency: what was measured, what the model says, and what there was before."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("measured-plot", "Measured response", parent)
        self._found: ChannelMeasurement | None = None
        self._zoom: tuple[float, float] | None = None
        self._layout = "overlaid"
        self.zoom_requested.connect(self._show_part)
        self.toolbar.layout_chosen.connect(self._lay_curves)
        self.show_measured(None, None)

    def show_measured(
        self,
        measurement: ChannelMeasurement | None,
        channel: RigChannel | None,
        words: str = _NOTHING,
    ) -> None:
        """Draw what was found of a channel; None: say why there is nothing."""
        self._found, self._zoom = measurement, None
        self._show_view()
        if measurement is None or channel is None:
            self.show_message(words)
        else:
            self.show_curves(measured_curves(measurement, channel), synthetic=False)

    def _show_part(self, zoom: tuple[float, float] | None) -> None:
        self._zoom = zoom
        self._show_view()

    def _lay_curves(self, layout: str) -> None:
        self._layout = layout
        self._show_view()

    def _show_view(self) -> None:
        self.toolbar.show_state(layout=self._layout, zoomed=self._zoom is not None)
        if self._found is not None:
            self.set_view(axis_of(self._found), self._zoom, stacked=self._layout == "stacked")


# The page on which one channel of a rig is measured.

_INTRODUCTION = (
    "Fix the accelerometer to the contactor, and wire it to an input of the sound card. After two "
    "seconds of silence a quiet sweep comes, then those that are measured."
)
_LOOKING = "Looking for devices…"
_START = "Play the sweeps, and record them"
_READY = "Start plays on output {output}, at the level above."


class MeasurePage(QDialog):
    """Asks for the sensor, measures, shows what was found, and hands it on where it is kept.

    Parameters
    ----------
    channel
        What is measured.
    settings
        Of playing: the device where the channel names none, its rate and delay; and what was said
        of the sensor last.

    Attributes
    ----------
    fields, plot, words
        Its parts.
    found
        What was measured last; None: nothing was.
    """

    #: The `ChannelMeasurement` that shall be kept.
    kept = Signal(object)
    _told = Signal(int, int, str)  # from the thread

    def __init__(
        self,
        channel: RigChannel,
        settings: SoundSettings,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setObjectName("measure_page")
        self.setWindowTitle(f"Measure place {channel.place}")
        self.resize(760, 640)
        self._channel, self._settings = channel, settings
        self._thread, self._stop = SoundThread(self), Event()
        self._running = self._looking = False
        self.found: ChannelMeasurement | None = None
        self.fields = MeasureFields(setup_of(settings.sensor_text), self)
        self.plot = MeasuredView()
        self.words, self._bar = QLabel(), QProgressBar()
        self.words.setObjectName("measure_words")
        self.words.setWordWrap(True)
        self.words.setTextFormat(Qt.TextFormat.PlainText)
        self.start = page_button("measure_start", "Start", _START)
        self.stop = page_button("measure_stop", "Stop", "Silence at once; nothing is kept")
        self.keep = page_button("measure_keep", "Keep", "Put it into the channel, with the date")
        self._close = page_button("measure_close", "Close", "Without keeping it")
        self._lay_out()
        self._connect()
        self._look()

    def done(self, result: int) -> None:
        """Fall silent, and close."""
        # Devices that are found from now on are nobody's business here.
        self._looking = False
        self._stop.set()
        self._thread.end(lambda: None)
        super().done(result)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self._running:
            # What is heard ends first; pressed again, the page closes.
            self._stop.set()
        else:
            super().keyPressEvent(event)

    def _lay_out(self) -> None:
        about = QLabel(_INTRODUCTION)
        about.setWordWrap(True)
        self._bar.setTextVisible(False)
        kept = self._bar.sizePolicy()
        kept.setRetainSizeWhenHidden(True)
        self._bar.setSizePolicy(kept)
        self._bar.setAccessibleName("Progress")
        foot = QHBoxLayout()
        for button in (self.start, self.stop):
            foot.addWidget(button)
        foot.addWidget(self._bar, 1)
        for button in (self.keep, self._close):
            foot.addWidget(button)
        whole = QVBoxLayout(self)
        whole.setSpacing(UNIT_PX)
        whole.addWidget(about)
        whole.addWidget(self.fields.grid)
        whole.addWidget(self.plot, 1)
        whole.addWidget(self.words)
        whole.addLayout(foot)

    def _connect(self) -> None:
        self.start.clicked.connect(self._start)
        self.stop.clicked.connect(self._stop.set)
        self.keep.clicked.connect(self._keep)
        self._close.clicked.connect(self.reject)
        self.fields.refused.connect(self._say)
        self.fields.changed.connect(self._say_whether)
        self.plot.exports.failed.connect(self._say)
        self.plot.exports.written.connect(self._say)
        self._told.connect(self._show_progress, Qt.ConnectionType.QueuedConnection)
        self._settings.changed.connect(self._list_inputs)

    def _look(self) -> None:
        """Look for devices: what is played ends, and the sound card is free."""
        self._looking = True
        self._say(self._missing or _LOOKING)
        self._settings.look()
        self._show_state()

    def _list_inputs(self) -> None:
        if self._looking and self._settings.looked:
            self._looking = False
            self._thread.do(input_devices, self._show_inputs)

    def _show_inputs(
        self, devices: tuple[InputDevice, ...] | None, error: SkinSourceError | None
    ) -> None:
        self.fields.show_inputs(devices or ())
        self._say_whether()
        if error is not None and not self._missing:
            self._say(str(error))

    def _start(self) -> None:
        setup, channel = self.fields.setup, self._channel
        self._settings.sensor_text = setup_text(setup)
        self._stop.clear()
        self._running, self.found = True, None
        self.plot.show_measured(None, None, "Measuring…")
        self._say("Two seconds of silence first.")
        self._show_state()
        work = partial(
            measure,
            Rig(channels=(channel,)),
            channel.place,
            setup,
            output=self._settings.output,
            progress=self._told.emit,
            stop=self._stop.is_set,
        )
        self._thread.do(work, self._take)

    def _take(self, measurement: ChannelMeasurement | None, error: SkinSourceError | None) -> None:
        self._running, self.found = False, measurement
        self.plot.show_measured(measurement, self._channel)
        if measurement is not None:
            self._say(
                " ".join((*measurement.lines, *model_difference_text(measurement, self._channel)))
            )
        else:
            self._say("Stopped." if isinstance(error, Stopped) else str(error))
        self._show_state()

    def _keep(self) -> None:
        if self.found is not None:
            self.kept.emit(self.found)
            self.accept()

    @property
    def _missing(self) -> str:
        """Why it cannot be measured, whatever devices there are; or ""."""
        try:
            measurable(self._channel, self.fields.setup, self._settings.output.sample_rate_hz)
        except InvalidInputError as error:
            return sentence(str(error))
        return ""

    def _say_whether(self) -> None:
        """Say that it can begin, or why it cannot; what was measured stays said."""
        if not self._looking and (self._missing or self.found is None):
            self._say(self._missing or _READY.format(output=self._channel.output))
        self._show_state()

    def _show_progress(self, done: int, total: int, words: str) -> None:
        if self._running:
            self._bar.setRange(0, total)
            self._bar.setValue(done)
            self._say(f"{words}…")

    def _show_state(self) -> None:
        self.fields.grid.setEnabled(not self._running)
        self.start.setEnabled(not (self._running or self._looking or self._missing))
        self.start.setToolTip(self._missing or _START)
        self.stop.setEnabled(self._running)
        self.keep.setEnabled(self.found is not None)
        self._bar.setVisible(self._running)

    def _say(self, words: str) -> None:
        self.words.setText(words if words.endswith(("…", ".")) else sentence(words))
