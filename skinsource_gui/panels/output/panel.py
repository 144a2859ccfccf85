"""The panel of all that lies between the design and the skin.

From the skin to the device: actuator, equaliser, whether predictions go through both, rig, device,
and the levels that are sent.  What is chosen here is exported and played.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from math import log10
from pathlib import Path
from typing import Any, ClassVar

from PySide6 import QtWidgets
from PySide6.QtCore import QObject, QSize, Qt, Signal

from skinsource.actuators.actuation import Actuation, ActuatorAt, load, names, profile
from skinsource.actuators.equalising import (
    PolePairReplacement,
    RegularisedInverse,
    followed_band,
    resonance_of,
)
from skinsource.base.conventions import Band
from skinsource.design import edits
from skinsource.design.amplitudes import amplitude_in_short, amplitude_unit, equaliser_of
from skinsource.design.design import Design, View
from skinsource.design.display_units import value_text
from skinsource.design.edits.edit import Edit
from skinsource.design.edits.setup import repair_for_actuators
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.engine.actuator_demand import Demand, actuator_at, listed_name, profile_of
from skinsource.lab.playing.devices import (
    LEAST_SHIFT_HZ,
    LONGEST_LATENCY_S,
    MOST_OUTPUTS,
    MOST_SHIFT_HZ,
    SHORTEST_LATENCY_S,
    Output,
)
from skinsource.lab.playing.stream import HIGHEST_DB, LOWEST_DB, START_DB
from skinsource.lab.playing.triggers import BITS
from skinsource.limbs.locations import input_name
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec, Spec, SwitchSpec
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.grid import FieldGrid, LabelledCell
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.fields.rig_field import RigField
from skinsource_gui.fields.units import minus
from skinsource_gui.panels.output.figures import (
    DemandView,
    OutputSettings,
    frequency_axis,
    response_curves,
)
from skinsource_gui.plots.signal_view import ResponseView
from skinsource_gui.qt.buttons import page_button, page_label, scrolled, show_or_hide, tool_button
from skinsource_gui.qt.fitting import fit_to_letters
from skinsource_gui.qt.labels import FittingLabel
from skinsource_gui.qt.layouts import Policy, in_column, in_row, named, show_tooltip
from skinsource_gui.qt.resources import choice_of, number_named
from skinsource_gui.qt.theme import UNIT_PX, set_tone, tabular
from skinsource_gui.state.panel import Panel
from skinsource_gui.state.playing import Played

_NUMBER_PX, _OUTPUT_NUMBER_PX, _METER_PX = 88, 56, 8
_SYSTEM = "System default"
_BETWEEN = "\n"
_DELAY = number_named("latency", minimum=SHORTEST_LATENCY_S, maximum=LONGEST_LATENCY_S)
_GAIN = NumberSpec(
    label="Gain",
    unit="dB",
    minimum=LOWEST_DB,
    maximum=HIGHEST_DB,
    step=1.0,
    hint=f"How strongly it is played; each session starts at {START_DB:g} dB",
)
_SHIFT = number_named("shift", minimum=LEAST_SHIFT_HZ, maximum=MOST_SHIFT_HZ)
_TRIGGER = number_named("trigger_output", minimum=0, maximum=MOST_OUTPUTS)
_CODE = number_named("trigger_code", minimum=0, maximum=2**BITS - 1)
_EARS = SwitchSpec(
    label="Audible preview",
    hint="Without actuators: all channels in stereo, with frequencies shifted up",
)
# By the fields of `Output`.
_OTHERS: tuple[tuple[str, Spec], ...] = (
    ("sample_rate_hz", ChoiceSpec(label="Sample rate", options=())),
    ("latency_s", _DELAY),
    ("stand_in", _EARS),
    ("shift_hz", _SHIFT),
    ("trigger_output", _TRIGGER),
    ("trigger_code", _CODE),
)


class DeviceFields(QObject):
    """Fields of rig, device and gain, and what is folded of them.

    Attributes
    ----------
    main, details
        The fields that are always in sight, and the others.
    """

    #: The chosen `Output`.
    output_requested = Signal(object)

    def __init__(self) -> None:
        super().__init__()
        self._output = Output()
        self._played: tuple[object, ...] = ()
        self.rig = RigField()
        self.edit_rig = tool_button(None, "edit_rig", "Edit…", "Places, outputs, volts and limits")
        self.device = ChoiceField(ChoiceSpec(label="Device", options=(("", _SYSTEM),)))
        self.device.edited.connect(self._choose_device)
        self.rescan = tool_button(
            None, "look_for_devices", "Refresh", "Look for new devices; this stops playback"
        )
        self.gain = NumberField(_GAIN, widest_unit=_GAIN.unit)
        fit_to_letters(self.gain, _NUMBER_PX)
        self.cells = {name: FieldCell(name, spec, edited=self._edit) for name, spec in _OTHERS}
        grid = FieldGrid()
        grid.show_cells(list(self.cells.values()))
        self.main = FieldGrid()
        # As high as its rows, in a low panel too.
        self.main.setSizePolicy(Policy.Preferred, Policy.Fixed)
        rig = _cell("Rig", self.rig, self.edit_rig)
        self.main.show_cells([rig, _cell("Device", self.device), _cell("Gain", self.gain)])
        self.details = QtWidgets.QWidget()
        in_column(grid, of=self.details, margins=0)

    def show_played(self, played: Played, rig_title: str | None) -> None:
        """Take over the chosen output, what can be chosen, and the rig of the design."""
        self.gain.set_value(played.gain_db)
        shown = played.output, played.devices, played.rates_hz, rig_title
        if shown == self._played:
            return
        self._played, self._output = shown, played.output
        devices = [(_key(each.name, each.host_api), each.title) for each in played.devices]
        _fill(self.device, [("", _SYSTEM), *devices], _key_of(played))
        rates = sorted({*played.rates_hz, played.output.sample_rate_hz})
        rate_options = [(str(rate), f"{rate:,} Hz".replace(",", " ")) for rate in rates]
        rate: Any = self.cells["sample_rate_hz"].field
        _fill(rate, rate_options, str(played.output.sample_rate_hz))
        self.rig.show_rig(rig_title)
        for name, _ in _OTHERS[1:]:
            self.cells[name].set_value(getattr(played.output, name))
        self.cells["shift_hz"].setEnabled(played.output.stand_in)
        self.cells["trigger_output"].setEnabled(not played.output.stand_in)
        triggers = played.output.trigger_output > 0 and not played.output.stand_in
        self.cells["trigger_code"].setEnabled(triggers)

    def _choose_device(self, key: str, _gesture: int | None) -> None:
        name, _, host_api = key.partition(_BETWEEN)
        self.output_requested.emit(replace(self._output, device=name, host_api=host_api))

    def _edit(self, name: str, value: Any, _gesture: int | None) -> None:
        whole = name in ("sample_rate_hz", "trigger_output", "trigger_code")
        changed: dict[str, Any] = {name: int(value) if whole else value}
        self.output_requested.emit(replace(self._output, **changed))


def _cell(title: str, field: QtWidgets.QWidget, *buttons: QtWidgets.QWidget) -> LabelledCell:
    """Return a field and perhaps a button; a list takes the room that is left."""
    cell, wide = LabelledCell(title), isinstance(field, ChoiceField)
    field.setObjectName(f"{title.lower()}_field")
    cell.label.setBuddy(field)
    cell.stack.addLayout(in_row((field, int(wide)), *buttons, *([] if wide else [None])))
    return cell


def _key(name: str, host_api: str) -> str:
    return f"{name}{_BETWEEN}{host_api}" if name else ""


def _key_of(played: Played) -> str:
    """Return the key of the chosen device; without a host API, of the first device of its name."""
    output = played.output
    for device in played.devices:
        if device.name == output.device and output.host_api in ("", device.host_api):
            return _key(device.name, device.host_api)
    return _key(output.device, output.host_api)


def _fill(field: ChoiceField, options: list[tuple[str, str]], chosen: str) -> None:
    """Offer other choices."""
    field.set_options(options)
    field.set_value(chosen)


_WIDEST_LEVEL = "\u2212100.0 dBFS"
_SILENT_DB = -200.0
# Ends of the bar of RMS, and the peak above which it is amber, dB of full scale.
_METER_DB, _NEAR_DB = (-60, 0), -3.0


class OutputRow:
    """One place of the design: its level, and unfolded the output that drives it and a test tone.

    Attributes
    ----------
    widgets
        From left to right.
    """

    def __init__(self, place: int, limb: str) -> None:
        names = input_name(place, limb)
        self.place = place
        title = FittingLabel()
        title.setSizePolicy(Policy.Preferred, Policy.Fixed)
        title.show_phrases((f"{place} · {names.name}", f"{place} · {names.short_name}", f"{place}"))
        title.setToolTip(names.name)
        self.meter, self.level = QtWidgets.QProgressBar(), QtWidgets.QLabel()
        self.meter.setRange(*_METER_DB)
        self.meter.setTextVisible(False)
        self.meter.setFixedHeight(_METER_PX)
        self.level.setFont(tabular(self.level.font()))
        self.level.setObjectName(f"level_of_{place}")
        spec = NumberSpec(
            label=f"Output of place {place}", minimum=1, maximum=MOST_OUTPUTS, whole=True
        )
        self.output = NumberField(spec, widest_unit="")
        hint = "Output of the device that its actuator is wired to"
        named(self.output, f"output_of_{place}", hint=hint)
        fit_to_letters(self.output, _OUTPUT_NUMBER_PX)
        self.tone = tool_button(None, f"tone_of_{place}", "Tone")
        self.widgets: tuple[QtWidgets.QWidget, ...] = (
            title,
            self.meter,
            self.level,
            self.output,
            self.tone,
        )

    def show_played(self, output: int, played: Played) -> None:
        """Show its output, how loud that is, and whether a tone can be played on it."""
        self.output.set_value(float(output))
        self.output.setEnabled(not played.output.stand_in and not played.rig_title)
        off = played.actuators == "off"
        self.tone.setEnabled(not off)
        self.tone.setAccessibleName(f"Test tone on output {output}, place {self.place}")
        tone = f"0.6 s of 100 Hz on output {output} alone, to find its actuator"
        show_tooltip(self.tone, "Arm the actuators first" if off else tone)
        levels, text = played.levels, ""
        rms_db = peak_db = _SILENT_DB
        if levels is not None and output <= levels.rms_db.size:
            rms_db, peak_db = float(levels.rms_db[output - 1]), float(levels.peak_db[output - 1])
            highest_db = float(levels.highest_db[output - 1])
            text = "silent" if highest_db <= _SILENT_DB else f"{highest_db:z.1f} dBFS"
        self.meter.setValue(round(max(rms_db, _METER_DB[0])))
        set_tone(self.meter, "warning" if peak_db > _NEAR_DB else "")
        self.level.setText(text.replace("-", "\u2212"))
        # Room for any level while there is one: otherwise rows would jump.
        room_px = self.level.fontMetrics().horizontalAdvance(_WIDEST_LEVEL) if levels else 0
        self.level.setMinimumWidth(room_px)


class OutputRows(QtWidgets.QWidget):
    """A row for each place of the design."""

    #: The `Output` with other outputs for places.
    output_requested = Signal(object)
    #: The output that is to play a tone.
    tone_requested = Signal(int)

    def __init__(self) -> None:
        super().__init__()
        self._played, self._limb, self._unfolded = Played(), "", False
        self.rows: list[OutputRow] = []
        self._table = QtWidgets.QGridLayout(self)
        self._table.setContentsMargins(0, 0, 0, 0)
        self._table.setColumnStretch(1, 1)
        self._table.setHorizontalSpacing(UNIT_PX)

    def show_limb(self, limb: str) -> None:
        """Name the places as a limb does."""
        if limb != self._limb:
            self._limb = limb
            self._make_rows()

    def unfold(self, unfolded: bool) -> None:
        """Show outputs and test tones as well, or levels alone."""
        self._unfolded = unfolded
        for row in self.rows:
            row.output.setVisible(unfolded)
            row.tone.setVisible(unfolded)

    def show_played(self, played: Played) -> None:
        """Take over what is played and how loud."""
        self._played, wired = played, dict(played.wired)
        if [row.place for row in self.rows] != list(wired):
            self._make_rows()
        for row in self.rows:
            row.show_played(wired[row.place], played)

    def _make_rows(self) -> None:
        for row in self.rows:
            for widget in row.widgets:
                self._table.removeWidget(widget)
                widget.deleteLater()
        self.rows = [OutputRow(place, self._limb) for place, _ in self._played.wired]
        for number, row in enumerate(self.rows):
            for column, widget in enumerate(row.widgets):
                self._table.addWidget(widget, number, column)
            row.output.edited.connect(partial(self._wire, row.place))
            row.tone.clicked.connect(partial(self._play_tone, row))
        self.unfold(self._unfolded)

    def _play_tone(self, row: OutputRow) -> None:
        self.tone_requested.emit(round(row.output.value_si))

    def _wire(self, place: int, output: float, _gesture: int | None) -> None:
        """Give a place an output; the place that had it gets the other's."""
        pairs = {**dict(self._played.output.outputs), **dict(self._played.wired)}
        number = round(output)
        other = next((mapped for mapped, taken in pairs.items() if taken == number), None)
        if other is not None:
            pairs[other] = pairs[place]
        pairs[place] = number
        outputs = tuple(sorted(pairs.items()))
        self.output_requested.emit(replace(self._played.output, outputs=outputs))


