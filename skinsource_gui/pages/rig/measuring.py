"""The page on which the response of one channel of a rig is measured.

It asks for the sensor and the sweep, measures in a thread, and plots the response next to that of
the actuator's model and the one that was measured before.
"""

import json
from collections.abc import Sequence
from dataclasses import asdict, replace
from functools import partial
from threading import Event
from typing import Any

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import Qt, Signal

from skinsource.actuators.actuator import Actuator
from skinsource.actuators.catalog import profile_of
from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.base.arrays import Floats
from skinsource.base.decibels import decibels
from skinsource.base.errors import InvalidInputError, Stopped, sentence
from skinsource.base.measurement_conditions import BAND_HZ
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
from skinsource_gui.fields.grid import FieldGrid, discard
from skinsource_gui.fields.units import minus
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.plots.curves import CurveName, Curves
from skinsource_gui.plots.ranges import XAxis
from skinsource_gui.plots.signal_view import ResponseView
from skinsource_gui.qt.buttons import page_label, progress_bar
from skinsource_gui.qt.layouts import in_column, in_row
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.state.playing import SoundSettings, end_sound, sound_worker

_DEVICE = "input_device"
_SAME = ("", "Playback device, if it has inputs")


def setup_text(setup: MeasuringSetup) -> str:
    """Return a setup as JSON."""
    return json.dumps(asdict(setup))


def setup_of(text: str) -> MeasuringSetup:
    """Return the setup that `setup_text` wrote; the default one where it is not readable."""
    try:
        return MeasuringSetup(**json.loads(text))
    except (ValueError, TypeError, RecursionError):
        # Nothing was saved yet, or another version of the studio saved it.
        return MeasuringSetup()


_MEASURED = CurveName(number=1, short="Measured", full="Response of this measurement")
_MODEL = CurveName(number=2, short="Model", full="Model of the actuator in the library")
_BEFORE = CurveName(number=3, short="Before", full="Earlier response of the channel")


def model_of(channel: RigChannel) -> Actuator | None:
    """Return the model of the channel's actuator; None: there is no model."""
    known = profile_of(channel.actuator)
    model = channel.model if known is None or channel.model is not None else known.model
    return model if isinstance(model, Actuator) else None


def axis_of(measurement: ChannelMeasurement) -> XAxis:
    """Return the frequency axis of a measurement."""
    points = measurement.response.points
    return XAxis(
        titles=("Frequency (Hz)",),
        unit="Hz",
        column="frequency_hz",
        extent=(points[0][0], points[-1][0]),
        log=True,
        # An actuator belongs to no limb, so the band of the published limbs is shown.
        band=BAND_HZ,
    )


def measured_curves(measurement: ChannelMeasurement, channel: RigChannel) -> Curves:
    """Return gains at the measured frequencies: measured now, of the model, measured before."""
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
        level_text="dB re 1 m/s² per V",
        columns=tuple(f"{name.short.lower()}_db" for name, _ in rows),
    )


def model_difference_text(measurement: ChannelMeasurement, channel: RigChannel) -> tuple[str, ...]:
    """Return a sentence on the largest difference from the model; nothing without a model."""
    model = model_of(channel)
    if model is None:
        return ()
    hz = np.array([point[0] for point in measurement.response.points])
    difference_db = _db(measurement.response, hz) - _db(model, hz)
    worst = int(np.abs(difference_db).argmax())
    largest = minus(f"{difference_db[worst]:+z.1f} dB")
    return (f"It is at most {largest} from the model, at {hz[worst]:.3g} Hz.",)


def _db(model: Actuator, hz: Floats) -> Floats:
    return decibels(np.abs(model.response(hz)))


_NOTHING = "Nothing is measured yet"


_INTRODUCTION = (
    "Fix the accelerometer to the contactor, and wire it to an input of the sound card. After two "
    "seconds of silence a quiet sweep comes, then those that are measured."
)
_LOOKING = "Looking for devices…"
_START = "Play the sweeps, and record them"
_ARM = "Arm the actuators first"
_READY = "Start plays on output {output}, at the level above."


