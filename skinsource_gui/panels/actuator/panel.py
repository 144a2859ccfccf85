"""The actuator panel: choice of actuator and equaliser, their response, and predicted figures.

Predictions of the whole studio can go through what is chosen here.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from PySide6 import QtWidgets
from PySide6.QtCore import QObject, Qt, Signal

from skinsource.actuators.equalising import followed_band
from skinsource.base.measurement_conditions import Band
from skinsource.design import edits
from skinsource.design.design import Design
from skinsource.design.edits.edit import leading_clip
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import CentredTap, Tap
from skinsource.engine.actuator_demand import (
    ActuatorSettings,
    Demand,
    actuation_of,
    actuator_spec,
    settings_through,
)
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import Spec
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.grid import FieldGrid
from skinsource_gui.fields.units import value_text
from skinsource_gui.panels.actuator.figures import (
    TIME_AXIS,
    FiguresView,
    frequency_axis,
    response_curves,
    step_curves,
)
from skinsource_gui.plots.signal_view import SignalView
from skinsource_gui.qt.buttons import page_label
from skinsource_gui.qt.fitting import SteadyArea
from skinsource_gui.qt.layouts import in_column
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.state.panel import Panel

_OF_EQUALISER = {
    "inverse": ("boost_db", "phase", "strength_m_per_s2"),
    "pole_pair": ("new_quality", "strength_m_per_s2"),
    "none": ("volts",),
}
_OF_AMPLITUDES = ("strength_m_per_s2", "volts")
_PARAMETER = "parameter "


class ActuatorChoices(QObject):
    """Cells of all settings; only those are shown that have an effect now.

    Attributes
    ----------
    grid
        Cells of the actuator and its equaliser.
    details
        The parameters of the model, and where they come from.
    """

    #: The new `ActuatorSettings`, number of the gesture or None.
    changed = Signal(object, object)
    #: A measured response shall be opened.
    measured_requested = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._settings, self._predicted = ActuatorSettings(), False
        self._shown: tuple[object, ...] | None = None
        self._cells: tuple[FieldCell, ...] = ()
        self._cached_cells: dict[tuple[str, Spec], FieldCell] = {}
        self.grid, self._parameters = FieldGrid(), FieldGrid()
        self.details = QtWidgets.QWidget()
        self.about = page_label("actuator_about", tone="dim")
        self.about.setTextInteractionFlags(Qt.TextInteractionFlag.NoTextInteraction)
        self.reset = QtWidgets.QPushButton("As listed")
        self.reset.setObjectName("actuator_reset")
        self.reset.setToolTip("Give all parameters back the values that the library lists")
        self.reset.clicked.connect(self._reset)
        self.open = QtWidgets.QPushButton("Measured response…")
        self.open.setObjectName("actuator_open")
        self.open.setToolTip(
            "From a table with frequency_hz, gain and phase, or from sound with the voltage of a "
            "sweep and what the accelerometer said"
        )
        self.open.clicked.connect(self.measured_requested)
        column = in_column(
            self._parameters, self.about, of=self.details, margins=0, gap_px=UNIT_PX // 2
        )
        column.addWidget(self.reset, 0, Qt.AlignmentFlag.AlignLeft)
        column.addWidget(self.open, 0, Qt.AlignmentFlag.AlignLeft)

    def cell(self, name: str) -> FieldCell:
        """Return the cell of a setting, or of ``"parameter "`` and a field of the model."""
        return next(cell for cell in self._cells if cell.name == name)

    def show_settings(self, settings: ActuatorSettings, *, predicted: bool = False) -> None:
        """Show these settings; ``predicted``: amplitudes have a unit of their own."""
        self._settings, self._predicted = settings, predicted
        model = settings.model
        equaliser = settings.equaliser if model is not None else None
        shown = (type(model), equaliser, predicted, settings.measured_title)
        if shown != self._shown:
            self._shown = shown
            self._build()
        for cell in self._cells:
            if cell.name.startswith(_PARAMETER):
                cell.set_value(getattr(model, cell.name.removeprefix(_PARAMETER)))
            else:
                cell.set_value(getattr(settings, cell.name))
        self.about.setText(self._about_text())
        self.reset.setVisible(bool(settings.parameters))

    def _build(self) -> None:
        """Show the cells that are needed now; each is made once and kept."""
        model = self._settings.model
        specs: dict[str, Spec] = {"actuator": actuator_spec(self._settings.measured_title)}
        if model is not None:
            own = specs_of(self._settings)
            names = ("equaliser", *_OF_EQUALISER[self._settings.equaliser])
            hidden = _OF_AMPLITUDES if self._predicted else ()
            specs |= {name: own[name] for name in names if name not in hidden}
            specs |= {
                f"{_PARAMETER}{name}": spec
                for name, spec in specs_of(model).items()
                if isinstance(spec, NumberSpec)
            }
        for name, spec in specs.items():
            if (name, spec) not in self._cached_cells:
                self._cached_cells[name, spec] = FieldCell(name, spec, edited=self._edit)
        self._cells = tuple(self._cached_cells[key] for key in specs.items())
        parameters = tuple(cell for cell in self._cells if cell.name.startswith(_PARAMETER))
        self.grid.show_cells([cell for cell in self._cells if cell not in parameters])
        self._parameters.show_cells(parameters)

    def _about_text(self) -> str:
        profile = self._settings.profile
        calibration = profile.calibration
        lines = [profile.source, f"Calibrated: {calibration[:1].lower()}{calibration[1:]}"]
        changed = []
        for name, value in dict(self._settings.parameters).items():
            spec = specs_of(profile.model).get(name)
            if isinstance(spec, NumberSpec):
                before = value_text(getattr(profile.model, name), spec.unit, 4)
                changed.append(f"{spec.label} {before} → {value_text(value, spec.unit, 4)}")
        if changed:
            lines.append(f"Changed: {', '.join(changed)}.")
        return " ".join(lines)

    def _edit(self, name: str, value: Any, gesture: object) -> None:
        if name.startswith(_PARAMETER):
            settings = self._settings.with_parameter(name.removeprefix(_PARAMETER), value)
        elif name == "actuator":
            settings = replace(self._settings, actuator=value, parameters=(), zoom=None)
        else:
            changed: dict[str, Any] = {name: value}
            settings = replace(self._settings, **changed)
        if settings != self._settings:
            self.changed.emit(settings, gesture)

    def _reset(self) -> None:
        self.changed.emit(replace(self._settings, parameters=()), None)


_TITLE = "Predict through the actuator"
_HINT = (
    "Levels, map, traces and spectra become those of the skin under this actuator and equaliser; "
    "saved with the design"
)
_SHAPE = (
    "Of {title} only the shape of its response is known, not how strong it is: nothing can be "
    "predicted through it. Choose an actuator without “(shape)”, or open a response measured at "
    "yours."
)
_OTHER = "Predictions go through {words}, not through what is shown here."


class ThroughSwitch(QtWidgets.QWidget):
    """A switch that lets the design be predicted through an actuator.

    Attributes
    ----------
    box, text
        The switch; what an amplitude means then, or through which other actuator it goes.
    """

    #: Whether predictions shall go through the actuator of the panel.
    requested = Signal(bool)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.box = QtWidgets.QCheckBox(_TITLE)
        self.text = page_label("actuator_through_words", tone="dim")
        self.box.setObjectName("actuator_through")
        self.box.setToolTip(_HINT)
        self.box.clicked.connect(self.requested)
        in_column(self.box, self.text, of=self, margins=0, gap_px=UNIT_PX // 4)

    def show_state(self, design: Design, settings: ActuatorSettings) -> None:
        """Show what the design is predicted through, beside what the panel shows."""
        actuated = design.actuated
        self.box.setChecked(actuated is not None)
        self.box.setEnabled(actuated is not None or settings.model is not None)
        text = ""
        if actuated is None and settings.model is None:
            text = _SHAPE.format(title=settings.profile.title)
        elif actuated is not None and actuated != actuation_of(settings):
            text = _OTHER.format(words=actuated.words)
        elif actuated is not None and actuated.equaliser is None:
            text = "An amplitude of 1 is 1 V at the actuator."
        elif actuated is not None:
            text = "An amplitude of 1 asks the contactor for 1 m/s²."
        self.box.setToolTip(_HINT if self.box.isEnabled() else text)
        self.text.setText(text)
        self.text.setVisible(bool(text))


_NO_STEP = "Too little is known of this actuator to move it"
_PLOT_PX = 190


class ActuatorPanel(Panel):
    """Response and step of an actuator, the effect of its equaliser, and predicted figures.

    Figures are those of the place of the selected input.
    """

    title = "Actuator"
    name = "actuator"
    reads_down = True

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(300, 200)
        self._design: Design | None = None
        self._view, self._settings = View(), ActuatorSettings()
        self._results: Mapping[str, Any] | None = None
        self._drawn: tuple[ActuatorSettings, bool, Band] | None = None
        self.choices = ActuatorChoices(self)
        self.choices.changed.connect(self._choose)
        self.choices.measured_requested.connect(
            partial(self.action_requested.emit, "open_response")
        )
        self.plot = SignalView("actuator-plot", "Response of the actuator")
        self.plot.setMinimumHeight(_PLOT_PX)
        self._step = self.plot.toolbar.add_switch(
            "actuator-step", "Step", "What 1 V that comes on does, over time", self._show_step
        )
        self.through = ThroughSwitch()
        self.through.requested.connect(self._go_through)
        self.figures = FiguresView()
        self.figures.centred_requested.connect(self._use_centred_tap)
        self.computed = (self.figures.table,)
        # An exceeded limit is visible without scrolling, in a small window too.
        parts = (self.choices.grid, self.through, self.figures, self.plot, self.choices.details)
        in_column(_scrolled(*parts), of=self, margins=0)
        self.plot.toolbar.layout_chosen.connect(partial(self._put, "layout"))
        self.plot.zoom_requested.connect(partial(self._put, "zoom"))
        self.plot.exports.failed.connect(self.failed)
        self.plot.exports.written.connect(self.written)

    @property
    def needs(self) -> frozenset[str]:
        """What is asked of the actuator, and of which: before any response."""
        return frozenset({"actuator_demand", "actuator_looked_at"})

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        # Undo restores the actuator of the design, but not one that is only shown.
        saved = settings_of(view, self.name, ActuatorSettings)
        settings = settings_through(saved, design.actuated)
        # Equal settings stay the same object, so that nothing is computed twice.
        self._settings = self._settings if settings == self._settings else settings
        if self.isVisible():
            self._show_settings()

    def show_results(self, results: Mapping[str, Any]) -> None:
        self._results = results
        self._show_settings()
        self.figures.show_demand(
            results["actuator_demand"],
            results["actuator_looked_at"],
            tap=_plays_tap(self._design, self._view),
            limb="" if self._design is None else self._design.limb,
        )

    def show_problem(self, reason: str) -> None:
        self._results = None
        tap = self._follows and _plays_tap(self._design, self._view)
        refused = Demand(place=None, refusal=reason, leaves_velocity=tap)
        self.figures.show_demand(refused, self._settings, tap=tap)

    def show_folder(self, folder: Path) -> None:
        self.plot.exports.folder = folder

    def _show_settings(self) -> None:
        settings = self._settings
        if self._design is not None:
            self.through.show_state(self._design, settings)
        band = _band_of("" if self._design is None else self._design.limb)
        drawn = settings, self._follows, band
        if drawn == self._drawn:
            return
        self._drawn = drawn
        self.choices.show_settings(settings, predicted=self._follows)
        step = settings.picture == "step"
        self._step.setChecked(step)
        self.plot.toolbar.show_state(layout=settings.layout, zoomed=settings.zoom is not None)
        axis = TIME_AXIS if step else frequency_axis(band)
        self.plot.set_view(axis, settings.zoom, stacked=settings.layout == "stacked")
        curves = step_curves(settings) if step else response_curves(settings, band)
        if curves is None:
            self.plot.show_message(_NO_STEP)
        else:
            self.plot.show_curves(curves, synthetic=False)

    def _use_centred_tap(self) -> None:
        if self._design is not None:
            ids = self._view.selected_inputs
            outcome = edits.change_kind(self._design, self._view, ids, CentredTap.__name__)
            self.edited.emit(outcome, None)

    @property
    def _follows(self) -> bool:
        """Whether what is predicted goes through what the panel shows."""
        actuated = None if self._design is None else self._design.actuated
        return actuated is not None and actuated == actuation_of(self._settings)

    def _go_through(self, on: bool) -> None:
        if self._design is not None:
            through = actuation_of(self._settings) if on else None
            outcome = edits.predict_through(self._design, self._view, through)
            self.edited.emit(outcome, None)
            # After a refusal the box shows the state of the design again.
            self.through.show_state(self._design, self._settings)

    def _choose(self, settings: ActuatorSettings, gesture: int | None = None) -> None:
        if settings == self._settings:
            return
        view, through = with_settings(self._view, self.name, settings), actuation_of(settings)
        if self._design is None or not self._follows or through == self._design.actuated:
            self.view_changed.emit(view)
        else:
            # Predictions follow the shown actuator; a shape ends them.
            self.edited.emit(edits.predict_through(self._design, view, through), gesture)

    def _put(self, name: str, value: object) -> None:
        changed: dict[str, Any] = {name: value}
        self._choose(replace(self._settings, **changed))

    def _show_step(self, step: bool) -> None:
        self._choose(replace(self._settings, picture="step" if step else "response", zoom=None))


def _band_of(limb: str) -> Band:
    """Return the band in which drives are followed on a limb."""
    facts = facts_of(limb)
    return followed_band(facts.band_hz, facts.sample_rate_hz)


def _scrolled(*parts: QtWidgets.QWidget) -> SteadyArea:
    """Return a scroll area with the parts below each other."""
    inside = QtWidgets.QWidget()
    margins = (UNIT_PX, UNIT_PX // 2, UNIT_PX // 2, UNIT_PX)
    in_column(*parts, None, of=inside, margins=margins, gap_px=UNIT_PX // 2)
    scroll = SteadyArea()
    scroll.setObjectName("actuator_scroll")
    scroll.setFrameShape(SteadyArea.Shape.NoFrame)
    scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    scroll.setWidget(inside)
    return scroll


def _plays_tap(design: Design | None, view: View) -> bool:
    """Return whether the edited clip plays a tap that leaves a velocity."""
    clip = None if design is None else leading_clip(design, view)
    return clip is not None and isinstance(clip.waveform, Tap)