_NONE, _OWN = "none", "own"
#: Equalisers by the names of their classes.
EQUALISER = choice_of("equaliser")
#: Fields of equalisers; of a pole pair the rest follows from the actuator.
OF_EQUALISER = ("boost_db", "phase", "new_quality")


def with_equaliser(actuation: Actuation, kind: str) -> Actuation:
    """Return the same actuators with an equaliser of another kind."""
    if kind == PolePairReplacement.__name__:
        made = PolePairReplacement(*resonance_of(actuation.actuators[0].model))
        return replace(actuation, equaliser=made)
    inverse = kind == RegularisedInverse.__name__
    return replace(actuation, equaliser=RegularisedInverse() if inverse else None)


def with_actuator(actuation: Actuation | None, actuator: ActuatorAt) -> Actuation:
    """Return one actuator at all places, with the equaliser that was chosen before."""
    equaliser = RegularisedInverse() if actuation is None else actuation.equaliser
    if isinstance(equaliser, PolePairReplacement):
        # Its pole pair is that of one actuator.
        pair = resonance_of(actuator.model)
        equaliser = PolePairReplacement(*pair, equaliser.new_quality)
    return Actuation(actuators=(actuator,), equaliser=equaliser)


def _listed(actuation: Actuation | None) -> str | None:
    """Return the name of the only actuator; None where it is not listed, or there are several."""
    if actuation is None or len(actuation.actuators) > 1:
        return None
    return listed_name(actuation.actuators[0])


