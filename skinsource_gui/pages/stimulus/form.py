"""The form of the stimulus page: its fields, the order that they make, and what is remembered.

Rows that do not apply to the chosen format, rig or actuator are hidden.
"""

import json
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, cast

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QSignalBlocker, Qt, Signal

from skinsource.actuators.equalising import BOOST, NEW_QUALITY, PHASE
from skinsource.actuators.rigs import open_rig
from skinsource.base.conventions import SAMPLE_RATE_HZ
from skinsource.base.errors import InvalidInputError, SkinSourceError, counted, quoted
from skinsource.design import edits
from skinsource.design.amplitudes import ARBITRARY_UNIT, drive_unit, equaliser_of
from skinsource.design.design import Design, View, audible_inputs
from skinsource.engine.stimulus import LONGEST_LEAD_IN_S
from skinsource.export.formats import FORMATS, format_named
from skinsource.export.formats.format import StimulusFormat
from skinsource.export.stimulus_export.options import StimulusOptions
from skinsource.limbs.limb import PUBLISHED
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec, ValidationError
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.fields.rig_field import RigField
from skinsource_gui.panels.output.panel import EQUALISER, OF_EQUALISER, fields_of, with_field
from skinsource_gui.qt.buttons import page_label, tool_button
from skinsource_gui.qt.layouts import form_of, named, tooltip
from skinsource_gui.qt.resources import choice_of


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """One export of a stimulus.

    Attributes
    ----------
    format, rate_hz, options
        Format and options of the files, and their rate.
    """

    format: StimulusFormat
    rate_hz: int
    options: StimulusOptions


#: Rates that devices know; any other can be typed.
RATES_HZ = (round(SAMPLE_RATE_HZ), 2000, 8000, 44_100, 48_000, 96_000, 192_000)
OTHER = "other"

FORMAT = ChoiceSpec(
    label="Format",
    options=tuple((stimulus_format.name, stimulus_format.title) for stimulus_format in FORMATS),
    hint="Format of the file",
)
RATE = ChoiceSpec(
    label="Rate",
    options=(
        *((str(rate), f"{rate:,} Hz".replace(",", " ")) for rate in RATES_HZ),
        (OTHER, "Other…"),
    ),
    hint=f"At the limb's rate ({SAMPLE_RATE_HZ:g} Hz if published), samples are those predicted",
)
OTHER_RATE = NumberSpec(
    label="Other rate", unit="Hz", minimum=100, maximum=768_000, step=100, whole=True
)
CHANNELS = choice_of("channels")
LEAD_IN = NumberSpec(
    label="Lead-in",
    unit="s",
    minimum=0.0,
    maximum=LONGEST_LEAD_IN_S,
    step=0.05,
    hint="Silence before the stimulus, in which it may ring",
)
TAIL = replace(LEAD_IN, label="Tail", hint="Silence after the stimulus, in which it may ring")
SCALE = choice_of("full_scale")
#: Longest fade.
LONGEST_FADE_S = 10.0


def part_spec(design: Design, view: View) -> ChoiceSpec:
    """Return the choice of tracks and clips; where some are solo, of how many."""
    heard, tracks = len(audible_inputs(design.inputs)), counted(len(design.inputs), "track")
    solo = any(track.solo for track in design.inputs)
    options = [("all", f"{heard} of {tracks}: solo" if solo else "All unmuted")]
    if view.selected_inputs:
        options.append(("tracks", "Selected tracks"))
    if view.selected_clips:
        options.append(("clips", "Selected clips"))
    return ChoiceSpec(label="Tracks to write", options=tuple(options), hint="Without muted tracks")


def time_spec(design: Design) -> ChoiceSpec:
    """Return the choice of the part of the time."""
    options = [("whole", "Whole design")]
    if design.loop_s is not None:
        options.append(("loop", "Loop"))
    options.append(("part", "From … to …"))
    return ChoiceSpec(label="Time", options=tuple(options), hint="Part of the design to write")


