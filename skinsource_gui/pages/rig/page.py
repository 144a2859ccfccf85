"""The page of rigs: a rig file is opened, edited channel by channel, and saved."""

from dataclasses import replace
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Any

from PySide6 import QtWidgets
from PySide6.QtCore import QObject, QSignalBlocker, Qt, Signal

from skinsource.actuators.catalog import names, profile, shape_names
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.measuring import open_response
from skinsource.actuators.prediction import Limits
from skinsource.actuators.rigs import SUFFIX, Rig, RigChannel, open_rig, save_rig
from skinsource.base.errors import InvalidInputError, SkinSourceError, sentence
from skinsource.base.files import path_text
from skinsource.design import edits
from skinsource.limbs.locations import input_name
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import NumberSpec, OptionalSpec
from skinsource.specs.spec import ChoiceSpec, Spec
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.grid import FieldGrid
from skinsource_gui.fields.rig_field import RESPONSE_FILES
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.pages.rig.measuring import MeasurePage
from skinsource_gui.qt.buttons import page_button, page_label, scrolled
from skinsource_gui.qt.layouts import in_column, in_row, named
from skinsource_gui.qt.questions import ask_open, ask_to_save
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.state.document import Document
from skinsource_gui.state.playing import SoundSettings, end_sound, sound_worker

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
_NOTHING = "No channel yet: add one for each actuator."


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
        self.fields.refused.connect(self.say)
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

    def say(self, text: str) -> None:
        super().say(sentence(text))

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
        self.say(f"The rig is {where}{changed}" if channels else _NOTHING)

    def _show_channel(self, row: int) -> None:
        self.fields.show_channel(self.rig.channels[row] if row >= 0 else None)

    def _change(self, channels: tuple[RigChannel, ...], after: int) -> None:
        """Set the channels and show row ``after``, or say why they are not valid."""
        try:
            self.rig = replace(self.rig, channels=channels)
        except InvalidInputError as error:
            self._show(self.channels.currentRow())
            self.say(str(error))
        else:
            self._show(after)

    def _entitle(self, title: str) -> None:
        try:
            self.rig = replace(self.rig, title=title)
        except InvalidInputError as error:
            self.say(str(error))

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
            self.say(str(error))
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
            self.say(str(error))
            return
        self.path = path
        self._show(0)

    def _save(self) -> None:
        start = self.path or Path(f"{self.rig.title or 'rig'}{SUFFIX}")
        path = self.ask_save("Save the rig", _KINDS, start)
        if path is None:
            return
        if not path.suffix:
            path = path.with_name(f"{path.name}{SUFFIX}")
        try:
            save_rig(path, self.rig)
        except SkinSourceError as error:
            self.say(str(error))
            return
        self.path, self._saved = path, self.rig
        if self._use.isChecked() and self._settings.choose_rig(path):
            design, view = self._document.design, self._document.view
            self._document.apply(edits.choose_rig(design, view, self.rig))
        self._show(self.channels.currentRow())
        self.say(f"Saved {path_text(Path(path.name))}")

    def _may_lose_changes(self) -> bool:
        """Return whether there are none, or they are saved now, or the user gives them up."""

        def save() -> bool:
            self._save()
            return not self.unsaved

        question = "The changes of the rig are not saved. Save them?"
        return not self.unsaved or ask_to_save(self, "Changes of the rig", question, save)