def fields_of(actuation: Actuation | None) -> dict[str, tuple[Spec, Any]]:
    """Return specification and value of each field of actuator and equaliser, by name."""
    name = _listed(actuation)
    value = name or (_NONE if actuation is None else _OWN)
    fields: dict[str, tuple[Spec, Any]] = {"actuator": (_actuator_spec(actuation, name), value)}
    if actuation is None:
        return fields
    equaliser, model = actuation.equaliser, actuation.actuators[0].model
    alone, options = len(actuation.actuators) == 1, EQUALISER.options
    kinds = EQUALISER if alone else replace(EQUALISER, options=(options[0], options[2]))
    fields["equaliser"] = kinds, type(equaliser).__name__
    for part in filter(None, (equaliser, model if alone else None)):
        for field, spec in specs_of(part).items():
            if isinstance(spec, NumberSpec | ChoiceSpec) and (
                part is model or field in OF_EQUALISER
            ):
                fields[field] = spec, getattr(part, field)
    return fields


def with_field(actuation: Actuation | None, name: str, value: Any) -> Actuation | None:
    """Return actuators and equaliser with another value of one of `fields_of`."""
    changed: dict[str, Any] = {name: value}
    if actuation is not None and fields_of(actuation)[name][1] == value:
        # To choose an equaliser again does not reset its boost.
        return actuation
    if name == "actuator":
        return None if value == _NONE else with_actuator(actuation, _at_all_places(value))
    if actuation is None:
        return None
    if name == "equaliser":
        return with_equaliser(actuation, value)
    if name in OF_EQUALISER and actuation.equaliser is not None:
        return replace(actuation, equaliser=replace(actuation.equaliser, **changed))
    (actuator,) = actuation.actuators
    model: Any = actuator.model
    return with_actuator(actuation, replace(actuator, model=replace(model, **changed)))