def time_number(label: str, longest_s: float) -> NumberSpec:
    """Return the specification of a time of at most ``longest_s``."""
    return NumberSpec(label=label, unit="s", minimum=0.0, maximum=longest_s, step=0.005)


def scale_number(unit: str) -> NumberSpec:
    """Return the specification of a drive in its unit."""
    return NumberSpec(
        label="Drive at full scale",
        unit=unit if unit in ("V", "m/s²", ARBITRARY_UNIT) else "",
        minimum=0.001,
        maximum=1e6,
        step=0.1,
    )


#: Seed of dither; the sidecar names it.
_SEED = 1
_MAP_HINT = "Channel of each device output, in order: 2, 1, 0, 3; 0: silent"
_BOX_HINTS = {
    "sync": "Adds a channel with a full-scale pulse at time 0",
    "dither": "Adds noise of one step before rounding",
    "people": "Adds the levels to expect of other people to the sidecar",
    "advanced": "Channels, fades, lead-in, full scale, and more of the format",
}
#: Names of the rows; choices of a format follow what it is about.
_ROWS = (
    "format", "about", "rate", "other_rate", "plays", "actuator", "equaliser", "rig", "time",
    "from", "to", "advanced", *OF_EQUALISER, "channels", "map", "fade_in", "fade_out", "lead_in",
    "tail", "scale", "full_scale", "sync", "dither",
    "people",
)  # fmt: skip
#: Rows that fold away, as all choices of a format but the first do.
_ADVANCED = frozenset(_ROWS[_ROWS.index("advanced") + 1 :])
#: Rows that go on with the one before.
_CONTINUED = ("other_rate", "full_scale", "advanced")


