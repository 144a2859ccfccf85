"""The panel that leads through the calibration of a person, in three steps."""

import tomllib
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import Any, ClassVar, cast

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import Signal

from skinsource.lab.calibrating import Sitting
from skinsource.lab.rig_measuring.measurement import MeasuringSetup
from skinsource.limbs.locations import output_name
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.models import specs_of
from skinsource.specs.spec import ChoiceSpec, Spec
from skinsource_gui.fields.editors import FieldCell, TextLine
from skinsource_gui.fields.grid import FieldGrid
from skinsource_gui.panels.calibration.steps import (
    MOUNTING,
    CalibrationState,
    sweep_rows,
    verdict,
    verified_rows,
    whom,
)
from skinsource_gui.qt.buttons import page_button, page_label, progress_bar, scrolled, tool_button
from skinsource_gui.qt.labels import RowTable
from skinsource_gui.qt.layouts import in_column, in_row, named, show_tooltip
from skinsource_gui.qt.resources import choice_of, columns_of, read_text
from skinsource_gui.qt.theme import UNIT_PX, current_theme, set_tone
from skinsource_gui.state.panel import Panel

TEXTS: dict[str, dict[str, Any]] = tomllib.loads(read_text("calibration.toml"))
STATION = choice_of("station")
_SWEEPS, _VERIFIED = columns_of("sweeps"), columns_of("verified")
_STEPS = "1 Mounting", "2 Sweeps", "3 Focus"
_OF_SENSOR = "input_number", "sensitivity_v_per_m_per_s2", "input_full_scale_v"
_SPEED = "speed_m_per_s"
# Room for the longer choices.
_LETTERS = 28
_ARM, _CHECK = "Arm the actuators first", "Tick all four points first"
_CODE = "Enter a code of the person first"