class ActuatorChoices(QObject):
    """Cells of actuator, equaliser and their parameters, as far as there are some.

    Attributes
    ----------
    actuator, equaliser, parameters
        The cell of each, and of their parameters.
    about, reset, open
        Where the parameters come from; gives them back; opens a measured response.
    """

    #: The new `Actuation` or None, number of the gesture or None.
    changed = Signal(object, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._actuation: Actuation | None = None
        self._cells: dict[str, FieldCell] = {}
        self._cached_cells: dict[tuple[str, Spec], FieldCell] = {}
        self.actuator, self.equaliser, self.parameters = (FieldGrid() for _ in range(3))
        self.about = page_label("actuator_about", tone="dim")
        self.about.setTextInteractionFlags(Qt.TextInteractionFlag.NoTextInteraction)
        self.reset = page_button(
            "actuator_reset", "As listed", "Reset all parameters to the listed values"
        )
        self.reset.clicked.connect(self._reset)
        self.open = page_button(
            "actuator_open",
            "Measured response…",
            "A table of frequency_hz, gain and phase, or a recorded sweep",
        )
        self.show_actuation(None)

    def cell(self, name: str) -> FieldCell:
        """Return the cell of a field of model or equaliser, ``"actuator"`` or ``"equaliser"``."""
        return self._cells[name]

    def show_actuation(self, actuation: Actuation | None) -> None:
        """Show what is chosen."""
        self._actuation = actuation
        fields = fields_of(actuation)
        specs = {name: spec for name, (spec, _) in fields.items()}
        text, changed = "No actuator is chosen.", False
        if actuation is not None:
            name, actuator = _listed(actuation), actuation.actuators[0]
            text = _about_text(actuator) if len(actuation.actuators) == 1 else ""
            changed = name is not None and load(name) != actuator.model
        for key in specs.items():
            if key not in self._cached_cells:
                self._cached_cells[key] = FieldCell(*key, edited=self._edit)
        cells = {field: self._cached_cells[field, spec] for field, spec in specs.items()}
        if cells != self._cells:
            self._cells = cells
            rows = list(cells.values())
            self.actuator.show_cells(rows[:1])
            self.equaliser.show_cells(rows[1:2])
            self.parameters.show_cells(rows[2:])
        for field, cell in cells.items():
            cell.set_value(fields[field][1])
        self.about.setText(text)
        self.reset.setVisible(changed)

    def _edit(self, name: str, value: Any, gesture: object) -> None:
        after = with_field(self._actuation, name, value)
        if after != self._actuation:
            self.changed.emit(after, gesture)

    def _reset(self) -> None:
        name = _listed(self._actuation)
        if name is not None:
            self.changed.emit(with_actuator(self._actuation, _at_all_places(name)), None)


def _at_all_places(name: str) -> ActuatorAt:
    return ActuatorAt(actuator=profile(name).title, model=load(name))


def _actuator_spec(actuation: Actuation | None, name: str | None) -> ChoiceSpec:
    own = () if actuation is None or name else ((_OWN, actuation.title),)
    listed = tuple((name, profile(name).title) for name in names())
    return ChoiceSpec(
        label="Actuator",
        options=((_NONE, "None"), *own, *listed),
        hint="Part of the design: what moves the skin at each place",
    )


def _about_text(actuator: ActuatorAt) -> str:
    shown, name = profile_of(actuator), listed_name(actuator)
    calibration, lines = shown.calibration, [shown.source]
    if calibration:
        lines.append(f"Calibration: {calibration[:1].lower()}{calibration[1:]}")
    before: Any = shown.model if name is None else load(name)
    changed = [
        f"{spec.label} {value_text(getattr(before, field), spec.unit, 4)} → "
        f"{value_text(getattr(shown.model, field), spec.unit, 4)}"
        for field, spec in specs_of(shown.model).items()
        if isinstance(spec, NumberSpec) and getattr(shown.model, field) != getattr(before, field)
    ]
    if changed:
        lines.append(f"Changed: {', '.join(changed)}.")
    return " ".join(lines)


_THROUGH = "Predict through the actuator"
_THROUGH_HINT = "Show all levels, maps and traces through this actuator"
_AS_FAR = ", as far as the equaliser reaches"
_NO_INPUTS = "No place is in use: click one on the hand."
_NOT_WIRED = "The rig wires no place that is in use."
_PLOT_PX = 190
_LEAST = QSize(240, 160)


class OutputPanel(Panel):
    """Actuator, equaliser, rig and device, and what is sent to the actuators.

    Figures and response are those of the place of the selected input.  Actuator, equaliser and rig
    belong to the design, the device to this machine.
    """

    title: ClassVar[str] = "Output"
    name: ClassVar[str] = "output"
    #: What is asked of the actuator, and of which: before any response.
    needs = frozenset({"actuator_demand", "actuator_looked_at"})
    reads_down = True

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._settings, self._played = OutputSettings(), Played()
        self._drawn: object = None
        self._place: int | None = None
        self.choices = ActuatorChoices(self)
        self.choices.changed.connect(self._choose)
        self.choices.open.clicked.connect(partial(self.action_requested.emit, "open_response"))
        self.through = named(QtWidgets.QCheckBox(_THROUGH), "actuator_through")
        self.through.clicked.connect(self._go_through)
        self.through_text = page_label("actuator_through_words", tone="dim")
        self.figures = DemandView()
        self.figures.mend.clicked.connect(self._mend)
        self.computed = (self.figures, self.figures.table)
        self.fields = DeviceFields()
        self.fields.edit_rig.clicked.connect(partial(self.action_requested.emit, "edit_rig"))
        self.rows = OutputRows()
        self.arm = page_button("arm_actuators", "Arm", "Show the peak and enable playback")
        self.arm.setCheckable(True)
        self.play = page_button("play_on_actuators", "Play", "Send the design to the actuators")
        self.play.clicked.connect(partial(self.action_requested.emit, "play_on_actuators"))
        self.stop = page_button("stop_actuators", "Stop", "Stop within 50 ms")
        self.stop.clicked.connect(partial(self.action_requested.emit, "play_on_actuators"))
        self.peak = page_label("output_peak")
        self.problem = page_label("output_problem", tone="error")
        self.text = page_label("output_words", tone="dim")
        for label in (self.problem, self.text):
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        more_hint = "Parameters, figures, response, sample rate, latency, test tones"
        self.more = tool_button(None, "output_more", "More", more_hint)
        self.more.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.more.clicked.connect(self._unfold)
        self.plot = ResponseView("actuator-plot", "Response of the actuator")
        self.plot.setMinimumHeight(_PLOT_PX)
        self.plot.exports.failed.connect(self.failed)
        self.plot.exports.written.connect(self.written)
        self._lay_out()
        self.setFocusProxy(self.choices.cell("actuator"))
        self._show_settings()
        self.show_played(self._played)

    def sizeHint(self) -> QSize:
        return QSize(440, 480)

    def minimumSizeHint(self) -> QSize:
        # Fields scroll down, never sideways.
        bar = self.style().pixelMetric(QtWidgets.QStyle.PixelMetric.PM_ScrollBarExtent)
        return QSize(self._content.minimumSizeHint().width() + bar, 0).expandedTo(_LEAST)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        self._settings = settings_of(view, self.name, OutputSettings)
        self.rows.show_limb(design.limb)
        if self.isVisible():
            self._show_settings()
            self.show_played(self._played)

    def show_results(self, results: Mapping[str, Any]) -> None:
        demand: Demand = results["actuator_demand"]
        self._place = demand.place
        self._show_settings()
        edit = self._mending() if demand.leaves_velocity else None
        self.figures.show_demand(
            demand,
            results["actuator_looked_at"],
            mend="" if edit is None else edit.label,
            limb=self._design.limb,
        )

    def show_problem(self, reason: str) -> None:
        self.figures.show_demand(Demand(place=None, refusal=reason), None)

    def show_folder(self, folder: Path) -> None:
        self.plot.exports.folder = self.fields.rig.folder = folder

    def show_played(self, played: Played) -> None:
        """Take over what is played and how loud; called while the panel is visible."""
        self._played = played
        show_or_hide(self.problem, played.missing or trigger_text(played))
        own = self._design.rig
        self.fields.show_played(played, None if own is None else own.title or "Rig")
        self.rows.show_played(played)
        self.arm.setChecked(played.actuators != "off")
        self.arm.setText({"off": "Arm"}.get(played.actuators, "Armed"))
        self.play.setEnabled(played.actuators == "armed")
        self.stop.setEnabled(played.on_actuators)
        self.peak.setText(peak_text(played))
        set_tone(self.peak, "warning" if played.peak is not None else "dim")
        self._show_text(played)

    def _lay_out(self) -> None:
        """Lay the parts out from the skin to the device; no row comes and goes above the switch."""
        self._details, choices = QtWidgets.QWidget(), self.choices
        in_column(
            choices.parameters,
            choices.about,
            in_row(choices.reset, choices.open, None),
            self.figures.table,
            self.plot,
            self.fields.details,
            of=self._details,
            margins=0,
            gap_px=UNIT_PX // 2,
        )
        parts = (
            choices.actuator,
            self.through,
            self.through_text,
            choices.equaliser,
            self.figures,
            self.fields.main,
            self.rows,
            in_row(self.arm, self.play, self.stop, None),
            self.peak,
            self.text,
            self.problem,
            in_row(self.fields.rescan, self.more, None),
            self._details,
            None,
        )
        self._content = QtWidgets.QWidget()
        margins = (UNIT_PX, UNIT_PX // 2, UNIT_PX // 2, UNIT_PX)
        in_column(*parts, of=self._content, margins=margins, gap_px=UNIT_PX // 2)
        in_column(scrolled(self._content, "output_scroll"), of=self, margins=0)

    def _show_settings(self) -> None:
        design, settings = self._design, self._settings
        actuation, band = design.actuation, _band_of(design.limb)
        drawn = actuation, settings, band, self._place
        if drawn == self._drawn:
            return
        self._drawn = drawn
        self.choices.show_actuation(actuation)
        self._show_through()
        self.more.setText("Less" if settings.more else "More")
        arrow = Qt.ArrowType.DownArrow if settings.more else Qt.ArrowType.RightArrow
        self.more.setArrowType(arrow)
        self._details.setVisible(settings.more)
        self.rows.unfold(settings.more)
        for part in (self.plot, self.figures.table):
            part.setVisible(actuation is not None)
        self._show_plot()

    def _show_plot(self) -> None:
        design = self._design
        if design.actuation is None or not self._settings.more:
            return
        band, actuator = _band_of(design.limb), actuator_at(design.actuation, self._place)
        name, model = listed_name(actuator), actuator.model
        before = None if name is None else load(name)
        curves = response_curves(model, before, design.actuation.equaliser, band)
        self.plot.show_over(frequency_axis(band), curves)

    def _show_through(self) -> None:
        design, actuated = self._design, self._design.actuated
        self.through.setChecked(actuated is not None)
        self.through.setEnabled(design.actuation is not None)
        self.through.setToolTip(_THROUGH_HINT if design.actuation else "Choose an actuator")
        inverted = actuated and isinstance(actuated.equaliser, RegularisedInverse)
        reach = _AS_FAR if inverted else ""
        meaning = f"{amplitude_unit(design)} {amplitude_in_short(design)}{reach}"
        self.through_text.setText(f"Amplitude 1 = 1 {meaning}.")
        self.through_text.setVisible(actuated is not None)

    def _show_text(self, played: Played) -> None:
        sentences = [] if played.wired else [_NOT_WIRED if played.rig_title else _NO_INPUTS]
        if played.rig_title and self._design.rig is None:
            sentences.append(f"The design has no rig; this machine plays for {played.rig_title}.")
        if played.output.stand_in:
            sentences.append(
                f"All frequencies sound {played.output.shift_hz:g} Hz higher than they are felt."
            )
        sentences.append(self._meaning(played))
        if played.delay is not None:
            sentences.append(f"{played.delay.text}.")
        if played.underruns:
            sentences.append(
                f"The device ran out of samples {played.underruns} times: choose a longer latency."
            )
        self.text.setText("\n".join(sentences))

    def _meaning(self, played: Played) -> str:
        """Return what a gain of 0 dB means, and whether it is calibrated."""
        design = self._design
        unit = "V" if equaliser_of(design) is not None else amplitude_unit(design)
        calibrated = played.rig_title and not played.output.stand_in
        meaning = f"an amplitude of 1{'' if unit == '×' else f' {unit}'} is full scale"
        if unit == "V":
            meaning = "1 V of the drive is sent as full scale"
            if calibrated:
                meaning = "the actuators get the volts of the design"
        calibration = "Uncalibrated: what reaches the skin depends on amplifier and actuator"
        if calibrated:
            calibration = f"{played.calibration[:1].upper()}{played.calibration[1:]}"
        return f"At a gain of 0 dB {meaning}. {calibration}."

    def _mending(self) -> Edit | None:
        """Return the edit that lets the actuator follow the selected input; None: there is none."""
        design, id = self._design, self._view.selected_input
        return None if id is None else repair_for_actuators(design, self._view, id)

    def _mend(self) -> None:
        edit = self._mending()
        if edit is not None:
            self.edited.emit(edit, None)

    def _go_through(self, on: bool) -> None:
        design = self._design
        if design.actuation is not None:
            through = replace(design.actuation, on=on)
            self.edited.emit(edits.predict_through(design, self._view, through), None)
            # After a refusal the box shows the state of the design again.
            self._show_through()

    def _choose(self, actuation: Actuation | None, gesture: int | None = None) -> None:
        outcome = edits.choose_actuation(self._design, self._view, actuation)
        self.edited.emit(outcome, gesture)
        # After a refusal the fields show the design again.
        self.choices.show_actuation(self._design.actuation)

    def _unfold(self) -> None:
        settings = OutputSettings(more=not self._settings.more)
        self.view_changed.emit(with_settings(self._view, self.name, settings))


def trigger_text(played: Played) -> str:
    """Return why the output of the trigger is none; "" where it can be."""
    number = 0 if played.output.stand_in else played.output.trigger_output
    place = next((place for place, output in played.wired if output == number), None)
    if place is None:
        return ""
    return (
        f"Output {number} drives place {place}, so it cannot be the trigger. Choose a free output "
        "for the trigger."
    )


def peak_text(played: Played) -> str:
    """Return the text on the largest sample that would be sent at the present gain."""
    peak = played.peak
    if peak is None:
        return "Actuators off: nothing is sent to them."
    factor = 10.0 ** (played.gain_db / 20.0)
    if peak.full_scale == 0.0:
        return f"Armed: silence on {peak.device}."
    level_db = 20.0 * log10(peak.full_scale * factor)
    volts = "" if peak.volts is None else f", {value_text(peak.volts * factor, 'V', 3)}"
    state = "Playing" if played.on_actuators else "Armed"
    return f"{state}: peak {minus(f'{level_db:z.1f}')} dBFS{volts}, on {peak.device}."


def _band_of(limb: str) -> Band:
    """Return the band in which drives are followed on a limb."""
    facts = facts_of(limb)
    return followed_band(facts.band_hz, facts.sample_rate_hz)