class StimulusForm(QtWidgets.QWidget):
    """Fields for format, rate and options; rows that do not apply now are hidden.

    Parameters
    ----------
    design, view
        The design that is exported, and what is selected in it.
    """

    #: The `Order` that the fields make.
    changed = Signal(object)
    #: An `Edit` of what the design is made for, number of the gesture or None.
    edited = Signal(object, object)
    #: Why the fields make no order.
    refused = Signal(str)

    def __init__(self, design: Design, view: View) -> None:
        super().__init__()
        self._design, self._view = design, view
        self._about = page_label("stimulus_format_hint", tone="dim")
        self._choices: dict[str, ChoiceField] = {}
        #: Numbers that were typed; a silence that was not follows the equaliser.
        self.typed: set[str] = set()
        # Format of whose device the full scale is.
        self._scaled_for: StimulusFormat | None = None
        self._fields = {
            "format": ChoiceField(FORMAT),
            "rate": ChoiceField(RATE),
            "plays": ChoiceField(part_spec(design, view)),
            "channels": ChoiceField(CHANNELS),
            "time": ChoiceField(time_spec(design)),
            "scale": ChoiceField(SCALE),
        }
        longest_s = max((clip.end_s for clip in design.clips), default=1.0)
        self._numbers = {
            "other_rate": NumberField(OTHER_RATE),
            "from": NumberField(time_number("From", longest_s)),
            "to": NumberField(time_number("To", longest_s)),
            "fade_in": NumberField(time_number("Fade in", LONGEST_FADE_S)),
            "fade_out": NumberField(time_number("Fade out", LONGEST_FADE_S)),
            "lead_in": NumberField(LEAD_IN),
            "tail": NumberField(TAIL),
            "full_scale": NumberField(scale_number(drive_unit(design))),
        }
        for name, value in (("to", longest_s), ("other_rate", 48_000), ("full_scale", 1.0)):
            self._numbers[name].set_value(value)
        self._rig = RigField()
        # What the design is made for; the panel Output shows the same.
        self._output: dict[str, Any] = {
            "actuator": ChoiceField(cast("ChoiceSpec", fields_of(None)["actuator"][0])),
            "equaliser": ChoiceField(EQUALISER),
            "boost_db": NumberField(BOOST),
            "phase": ChoiceField(PHASE),
            "new_quality": NumberField(NEW_QUALITY),
        }
        self._map = QtWidgets.QLineEdit()
        named(self._map, title="Channel map", hint=tooltip("Channel map", _MAP_HINT))
        self._map.setPlaceholderText("in their order")
        self._boxes: dict[str, Any] = {
            "sync": QtWidgets.QCheckBox("Sync channel"),
            "dither": QtWidgets.QCheckBox("Dither"),
            "people": QtWidgets.QCheckBox("Range between people"),
            "advanced": tool_button(None, "", "Advanced", checkable=True),
        }
        self._boxes["advanced"].setAccessibleName("Advanced")
        self._boxes["advanced"].setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        for name, box in self._boxes.items():
            box.setToolTip(_BOX_HINTS[name])
        self._form = form_of(self)
        for name in _ROWS:
            widget = self._about if name == "about" else self.field(name)
            if widget is not self._about:
                widget.setObjectName(f"stimulus_{name}")
            self._form.addRow("" if name in _CONTINUED else widget.accessibleName(), widget)
        self._connect()
        self.show_format()
        self.show_design(design)

    @property
    def format(self) -> StimulusFormat:
        """The chosen format."""
        return format_named(self._fields["format"].value)

    def field(self, name: str) -> QtWidgets.QWidget:
        """Return the widget of a row."""
        rows: dict[str, QtWidgets.QWidget] = {"map": self._map, "rig": self._rig, **self._output}
        return {**rows, **self._fields, **self._numbers, **self._choices, **self._boxes}[name]

    def show_design(self, design: Design) -> None:
        """Show what a design is made for, and order it."""
        self._design, rig = design, design.rig
        self._fields["plays"].set_spec(part_spec(design, self._view))
        for name, (spec, value) in fields_of(design.actuation).items():
            if name in self._output:
                self._output[name].set_spec(spec)
                self._output[name].set_value(value)
        self._rig.show_rig(None if rig is None else rig.title or "Rig")
        self.emit_order()

    def show_silence(self, lead_in_s: float, tail_s: float) -> None:
        """Show how long the silences are that follow the equaliser."""
        for name, length_s in (("lead_in", lead_in_s), ("tail", tail_s)):
            if name not in self.typed:
                self._numbers[name].set_value(length_s)

    def choose_full_scale(self, drive: float) -> None:
        """Choose the drive at full scale, and show that field."""
        self._boxes["advanced"].setChecked(True)
        self._numbers["full_scale"].set_value(drive)
        self._scaled_for = self.format
        self._fields["scale"].choose("own")

    def emit_order(self) -> None:
        """Emit the order that the fields make, or why they make none."""
        self._show_rows()
        try:
            order = self._order()
        except SkinSourceError as error:
            self.refused.emit(str(error))
        else:
            self.changed.emit(order)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        # Qt would leave a text of several lines the height of fewer.
        self._form.invalidate()

    def _connect(self) -> None:
        for name, field in self._fields.items():
            if name == "format":
                field.edited.connect(self.show_format)
            else:
                field.edited.connect(self.emit_order)
        for name, number in self._numbers.items():
            number.edited.connect(lambda *_, name=name: self.typed.add(name))
            number.edited.connect(self.emit_order)
        self._rig.rig_chosen.connect(self._open_rig)
        for name, output in self._output.items():
            output.edited.connect(partial(self._choose, name))
        self._map.textChanged.connect(self.emit_order)
        for name, box in self._boxes.items():
            box.toggled.connect(self._show_rows if name == "advanced" else self.emit_order)

    def show_format(self) -> None:
        """Show the choices of the format, and its usual rate."""
        format = self.format
        for field in self._choices.values():
            self._form.removeRow(field)
        self._choices = {}
        position: Any = self._form.getWidgetPosition(self._about)
        for row, (name, spec) in enumerate(format.choices.items(), start=position[0] + 1):
            field = named(ChoiceField(spec), f"stimulus_choice_{name}")
            field.edited.connect(self.emit_order)
            self._form.insertRow(row, spec.label, field)
            self._choices[name] = field
        self._fields["rate"].set_value(str(format.rate_hz or RATES_HZ[0]))
        before: QtWidgets.QWidget = self._fields["format"]
        for field in self._choices.values():
            self.setTabOrder(before, field)
            before = field
        self.setTabOrder(before, self._fields["rate"])
        self._about.setText(f"{format.hint}.")
        self.emit_order()

    def _choose(self, name: str, value: Any, gesture: int | None) -> None:
        actuation = with_field(self._design.actuation, name, value)
        self.edited.emit(edits.choose_actuation(self._design, self._view, actuation), gesture)

    def _open_rig(self, path: Path | None) -> None:
        try:
            rig = None if path is None else open_rig(path)
        except SkinSourceError as error:
            self.refused.emit(str(error))
        else:
            self.edited.emit(edits.choose_rig(self._design, self._view, rig), None)

    def _show_rows(self) -> None:
        format, fields, design = self.format, self._fields, self._design
        chosen = fields_of(design.actuation) if drive_unit(design) in ("m/s²", "V") else {}
        own_part = fields["time"].value == "part"
        unit = drive_unit(design) if equaliser_of(design) is None else "V"
        full_scale, spec = self._numbers["full_scale"], scale_number(unit)
        # A full scale belongs to its unit, and that of a device to its format.
        if full_scale.spec.unit != spec.unit or self._scaled_for not in (None, format):
            fields["scale"].set_value("largest")
            self._scaled_for = None
        full_scale.set_spec(spec)
        visible = {
            "rate": not format.fixed_rate,
            "other_rate": not format.fixed_rate and fields["rate"].value == OTHER,
            "plays": fields["plays"].count() > 1 or any(track.solo for track in design.inputs),
            "map": fields["channels"].value != "files",
            "from": own_part,
            "to": own_part,
            **{name: name in chosen for name in self._output},
            "actuator": design.rig is None,
            "scale": not self._scale_is_known,
            "full_scale": self._own_scale,
            "dither": format.rounds(self.chosen),
            "people": design.limb in PUBLISHED,
        }
        unfolded = self._boxes["advanced"].isChecked()
        arrow = Qt.ArrowType.DownArrow if unfolded else Qt.ArrowType.RightArrow
        self._boxes["advanced"].setArrowType(arrow)
        folding = {*_ADVANCED, *list(self._choices)[1:]}
        for name in (*_ROWS, *self._choices):
            if name != "about":
                shown = visible.get(name, True) and (unfolded or name not in folding)
                self._form.setRowVisible(self.field(name), shown)

    @property
    def chosen(self) -> dict[str, str]:
        """The chosen options of the format, by their names."""
        return {name: field.value for name, field in self._choices.items()}

    def _order(self) -> Order:
        design, numbers = self._design, self._numbers
        chosen, format = self.chosen, self.format
        plays, channels = self._fields["plays"].value, self._fields["channels"].value
        rate, time = self._fields["rate"].value, self._fields["time"].value
        from_s: float | None = None
        to_s: float | None = None
        if time == "part":
            from_s, to_s = numbers["from"].value_si, numbers["to"].value_si
        elif time == "loop" and design.loop_s is not None:
            from_s, to_s = design.loop_s
        options = StimulusOptions(
            per="place" if channels == "place" else "input",
            one_file_per_input=channels == "files",
            inputs=self._view.selected_inputs if plays == "tracks" else None,
            clips=self._view.selected_clips if plays == "clips" else None,
            from_s=from_s,
            to_s=to_s,
            fade_in_s=numbers["fade_in"].value_si,
            fade_out_s=numbers["fade_out"].value_si,
            lead_in_s=self._silence("lead_in"),
            tail_s=self._silence("tail"),
            sync=self._boxes["sync"].isChecked(),
            channel_map=() if channels == "files" else channel_map_of(self._map.text()),
            full_scale=numbers["full_scale"].value_si if self._own_scale else None,
            dither_seed=(
                _SEED if format.rounds(chosen) and self._boxes["dither"].isChecked() else None
            ),
            people=design.limb in PUBLISHED and self._boxes["people"].isChecked(),
            choices=chosen,
        )
        return Order(
            format=format,
            rate_hz=round(numbers["other_rate"].value_si) if rate == OTHER else int(rate),
            options=options,
        )

    def _silence(self, name: str) -> float | None:
        return self._numbers[name].value_si if name in self.typed else None

    @property
    def _own_scale(self) -> bool:
        return not self._scale_is_known and self._fields["scale"].value == "own"

    @property
    def _scale_is_known(self) -> bool:
        """Whether the rig states what full scale is."""
        return equaliser_of(self._design) is not None and self._design.rig is not None


