"""Checks of stored designs: strengths in proportion, or inputs that add up."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from PySide6 import QtWidgets

from skinsource.base.arrays import Floats
from skinsource.design.amplitudes import amplitude_unit, is_gain
from skinsource.design.comparing import EDITED, NUMBERS, Snapshot
from skinsource.design.design import Design
from skinsource.design.panel_settings import settings_of
from skinsource.design.view import View
from skinsource.limbs.own_limbs import axes_on, facts_of
from skinsource.specs.spec import SwitchSpec
from skinsource.studies.checking import (
    Proportion,
    Straightness,
    Superposition,
    joint_of,
    proportion,
    straightness,
    strengths_of,
    superposition,
)
from skinsource_gui.panels.analysis.linearity_diagram import (
    DiagramsPicture,
    StrengthUnit,
    diagrams_of_proportion,
    diagrams_of_superposition,
    of_amplitudes,
    of_velocities,
    part_text,
    proportion_text,
    superposition_text,
)
from skinsource_gui.panels.analysis.settings import BANDS, EVERY_OUTPUT, VELOCITY, LinearitySettings
from skinsource_gui.panels.analysis.view import FigureView
from skinsource_gui.qt.buttons import tool_button
from skinsource_gui.qt.fitting import FoldingRow
from skinsource_gui.qt.keys import shortcut_text
from skinsource_gui.qt.questions import tab_separated
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.state.compared import SILENT, Compared

_STORED_ALONE = "snapshots alone"


@dataclass(frozen=True, slots=True, kw_only=True)
class ComparedDesigns:
    """Designs, and how they relate to each other.

    Attributes
    ----------
    compared
        The designs that count.
    strengths
        Strength of each, where they differ in that alone; else empty.
    joint
        Which of them plays what all the others play; None: none does.
    note
        Which designs count, where it is not all of them.
    """

    compared: Sequence[Compared]
    strengths: tuple[float, ...] = ()
    joint: int | None = None
    note: str = ""

    @property
    def is_linear(self) -> bool:
        """Whether there is something to be held against each other."""
        return bool(self.strengths) or self.joint is not None


def compared_designs(compared: Sequence[Compared]) -> ComparedDesigns:
    """Return all designs, or the stored ones, where the edited one does not relate to them."""
    every_design = _compared_designs(compared)
    stored = [side for side in compared if side.snapshot.number != EDITED]
    if every_design.is_linear or len(stored) == len(compared):
        return every_design
    stored_alone = _compared_designs(stored, _STORED_ALONE)
    return stored_alone if stored_alone.is_linear else every_design


def _compared_designs(compared: Sequence[Compared], text: str = "") -> ComparedDesigns:
    designs = [side.snapshot.design for side in compared]
    return ComparedDesigns(
        compared=compared, strengths=strengths_of(designs), joint=joint_of(designs), note=text
    )


_Lines = list[tuple[str | float, ...]]


def table_text(
    result: Proportion | Superposition,
    outputs: tuple[int, ...],
    axes: tuple[str, ...],
    unit: StrengthUnit,
    *,
    bands: bool = False,
    all_outputs: Straightness | None = None,
) -> str:
    """Return a table of RMS by strength, output by band, R² of each output, or r of each channel.

    Channels are ``axes`` of each of ``outputs``; ``unit`` is that of strengths. With ``bands``
    outputs are listed in all bands; with ``all_outputs`` R² of all outputs is listed instead.
    """
    channels = [(output, axis) for output in outputs for axis in axes]
    lines: _Lines
    if isinstance(result, Proportion) and all_outputs is not None:
        lines = _straightness_table(all_outputs, axes)
    elif isinstance(result, Proportion):
        names = [f"{output}_{axis}" for output, axis in channels]
        lines = (_by_band if bands else _by_strength)(result, names, unit)
    else:
        lines = [("output", "axis", "pearson_r")]
        for (output, axis), r in zip(channels, result.correlation, strict=True):
            lines.append((str(output), axis, r))
    return tab_separated(lines)


def _straightness_table(all_outputs: Straightness, axes: tuple[str, ...]) -> _Lines:
    numbers = range(1, len(all_outputs.adjusted_r2) + 1)
    lines: _Lines = [
        ("frequency_hz", *(f"adjusted_r2_{k}_{axis}" for k in numbers for axis in axes))
    ]
    of_channels = all_outputs.adjusted_r2.reshape(-1, all_outputs.frequency_hz.size)
    for frequency_hz, r2 in zip(all_outputs.frequency_hz, of_channels.T, strict=True):
        lines.append((frequency_hz, *r2))
    return lines


def _by_strength(result: Proportion, channels: list[str], unit: StrengthUnit) -> _Lines:
    lines: _Lines = [(unit.column, *(f"rms_{channel}_m_per_s2" for channel in channels))]
    for strength, rms in zip(result.strengths * unit.si_factor, result.rms, strict=True):
        lines.append((strength, *rms))
    return lines


def _by_band(result: Proportion, channels: list[str], unit: StrengthUnit) -> _Lines:
    strengths = [f"{unit.column} {strength:.6g}" for strength in result.strengths * unit.si_factor]
    of_strengths = [
        f"band_rms_{channel}_m_per_s2 at {at}" for at in strengths for channel in channels
    ]
    lines: _Lines = [
        ("frequency_hz", *of_strengths, *(f"adjusted_r2_{channel}" for channel in channels))
    ]
    for k, frequency_hz in enumerate(result.frequency_hz):
        levels, r2 = result.band_rms[..., k].ravel(), result.adjusted_r2[:, k]
        lines.append((frequency_hz, *levels, *r2))
    return lines


_NEEDS = frozenset(
    {
        "axis_traces",
        "delay_removed",
        "fastest_probe_m_per_s",
        "response_time_s",
        "sample_rate_hz",
        "shown_outputs",
    }
)
_BAND_RMS = "output_band_rms"
_TOO_MUCH = "Too long to show here; File > Check against a recording… checks linearity"
# More values would take too long to draw.
_MOST_VALUES = 2_000_000


class LinearityView(FigureView):
    """Whether outputs grow in step with the strength, and whether inputs add up."""

    title: ClassVar[str] = "Linearity"
    name: ClassVar[str] = "linearity"
    compares: ClassVar[bool] = True

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        self.picture = DiagramsPicture("linearity_picture", "Linearity of snapshots")
        super().__init__(self.picture, parent)
        self.settings = LinearitySettings()
        self._unit = of_amplitudes("")
        self._drawn: tuple[Any, ...] = ()
        self._outputs: tuple[int, ...] = ()
        self._axes: tuple[str, ...] = ()
        self.result: Proportion | Superposition | None = None
        self.all_outputs: Straightness | None = None
        self.about = self.add_above("linearity_about")
        self.about.setToolTip("Snapshots as stored; over time, the part to which Traces is zoomed")
        self.velocity = self._new_switch("velocity", VELOCITY)
        self.bands = self._new_switch("bands", BANDS)
        self.every_output = self._new_switch("every_output", EVERY_OUTPUT)
        self._switches = self.velocity, self.bands, self.every_output
        self.choices.addWidget(FoldingRow(self._switches, UNIT_PX // 2, left=True), 1)
        self.heads.addWidget(self.about)
        self.say_instead(_how_to_start())

    @property
    def needs_of_snapshots(self) -> frozenset[str]:
        if not self._view.outputs:
            return frozenset()
        return _NEEDS | {_BAND_RMS} if self.settings.every_output else _NEEDS

    def snapshots_drawn(self, snapshots: Sequence[Snapshot]) -> Sequence[Snapshot]:
        designs = compared_designs([Compared(snapshot=snapshot) for snapshot in snapshots])
        return [side.snapshot for side in designs.compared]

    def show_state(self, design: Design, view: View) -> None:
        self._view, self.settings = view, settings_of(view, self.name, LinearitySettings)
        self.velocity.setChecked(self.settings.velocity)
        self.bands.setChecked(self.settings.bands)
        self.every_output.setChecked(self.settings.every_output)
        self.show_selection(view)

    def show_snapshots(self, compared: Sequence[Compared]) -> None:
        designs = compared_designs(compared)
        problem = next((side.problem for side in designs.compared if side.problem), "")
        needed = self.needs_of_snapshots
        known = [side.values for side in designs.compared if side.values is not None]
        # A switch may need more than what was found before it: that is on its way.
        complete = [values for values in known if needed <= values.keys()]
        if not designs.is_linear:
            self.say_instead(_how_to_start())
        elif problem:
            self.say_instead(problem)
        elif len(complete) < len(designs.compared):
            if self.result is None:
                self.await_results()
            else:
                self.show_stale(True)
        else:
            settings, view = self.settings, self._view
            switched = settings.velocity, settings.bands, settings.every_output, designs.note
            how = view.time_range_s, view.delay_removed, *switched
            if not self._is_drawn((*how, *(values["axis_traces"] for values in complete))):
                self._show(designs, complete)
            self.show_stale(False)

    def show_problem(self, reason: str) -> None:
        """Do nothing: snapshots have problems of their own, see `show_snapshots`."""

    def say_instead(self, message: str) -> None:
        self._drawn, self.result, self.all_outputs = (), None, None
        self.show_stale(False)
        super().say_instead(message)
        self.about.say("")
        for switch in self._switches:
            switch.hide()

    def table_text(self) -> str:
        if self.result is None:
            return ""
        unit, bands = self._unit, self.settings.bands
        all_outputs = self.all_outputs
        return table_text(
            self.result, self._outputs, self._axes, unit, bands=bands, all_outputs=all_outputs
        )

    def _is_drawn(self, drawn: tuple[Any, ...]) -> bool:
        same = len(drawn) == len(self._drawn) and all(
            part is other for part, other in zip(drawn, self._drawn, strict=True)
        )
        if not same:
            self._drawn = drawn
        return same

    def _new_switch(self, setting: str, spec: SwitchSpec) -> QtWidgets.QToolButton:
        """Return a switch above the diagrams, which is only about strengths."""
        name = f"linearity_{spec.label.split()[-1].replace('/', '_')}"
        switch = tool_button(None, name, spec.label, spec.hint, checkable=True)
        switch.clicked.connect(lambda on: self.change_settings(**{setting: on}))
        switch.hide()
        return switch

    def _show(self, designs: ComparedDesigns, results: Sequence[Mapping[str, Any]]) -> None:
        """Draw what is known of all designs."""
        drawn, design = self._drawn, designs.compared[0].snapshot.design
        strengths, joint = designs.strengths, designs.joint
        traces = [result["axis_traces"] for result in results]
        n_outputs, n_axes, _ = traces[0].shape
        if sum(trace.size for trace in traces) > _MOST_VALUES:
            self.say_instead(_TOO_MUCH)
            return
        channels = [trace.reshape(n_outputs * n_axes, -1) for trace in traces]
        if not all(channel.any() for channel in channels):
            self.say_instead(SILENT)
            return
        axes, limb = axes_on(design.limb, self._view.axes), facts_of(design.limb)
        along = "z" if "z" in axes else axes[0]
        rows = tuple(axes.index(along) + n_axes * rank for rank in range(n_outputs))
        zoom, longest = self._view.time_range_s, results[joint or 0]
        self._outputs, self._axes = longest["shown_outputs"], tuple(axes)
        time_s = self._time_s(longest, limb.pre_trigger_delay_s)
        if strengths:
            rate_hz = longest["sample_rate_hz"]
            self.result = shown = proportion(strengths, np.stack(channels), rate_hz, limb.band_hz)
            fastest = results[0]["fastest_probe_m_per_s"]
            self.velocity.setVisible(bool(fastest))
            factors = any(is_gain(design, track) for track in design.inputs)
            self._unit = of_amplitudes("×" if factors else amplitude_unit(design))
            if fastest and self.settings.velocity:
                self._unit = of_velocities(fastest / strengths[0])
            self.all_outputs = (
                _straightness(strengths, results) if self.settings.every_output else None
            )
            drawing = diagrams_of_proportion(
                shown,
                rows,
                time_s,
                zoom,
                self._unit,
                bands=self.settings.bands,
                all_outputs=None
                if self.all_outputs is None
                else self.all_outputs.adjusted_r2[:, axes.index(along)],
            )
            self.picture.show_diagrams(drawing, self._outputs)
            self.show_result(proportion_text(shown, self.all_outputs))
        elif joint is not None:
            self.velocity.hide()
            parts = [channel for k, channel in enumerate(channels) if k != joint]
            self.result = added = superposition(parts, channels[joint])
            drawing = diagrams_of_superposition(added, rows, time_s, zoom)
            self.picture.show_diagrams(drawing, self._outputs)
            self.show_result(superposition_text(added))
        self.bands.setVisible(bool(strengths))
        self.every_output.setVisible(bool(strengths))
        self._drawn = drawn
        self.offer_copy(True)
        notes = [f"Along {along}: linear by construction", designs.note]
        notes.append("synthetic limb" * limb.synthetic)
        notes.append(part_text(drawing[0].x.shown, time_s, zoom))
        self.about.say(" · ".join(filter(None, notes)))

    def _time_s(self, results: Mapping[str, Any], delay_s: float) -> Floats:
        """Return the times on the time axes of the window, (n_times,), s.

        Results of the window are up to date with the delay that is removed; those of snapshots are
        not, as nothing else of them depends on it.
        """
        time_s: Floats = results["response_time_s"]
        return time_s + delay_s * (int(results["delay_removed"]) - int(self._view.delay_removed))


def _straightness(
    strengths: Sequence[float], results: Sequence[Mapping[str, Any]]
) -> Straightness | None:
    """Return how straight all outputs are; None: they are too long to be transformed at once."""
    in_bands = [result[_BAND_RMS] for result in results]
    return None if any(levels is None for levels in in_bands) else straightness(strengths, in_bands)


def _how_to_start() -> str:
    """Return what to store, where designs are neither strengths nor a sum."""
    first, last = (shortcut_text(f"store_snapshot_{number}") for number in (1, NUMBERS[-1]))
    return (
        "Store one stimulus at three strengths or more, or inputs alone and all of them together, "
        f"with {first} to {last}: the panel shows whether responses scale linearly and superpose"
    )