class MeasurePage(ToolPage):
    """Asks for the sensor, measures a channel, and emits the measurement where it is accepted.

    Parameters
    ----------
    channel
        The channel that is measured.
    settings
        Playback settings: the device where the channel names none, its rate and delay, and the
        sensor of the last measurement.

    Attributes
    ----------
    measurement
        The latest measurement; None: nothing was measured.
    """

    #: The `ChannelMeasurement` that was accepted.
    measured = Signal(object)
    _progressed = Signal(int, int, str)  # from the thread

    def __init__(
        self,
        channel: RigChannel,
        settings: SoundSettings,
        parent: QtWidgets.QWidget,
    ) -> None:
        super().__init__(parent, "measure_page", f"Measure place {channel.place}", (760, 640))
        self._channel, self._settings = channel, settings
        self._thread, self._stop = sound_worker(self), Event()
        self._running = self._looking = False
        self.measurement: ChannelMeasurement | None = None
        self.setup, self.grid = setup_of(settings.preferences.sensor_text), FieldGrid()
        specs = specs_of(self.setup).items()
        self.cells = {name: FieldCell(name, spec, edited=self._edit) for name, spec in specs}
        self.cells[_DEVICE] = self._devices(())
        self._show_cells()
        self.plot = ResponseView("measured-plot", "Measured response")
        self.plot.show_message(_NOTHING)
        self._bar = progress_bar("measure_progress", "Progress", keeps_room=True)
        self.arm = self.add_arm("measure_arm", self._show_armed)
        self.start = self.add_button("measure_start", "Start", _START, self._start)
        self.stop = self.add_button(
            "measure_stop", "Stop", "Stop at once; nothing is stored", self._stop.set
        )
        self.keep = self.add_button(
            "measure_keep", "Store", "Store the response in the channel, with the date", self._keep
        )
        self._close = self.add_button("measure_close", "Close", "Do not store it", self.reject)
        about = page_label("measure_about", _INTRODUCTION)
        foot = in_row(self.arm, self.start, self.stop, (self._bar, 1), self.keep, self._close)
        in_column(about, self.grid, (self.plot, 1), self.message, foot, of=self, gap_px=UNIT_PX)
        self.plot.exports.failed.connect(self.say)
        self.plot.exports.written.connect(self.say)
        self._progressed.connect(self._show_progress, Qt.ConnectionType.QueuedConnection)
        self._settings.changed.connect(self._list_inputs)
        # To look for devices ends playback and frees the sound card.
        self._looking = True
        self.say(self._missing or _LOOKING)
        self._settings.look()
        self._show_state()

    def done(self, result: int) -> None:
        """Stop playback, and close the page."""
        # Devices that are listed from now on do not concern this page.
        self._looking = False
        self._stop.set()
        end_sound(self._thread)
        super().done(result)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self._running:
            # The first press ends the measurement, the next one closes the page.
            self._stop.set()
        else:
            super().keyPressEvent(event)

    def _devices(self, devices: Sequence[InputDevice]) -> FieldCell:
        titles = dict.fromkeys(device.title for device in devices)
        if self.setup.input_device:
            # A chosen device that is not connected now may come back.
            titles.setdefault(self.setup.input_device)
        options = (_SAME, *((title, title) for title in titles))
        spec = ChoiceSpec(label="Input device", options=options)
        return FieldCell(_DEVICE, spec, edited=self._edit)

    def _show_cells(self) -> None:
        self.grid.show_cells(list(self.cells.values()))
        for name, cell in self.cells.items():
            cell.set_value(getattr(self.setup, name))

    def _edit(self, name: str, value: Any, _gesture: int | None) -> None:
        try:
            self.setup = replace(self.setup, **{name: value})
        except InvalidInputError as error:
            self.say(str(error))
            self.cells[name].set_value(getattr(self.setup, name))
        else:
            self._say_readiness()

    def _list_inputs(self) -> None:
        if self._looking and self._settings.searched:
            self._looking = False
            self._thread.run(input_devices, self._show_inputs)

    def _show_inputs(
        self, devices: tuple[InputDevice, ...] | None, error: Exception | None
    ) -> None:
        old, self.cells[_DEVICE] = self.cells[_DEVICE], self._devices(devices or ())
        self._show_cells()
        discard((old,), None)
        self._say_readiness()
        if error is not None and not self._missing:
            self.say(str(error))

    def _start(self) -> None:
        setup, channel = self.setup, self._channel
        self._settings.preferences.sensor_text = setup_text(setup)
        self._stop.clear()
        self._running, self.measurement = True, None
        self.plot.show_message("Measuring…")
        self.say("Two seconds of silence first.")
        self._show_state()
        work = partial(
            measure,
            Rig(channels=(channel,)),
            channel.place,
            setup,
            output=self._settings.output,
            progress=self._progressed.emit,
            stop=self._stop.is_set,
        )
        self._thread.run(work, self._take)

    def _take(self, measurement: ChannelMeasurement | None, error: Exception | None) -> None:
        self._running, self.measurement = False, measurement
        if measurement is not None:
            curves = measured_curves(measurement, self._channel)
            self.plot.show_over(axis_of(measurement), curves)
            self.say(
                " ".join((*measurement.lines, *model_difference_text(measurement, self._channel)))
            )
        else:
            self.plot.show_message(_NOTHING)
            self.say("Stopped." if isinstance(error, Stopped) else str(error))
        self._show_state()

    def _keep(self) -> None:
        if self.measurement is not None:
            self.measured.emit(self.measurement)
            self.accept()

    @property
    def _missing(self) -> str:
        """Why the channel cannot be measured with any device; or ""."""
        try:
            measurable(self._channel, self.setup, self._settings.output.sample_rate_hz)
        except InvalidInputError as error:
            return sentence(str(error))
        return ""

    def _say_readiness(self) -> None:
        """Say that the measurement can start, or why not; a text on a result stays."""
        if not self._looking and (self._missing or self.measurement is None):
            self.say(self._missing or _READY.format(output=self._channel.output))
        self._show_state()

    def _show_progress(self, done: int, total: int, text: str) -> None:
        if self._running:
            self._bar.setRange(0, total)
            self._bar.setValue(done)
            self.say(f"{text}…")

    def _show_armed(self, armed: bool) -> None:
        if not armed:
            self._stop.set()
        self._show_state()

    def _show_state(self) -> None:
        self.grid.setEnabled(not self._running)
        ready = self.arm.isChecked() and not (self._running or self._looking)
        self.start.setEnabled(ready and not self._missing)
        self.start.setToolTip(self._missing or (_START if self.arm.isChecked() else _ARM))
        self.stop.setEnabled(self._running)
        self.keep.setEnabled(self.measurement is not None)
        self._bar.setVisible(self._running)

    def say(self, text: str) -> None:
        super().say(text if text.endswith(("…", ".")) else sentence(text))