def channel_map_of(text: str) -> tuple[int, ...]:
    """Return the whole numbers in a text, with commas or spaces between.

    Raises
    ------
    InvalidInputError
        The text holds something else.
    """
    try:
        return tuple(int(number) for number in text.replace(",", " ").split())
    except ValueError:
        raise InvalidInputError(
            f"Channel map is {quoted(text)}, expected whole numbers such as 2, 1, 0, 3"
        ) from None


# Fields that are remembered; times, drives and channel maps belong to a design.
_LISTS = ("format", "rate", "channels")
_NUMBERS, _SILENCES = ("other_rate", "fade_in", "fade_out"), ("lead_in", "tail")
_BOXES = ("sync", "dither", "people", "advanced")
_MOST_CHARACTERS = 10_000


def remembered(form: StimulusForm) -> str:
    """Return the settings of ``form``, as JSON."""
    typed = [name for name in _SILENCES if name in form.typed]
    settings = {name: _value(form.field(name)) for name in (*_LISTS, *_NUMBERS, *typed, *_BOXES)}
    settings["choices"] = form.chosen
    return json.dumps(settings)


def recall(form: StimulusForm, text: str) -> None:
    """Restore the settings of ``form`` from `remembered`; unknown values are left out."""
    settings = _settings_in(text)
    if not settings:
        return
    # The format comes first: it decides which choices there are.
    _put(form.field("format"), settings.get("format"))
    form.show_format()
    choices = settings.get("choices")
    for name, value in choices.items() if isinstance(choices, dict) else ():
        if name in form.chosen:
            _put(form.field(name), value)
    silences = [name for name in _SILENCES if settings.get(name)]
    form.typed.update(silences)
    for name in (*_LISTS[1:], *_NUMBERS, *silences, *_BOXES):
        _put(form.field(name), settings.get(name))


def _settings_in(text: str) -> dict[str, Any]:
    """Return remembered settings; nothing where another version of the studio wrote them."""
    try:
        settings = json.loads(text[:_MOST_CHARACTERS]) if text else {}
    except (ValueError, RecursionError):
        return {}
    return settings if isinstance(settings, dict) else {}


def _value(widget: QtWidgets.QWidget) -> Any:
    if isinstance(widget, ChoiceField):
        return widget.value
    if isinstance(widget, NumberField):
        return widget.value_si
    return isinstance(widget, QtWidgets.QAbstractButton) and widget.isChecked()


def _put(widget: QtWidgets.QWidget, value: Any) -> None:
    with QSignalBlocker(widget):
        if isinstance(widget, ChoiceField):
            if isinstance(value, str) and widget.findData(value) >= 0:
                widget.set_value(value)
        elif isinstance(widget, NumberField):
            with suppress(ValidationError):
                widget.set_value(widget.spec.checked(value))
        elif isinstance(widget, QtWidgets.QAbstractButton) and isinstance(value, bool):
            widget.setChecked(value)