class CalibrationPanel(Panel):
    """Leads through the calibration of a person: mounting, sweeps, focus and verification.

    Attributes
    ----------
    cells, checks, buttons
        Fields, boxes and buttons, by their names.
    arm
        The button before which nothing is sent to actuators.
    sweeps, verified
        Tables of inputs and of comparisons.
    message
        What to do next, or what was found.
    """

    title: ClassVar[str] = "Calibration"
    name: ClassVar[str] = "calibration"
    reads_down: ClassVar[bool] = True

    #: Name of a field and its new value.
    field_edited = Signal(str, object)
    #: Name of a button.
    asked = Signal(str)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._state: CalibrationState | None = None
        specs = {**specs_of(MeasuringSetup), **specs_of(Sitting)}
        of_sitting = [name for name in TEXTS["STAND_IN"] if name in specs]
        hint = "Output that is to be strong; or click it on the skin map"
        output = ChoiceSpec(label="Sensor at", options=(), hint=hint)
        named_specs: dict[str, Spec] = {"station": STATION, "output": output}
        named_specs |= {name: specs[name] for name in (*of_sitting, _SPEED, *_OF_SENSOR)}
        speed: Any = specs[_SPEED]
        in_mm = {name: 1e3 * getattr(speed, name) for name in ("minimum", "maximum")}
        named_specs[_SPEED] = replace(speed, unit="mm/s", **in_mm)
        self.cells = {name: FieldCell(name, spec) for name, spec in named_specs.items()}
        for cell in self.cells.values():
            cell.edited.connect(self._edit)
        for name in ("station", "output"):
            choice: Any = self.cells[name].field
            choice.setMinimumContentsLength(_LETTERS)
        self.checks = {
            name: named(QtWidgets.QCheckBox(each["text"]), f"check_{name}", hint=each["hint"])
            for name, each in TEXTS["CHECKS"].items()
        }
        self.buttons = {
            name: page_button(f"calibration_{name}", each["text"], each["hint"])
            for name, each in TEXTS["BUTTONS"].items()
        }
        self.arm = page_button("calibration_arm", "Arm actuators", "Allow to play on the actuators")
        self.arm.setCheckable(True)
        self.steps = {
            number: tool_button(self, f"step_{number}", title, checkable=True)
            for number, title in enumerate(_STEPS)
        }
        self._person = cast("TextLine", self.cells["person"].field)
        self._lacks = page_label("calibration_lacks", tone="dim")
        self.grid = FieldGrid()
        self.sweeps = RowTable("calibration_sweeps", "Sweeps", _SWEEPS, wide=(1,))
        self.verified = RowTable("calibration_verified", "Verification", _VERIFIED, wide=(0,))
        for table in (self.sweeps, self.verified):
            table.setSelectionMode(QtWidgets.QAbstractItemView.SelectionMode.NoSelection)
        self.whom = page_label("calibration_whom")
        self.verdict = page_label("calibration_verdict")
        self.message = page_label("calibration_message")
        self.bar = progress_bar("calibration_bar", "Progress", keeps_room=True)
        self._pages = QtWidgets.QStackedWidget()
        self._lay_out()
        for name, button in self.buttons.items():
            button.clicked.connect(partial(self._ask, name))
        for number, step in self.steps.items():
            step.clicked.connect(partial(self.field_edited.emit, "step", number))
        for box in (*self.checks.values(), self.arm):
            box.toggled.connect(self._enable)
        self.arm.toggled.connect(self._follow_arm)
        self._person.textChanged.connect(self._enable)
        self._go(MOUNTING)

    @property
    def missing(self) -> str:
        """What is to be done before something can be played; "": nothing."""
        state = self._state
        if not self._person.text():
            return _CODE
        if not all(box.isChecked() for box in self.checks.values()):
            return _CHECK
        return "" if state is None or state.stand_in or self.arm.isChecked() else _ARM

    def show_calibration(self, state: CalibrationState) -> None:
        """Show what is known, and the page of its step."""
        before, self._state = self._state, state
        station = state.stand_in, state.rig_title
        if before is None or (before.stand_in, before.rig_title) != station:
            self._show_station(state)
        facts = facts_of(state.sitting.like)
        names = (output_name(k, state.sitting.like) for k in range(1, facts.n_outputs + 1))
        options = tuple((str(each.number), f"{each.number} · {each.name}") for each in names)
        field: Any = self.cells["output"].field
        field.set_options(options)
        for name, cell in self.cells.items():
            if name not in ("station", "output", _SPEED):
                cell.set_value(getattr(state.setup if name in _OF_SENSOR else state.sitting, name))
        self.cells["station"].set_value("stand_in" if state.stand_in else "rig")
        self.cells["output"].set_value(str(state.sitting.output))
        self.cells[_SPEED].set_value(1e3 * state.sitting.speed_m_per_s)
        self.sweeps.fill(sweep_rows(state), max(self.sweeps.currentRow(), 0))
        self.verified.fill(verified_rows(state))
        self._show_failures(state)
        verified = state.verification
        self.verdict.setText(verdict(state))
        warns = verified is not None and verified.state == "differs"
        set_tone(self.verdict, "warning" if warns else "")
        self.message.setText(state.said)
        set_tone(self.message, "warning" if state.warns else "dim")
        if not (before is not None and before.running):
            # How far it is follows.
            self.bar.setRange(0, 0)
        self.bar.setVisible(state.running)
        self.whom.setText(whom(state))
        self.whom.setVisible(state.step != MOUNTING)
        self._enable()
        self._go(state.step)

    def show_progress(self, done: int, total: int, text: str) -> None:
        """Show how far sweeps or playing are."""
        self.bar.setRange(0, total)
        self.bar.setValue(done)
        self.message.setText(f"{text}…")

    def _ask(self, name: str) -> None:
        # A click on a button need not take the keyboard from what is being typed.
        self._person.editingFinished.emit()
        self.asked.emit(name)

    def _edit(self, name: str, value: Any, _gesture: object) -> None:
        self.field_edited.emit(name, value / 1e3 if name == _SPEED else value)

    def _show_station(self, state: CalibrationState) -> None:
        """Offer the rig where there is one; only that has a sensor and is armed."""
        titles = [STATION.options[0], ("rig", state.rig_title)]
        field: Any = self.cells["station"].field
        field.set_options(titles if state.rig_title else titles[:1])
        shown = [cell for name, cell in self.cells.items() if name not in _OF_SENSOR]
        if not state.stand_in:
            shown += [self.cells[name] for name in _OF_SENSOR]
        self.grid.show_cells(shown)
        self.arm.setVisible(not state.stand_in)
        self.arm.setChecked(False)
        for box in self.checks.values():
            box.setChecked(state.stand_in)

    def _show_failures(self, state: CalibrationState) -> None:
        failed = {row.place for row in state.rows if row.failures}
        for line, place in enumerate(state.places):
            item = self.sweeps.item(line, 1)
            if item is not None and place in failed:
                item.setForeground(QtGui.QColor(current_theme().error))

    def _follow_arm(self, armed: bool) -> None:
        if not armed:
            self.asked.emit("stop")

    def _enable(self) -> None:
        """Enable what can be done now."""
        state, missing = self._state, self.missing
        if state is None:
            return
        rests, found = not state.running, state.found
        self.grid.setEnabled(rests)
        can = {
            "open": True,
            "start": not missing,
            "repeat": found is not None and not found.accepted and not missing,
            "save": state.has_partial,
            "focus": state.has_partial or state.opened is not None,
            "verify": state.verification is not None and not missing,
            "report": state.verification is not None,
        }
        stop = self.buttons["stop"]
        if state.running and any(button.hasFocus() for button in self.buttons.values()):
            # Else Qt would hand the keyboard to whatever comes next.
            stop.setEnabled(True)
            stop.setFocus()
        for name, possible in can.items():
            self.buttons[name].setEnabled(rests and possible)
        if rests and stop.hasFocus():
            self.steps[state.step].setFocus()
        stop.setEnabled(state.running)
        self._lacks.setText(f"{missing}." if rests and missing else "")
        show_tooltip(self.buttons["start"], missing or TEXTS["BUTTONS"]["start"]["hint"])

    def _go(self, step: int) -> None:
        self._pages.setCurrentIndex(step)
        for number, button in self.steps.items():
            button.setChecked(number == step)

    def _lay_out(self) -> None:
        buttons = self.buttons
        boxes: Sequence[QtWidgets.QCheckBox] = list(self.checks.values())
        ticks = in_row(in_column(*boxes[::2]), in_column(*boxes[1::2]), None, gap_px=2 * UNIT_PX)
        inside = QtWidgets.QWidget()
        in_column(self.grid, ticks, None, of=inside, margins=(0, 0, UNIT_PX, 0), gap_px=UNIT_PX)
        fields = scrolled(inside, "calibration_fields")
        sweeps = in_row(buttons["repeat"], None, buttons["save"], buttons["focus"])
        verified = in_row(buttons["report"], None, buttons["verify"])
        rows = (
            ((fields, 1), in_row(self.arm, (self._lacks, 1), buttons["open"], buttons["start"])),
            ((self.sweeps, 1), sweeps),
            (self.verdict, (self.verified, 1), verified),
        )
        for parts in rows:
            page = QtWidgets.QWidget()
            in_column(*parts, of=page, margins=0, gap_px=UNIT_PX)
            self._pages.addWidget(page)
        head = in_row(*self.steps.values(), None)
        foot = in_row((self.bar, 1), buttons["stop"])
        edges = (UNIT_PX, UNIT_PX // 2, UNIT_PX, UNIT_PX)
        in_column(
            head,
            self.whom,
            self.message,
            (self._pages, 1),
            foot,
            of=self,
            margins=edges,
            gap_px=UNIT_PX,
        )
