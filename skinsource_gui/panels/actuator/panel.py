"""An actuator, its equaliser, and what the design asks of both."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QVBoxLayout, QWidget

from skinsource.actuators.equalising import followed_band
from skinsource.base.published import Band
from skinsource.design import edits
from skinsource.design.design import Design
from skinsource.design.edits.edit import clip_of
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource.design.waveforms import CentredTap, Tap
from skinsource.engine.actuator_demand import (
    ActuatorSettings,
    Demand,
    actuation_of,
    settings_through,
)
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.panel import Panel
from skinsource_gui.panels.actuator.choices import ActuatorChoices
from skinsource_gui.panels.actuator.demand_curves import (
    TIME_AXIS,
    frequency_axis,
    response_curves,
    step_curves,
)
from skinsource_gui.panels.actuator.figures_view import FiguresView
from skinsource_gui.panels.actuator.prediction_switch import ThroughSwitch
from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.plot.signal_view import SignalView
from skinsource_gui.widgets.room.steady_area import SteadyArea

_NO_STEP = "Too little is known of this actuator to move it"
_PLOT_PX = 190


class ActuatorPanel(Panel):
    """Response and step of an actuator, the equaliser's part in it, and predicted figures.

    Figures are those of the place of the selected input.
    """

    title = "Actuator"
    name = "actuator"
    reads_down = True

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(300, 200)
        self._design: Design | None = None
        self._view, self._settings = View(), ActuatorSettings()
        self._results: Mapping[str, Any] | None = None
        self._drawn: tuple[ActuatorSettings, bool, Band] | None = None
        self.choices = ActuatorChoices(self)
        self.choices.changed.connect(self._choose)
        self.choices.measured_wanted.connect(partial(self.action_wanted.emit, "open_response"))
        self.plot = SignalView("actuator-plot", "Response of the actuator")
        self.plot.setMinimumHeight(_PLOT_PX)
        self._step = self.plot.toolbar.add_switch(
            "actuator-step", "Step", "What 1 V that comes on does, over time", self._show_step
        )
        self.through = ThroughSwitch()
        self.through.wanted.connect(self._go_through)
        self.figures = FiguresView()
        self.figures.centred_wanted.connect(self._use_centred_tap)
        self.computed = (self.figures.table,)
        outside = QVBoxLayout(self)
        outside.setContentsMargins(0, 0, 0, 0)
        outside.addWidget(
            _scrolled(
                # What passes a limit is seen without scrolling, in a small window too.
                self.choices.grid,
                self.through,
                self.figures,
                self.plot,
                self.choices.details,
            )
        )
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
        # What the design is predicted through goes back with it; what is looked at does not.
        kept = settings_of(view, self.name, ActuatorSettings)
        settings = settings_through(kept, design.actuated)
        # Equal ones stay the same, so that nothing is computed twice.
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

    def _go_through(self, wanted: bool) -> None:
        if self._design is not None:
            through = actuation_of(self._settings) if wanted else None
            outcome = edits.predict_through(self._design, self._view, through)
            self.edited.emit(outcome, None)
            # Where it was refused the box says what is.
            self.through.show_state(self._design, self._settings)

    def _choose(self, settings: ActuatorSettings, gesture: int | None = None) -> None:
        if settings == self._settings:
            return
        view, through = with_settings(self._view, self.name, settings), actuation_of(settings)
        if self._design is None or not self._follows or through == self._design.actuated:
            self.view_changed.emit(view)
        else:
            # What is predicted goes with what is shown; a shape ends it.
            self.edited.emit(edits.predict_through(self._design, view, through), gesture)

    def _put(self, name: str, value: object) -> None:
        changed: dict[str, Any] = {name: value}
        self._choose(replace(self._settings, **changed))

    def _show_step(self, step: bool) -> None:
        self._choose(replace(self._settings, picture="step" if step else "response", zoom=None))


def _band_of(limb: str) -> Band:
    """In which drives are followed on a limb."""
    facts = facts_of(limb)
    return followed_band(facts.band_hz, facts.sample_rate_hz)


def _scrolled(*parts: QWidget) -> SteadyArea:
    """Parts below each other."""
    inside = QWidget()
    column = QVBoxLayout(inside)
    column.setContentsMargins(UNIT_PX, UNIT_PX // 2, UNIT_PX // 2, UNIT_PX)
    column.setSpacing(UNIT_PX // 2)
    for part in parts:
        column.addWidget(part)
    column.addStretch(1)
    scroll = SteadyArea()
    scroll.setObjectName("actuator_scroll")
    scroll.setFrameShape(SteadyArea.Shape.NoFrame)
    scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    scroll.setWidget(inside)
    return scroll


def _plays_tap(design: Design | None, view: View) -> bool:
    """Whether the clip that is edited plays the upstream tap."""
    if design is None or view.selected_input not in design.ids:
        return False
    clip = clip_of(design.input(view.selected_input), view)
    return clip is not None and isinstance(clip.waveform, Tap)
