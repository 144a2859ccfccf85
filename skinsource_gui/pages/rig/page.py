"""The page of rigs: a rig file is opened, edited channel by channel, measured, and saved.

To measure a channel, `MeasurePage` asks for the sensor and the sweep, measures in a thread, and
plots the response next to that of the actuator's model and the one that was measured before.
"""

import json
from collections.abc import Sequence
from dataclasses import asdict, replace
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from threading import Event
from typing import Any

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QSignalBlocker, Qt, Signal

from skinsource.actuators.actuation import names, profile, profile_of, shape_names
from skinsource.actuators.actuator import Actuator
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.measuring import open_response
from skinsource.actuators.prediction import Limits
from skinsource.actuators.rigs import SUFFIX, Rig, RigChannel, open_rig, save_rig
from skinsource.base.conventions import BAND_HZ, Floats
from skinsource.base.decibels import decibels
from skinsource.base.errors import InvalidInputError, SkinSourceError, Stopped, sentence
from skinsource.base.files import path_text
from skinsource.design import edits
from skinsource.lab.rig_measuring.duplex import InputDevice, input_devices
from skinsource.lab.rig_measuring.measurement import (
    ChannelMeasurement,
    MeasuringSetup,
    measurable,
    measure,
)
from skinsource.limbs.locations import input_name
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import NumberSpec, OptionalSpec
from skinsource.specs.spec import ChoiceSpec, Spec
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.grid import FieldGrid, discard
from skinsource_gui.fields.rig_field import RESPONSE_FILES
from skinsource_gui.fields.units import minus
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.plots.curves import CurveName, Curves
from skinsource_gui.plots.ranges import XAxis
from skinsource_gui.plots.signal_view import ResponseView
from skinsource_gui.qt.buttons import page_button, page_label, progress_bar, scrolled
from skinsource_gui.qt.layouts import in_column, in_row, named
from skinsource_gui.qt.questions import ask_open, ask_to_save
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.state.document import Document
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
        # At first it looks for devices, which ends playback and frees the sound card.
        self._running, self._looking = False, True
        self.measurement: ChannelMeasurement | None = None
        self.setup, self.grid = setup_of(settings.preferences.sensor_text), FieldGrid()
        specs = specs_of(self.setup).items()
        self.cells = {name: FieldCell(name, spec, edited=self._edit) for name, spec in specs}
        self.cells[_DEVICE] = self._devices(())
        self._show_cells()
        self.plot = ResponseView("measured-plot", "Measured response")
        self.plot.plot.show_message(_NOTHING)
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
        self.plot.exports.failed.connect(self.complain)
        self.plot.exports.written.connect(lambda path: self.say(f"Saved {path.name}."))
        self._progressed.connect(self._show_progress, Qt.ConnectionType.QueuedConnection)
        self._settings.changed.connect(self._list_inputs)
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
            self.complain(str(error))
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
            self.complain(str(error))

    def _start(self) -> None:
        setup, channel = self.setup, self._channel
        self._settings.preferences.sensor_text = setup_text(setup)
        self._stop.clear()
        self._running, self.measurement = True, None
        self.plot.plot.show_message("Measuring…")
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
            self.plot.plot.show_message(_NOTHING)
            if isinstance(error, Stopped):
                self.say("Stopped.")
            else:
                self.complain(str(error))
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


_LIMIT = "limit "
_FIELDS = (
    "place", "actuator", "device", "output", "full_scale_v", "amplifier_gain", "polarity",
    "delay_s", "measured_on",
)  # fmt: skip


class ChannelFields(QObject):
    """Cells for the fields of a channel and of its limits; 0 means that a value is not known.

    Attributes
    ----------
    widget
        Holds the cells, the text on the response, and its buttons.
    """

    #: The new `RigChannel`.
    edited = Signal(object)
    #: Why a value is not valid.
    refused = Signal(str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._channel: RigChannel | None = None
        specs = {name: spec for name, spec in specs_of(RigChannel).items() if name in _FIELDS}
        specs["actuator"] = _actuators()
        limits = {f"{_LIMIT}{name}": spec for name, spec in specs_of(Limits).items()}
        self.cells = {name: _cell(name, spec) for name, spec in {**specs, **limits}.items()}
        for cell in self.cells.values():
            cell.edited.connect(self._edit)
        self.measured = page_label("rig_measured")
        self.from_file = page_button(
            "rig_from_file",
            "Response from a file…",
            "Table of frequency_hz, gain and phase, or a recorded sweep",
        )
        self.measure = page_button(
            "rig_measure",
            "Measure…",
            "Play a sweep on this output and record an accelerometer",
        )
        self.forget = page_button("rig_forget", "Clear response", "Remove the measured response")
        self.widget = self._laid_out()

    def show_channel(self, channel: RigChannel | None) -> None:
        """Show the values of ``channel``; None: there is no channel."""
        self._channel = channel
        self.widget.setEnabled(channel is not None)
        # Without a channel, the cells show the defaults.
        channel = channel or RigChannel(place=1, output=1)
        for name, cell in self.cells.items():
            value = _value(channel, name)
            cell.set_value(0.0 if value is None else value)
        points = () if channel.measured is None else channel.measured.points
        self.measured.setText(
            f"Response: {len(points)} points, {points[0][0]:.4g} to {points[-1][0]:.4g} Hz"
            if points
            else "Response: not measured, so m/s² are not known"
        )
        self.forget.setEnabled(bool(points))

    def _laid_out(self) -> QtWidgets.QWidget:
        widget = QtWidgets.QWidget()
        own, limits = FieldGrid(), FieldGrid()
        own.show_cells([self.cells[name] for name in _FIELDS])
        limits.show_cells([cell for name, cell in self.cells.items() if name.startswith(_LIMIT)])
        heading = QtWidgets.QLabel("Actuator limits (0: unknown)")
        parts = (own, self.measured, self.measure, self.from_file, self.forget, heading, limits)
        in_column(*parts, None, of=widget, margins=(0, 0, UNIT_PX, 0))
        return widget

    def _edit(self, name: str, value: Any, _gesture: int | None) -> None:
        channel = self._channel
        if channel is None:
            return
        try:
            if name.startswith(_LIMIT):
                field = name.removeprefix(_LIMIT)
                limits = replace(channel.limits, **{field: value or None})
                after = replace(channel, limits=limits)
            else:
                optional = isinstance(specs_of(RigChannel)[name], OptionalSpec)
                changed: dict[str, Any] = {name: (value or None) if optional else value}
                after = replace(channel, **changed)
        except InvalidInputError as error:
            self.show_channel(channel)
            self.refused.emit(str(error))
            return
        if after != channel:
            self.edited.emit(after)


def title_of(channel: RigChannel, limb: str) -> str:
    """Return the text of a channel in a list; places have the names of the limb."""
    return f"{channel.place} · {input_name(channel.place, limb).name}, output {channel.output}"


def _cell(name: str, spec: Spec) -> FieldCell:
    if not isinstance(spec, OptionalSpec):
        return FieldCell(name, spec)
    inner = spec.of
    if isinstance(inner, NumberSpec):
        hint = f"{spec.hint}; 0: not known"
        inner = replace(inner, label=spec.label, minimum=0.0, logarithmic=False, hint=hint)
    return FieldCell(name, inner)


def _actuators() -> ChoiceSpec:
    listed = tuple((name, profile(name).title) for name in (*names(), *shape_names()))
    return ChoiceSpec(
        label="Actuator",
        options=(("", "Not listed"), *listed),
        hint="Limits and response from the library",
    )


def _value(channel: RigChannel, name: str) -> Any:
    if name.startswith(_LIMIT):
        return getattr(channel.limits, name.removeprefix(_LIMIT))
    return getattr(channel, name)


_KINDS = f"Rigs (*{SUFFIX});;All files (*)"
_NO_CHANNEL = "No channel yet: add one for each actuator."


class RigPage(ToolPage):
    """Opens, edits and saves a rig file, channel by channel; invalid changes are refused.

    Parameters
    ----------
    document
        Holds the design, which can be predicted through the rig.
    settings
        Playback settings, among them the rig of this machine.

    Attributes
    ----------
    rig, path
        The present rig, and the file that it was read from or written to; None: a new one.
    """

    def __init__(
        self,
        document: Document,
        settings: SoundSettings,
        parent: QtWidgets.QWidget,
    ) -> None:
        super().__init__(parent, "rig_page", "Rig", (860, 640))
        self._document, self._settings, self._thread = document, settings, sound_worker(self)
        settings.look_for_rig()
        self.rig = self._saved = settings.rig or Rig()
        self.path = settings.rig_path if settings.rig is not None else None
        self._title = named(QtWidgets.QLineEdit(), "rig_title", "Title")
        self._title.setPlaceholderText("Title of the rig")
        self.channels = named(QtWidgets.QListWidget(), "rig_channels", "Channels")
        self.fields = ChannelFields(self)
        self._use = named(QtWidgets.QCheckBox("Use for this design"), "rig_use")
        self._use.setChecked(True)
        add = self.add_button("rig_add", "Add channel", "", self._add)
        self._remove_button = self.add_button("rig_remove", "Remove channel", "", self._remove)
        buttons = in_row(add, self._remove_button)
        left = in_column(self._title, (self.channels, 1), buttons)
        scroll = scrolled(self.fields.widget, "rig_fields")
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        both = in_row((left, 2), (scroll, 3), gap_px=2 * UNIT_PX)
        ends = in_row(
            self._use,
            None,
            self.add_button("rig_open", "Open…", "", self._open),
            self.add_button("rig_save", "Save…", "", self._save),
            self.add_button("rig_close", "Close", "", self.reject),
        )
        in_column((both, 1), self.message, ends, of=self)
        self._title.textEdited.connect(self._entitle)
        self.channels.currentRowChanged.connect(self._show_channel)
        self.fields.edited.connect(
            lambda channel: self.take_channel(self.channels.currentRow(), channel)
        )
        self.fields.refused.connect(self.complain)
        self.fields.from_file.clicked.connect(self._ask_response)
        self.fields.measure.clicked.connect(self._measure)
        self.fields.forget.clicked.connect(partial(self._take_response, None))
        self._show(0)

    @property
    def unsaved(self) -> bool:
        """Whether there are changes that are in no file."""
        return self.rig != self._saved

    def done(self, result: int) -> None:
        """Close the page, after a question where changes are not saved."""
        if self._may_lose_changes():
            end_sound(self._thread)
            super().done(result)

    def take_channel(self, row: int, channel: RigChannel) -> None:
        """Replace the channel of a row."""
        channels = list(self.rig.channels)
        channels[row] = channel
        self._change(tuple(channels), row)

    def _show(self, row: int) -> None:
        """Show the rig, and one of its channels."""
        rig, channels = self.rig, self.rig.channels
        if self._title.text() != rig.title:
            self._title.setText(rig.title)
        with QSignalBlocker(self.channels):
            self.channels.clear()
            limb = self._document.design.limb
            self.channels.addItems([title_of(channel, limb) for channel in channels])
            self.channels.setCurrentRow(min(row, len(channels) - 1))
        self._show_channel(self.channels.currentRow())
        self._remove_button.setEnabled(bool(channels))
        changed = " (changed)" if self.unsaved else ""
        where = path_text(Path(self.path.name)) if self.path is not None else "not saved yet"
        self.say(f"The rig is {where}{changed}." if channels else _NO_CHANNEL)

    def _show_channel(self, row: int) -> None:
        self.fields.show_channel(self.rig.channels[row] if row >= 0 else None)

    def _change(self, channels: tuple[RigChannel, ...], after: int) -> None:
        """Set the channels and show row ``after``, or say why they are not valid."""
        try:
            self.rig = replace(self.rig, channels=channels)
        except InvalidInputError as error:
            self._show(self.channels.currentRow())
            self.complain(str(error))
        else:
            self._show(after)

    def _entitle(self, title: str) -> None:
        try:
            self.rig = replace(self.rig, title=title)
        except InvalidInputError as error:
            self.complain(str(error))

    def _add(self) -> None:
        """Add a channel for the next free place, of the design first, and the next free output."""
        channels, design = self.rig.channels, self._document.design
        last = channels[-1] if channels else RigChannel(place=1, output=1)
        wired = {channel.place for channel in channels}
        driven = (track.location for track in design.inputs)
        every = (*driven, *range(1, facts_of(design.limb).n_inputs + 1))
        place = next((place for place in every if place not in wired), None)
        if place is None:
            self.say("All places are wired already.")
            return
        outputs = {channel.output for channel in channels if channel.device == last.device}
        output = next(k for k in range(1, len(channels) + 2) if k not in outputs)
        # Most channels of a rig have the same settings, but each has its own response.
        new = replace(last, place=place, output=output, measured=None, measured_on="")
        self._change((*channels, new), len(channels))

    def _remove(self) -> None:
        row = self.channels.currentRow()
        left = tuple(channel for k, channel in enumerate(self.rig.channels) if k != row)
        self._change(left, max(row - 1, 0))

    def _ask_response(self) -> None:
        path = ask_open(self, "Response of the actuator", RESPONSE_FILES)
        if path is not None:
            self.say("Reading…")
            self._thread.run(partial(open_response, path), self._take_response)

    def _measure(self) -> None:
        """Open the page that measures this channel."""
        channel = self.rig.channels[self.channels.currentRow()]
        page = MeasurePage(channel, self._settings, self)
        page.measured.connect(lambda measurement: self._take_response(measurement.response))
        page.open()

    def _take_response(
        self, response: MeasuredResponse | None, error: Exception | None = None
    ) -> None:
        """Set the response of a channel as measured today; None: forget it."""
        row = self.channels.currentRow()
        if error is not None:
            self.complain(str(error))
        elif row >= 0:
            today = "" if response is None else datetime.now(UTC).date().isoformat()
            channel = replace(self.rig.channels[row], measured=response, measured_on=today)
            self.take_channel(row, channel)

    def _open(self) -> None:
        path = ask_open(self, "Open a rig", _KINDS) if self._may_lose_changes() else None
        if path is None:
            return
        try:
            self.rig = self._saved = open_rig(path)
        except SkinSourceError as error:
            self.complain(str(error))
            return
        self.path = path
        self._show(0)

    def _save(self) -> bool:
        """Ask for a file and write the rig; return whether that was done."""
        start = self.path or Path(f"{self.rig.title or 'rig'}{SUFFIX}")
        path = self.ask_save("Save the rig", _KINDS, start)
        if path is None:
            return False
        write = partial(save_rig, path, self.rig)
        if not self.save_as(path, write, self._settings.preferences):
            return False
        self.path, self._saved = path, self.rig
        if self._use.isChecked() and self._settings.choose_rig(path):
            design, view = self._document.design, self._document.view
            self._document.apply(edits.choose_rig(design, view, self.rig))
        self._show(self.channels.currentRow())
        self.say(f"Saved {path_text(Path(path.name))}.")
        return True

    def _may_lose_changes(self) -> bool:
        """Return whether there are none, or they are saved now, or the user gives them up."""
        question = "The changes of the rig are not saved. Save them?"
        return not self.unsaved or ask_to_save(self, "Changes of the rig", question, self._save)
