"""What traces and spectra do alike."""

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import pytest

from skinsource.design.view import View
from skinsource.engine.quantities import RULES, sources
from skinsource_gui.panels.spectra.panel import SpectraPanel
from skinsource_gui.panels.traces.panel import TracesPanel
from skinsource_gui.plots.signal_view import SignalView
from skinsource_gui.qt.theme import LIGHT
from skinsource_gui.state.preferences import start_design
from tests.gui.curve_panels.bench import (
    LINEAR,
    SIGNED,
    header_of,
    opener,
    plot_of,
    spectra_for,
    traces_for,
)


class Kind(NamedTuple):
    """One of the panels, the view it starts with, and its results."""

    panel: type
    view: View
    results_for: Callable


TRACES = Kind(TracesPanel, SIGNED, traces_for)
SPECTRA = Kind(SpectraPanel, LINEAR, spectra_for)


@pytest.fixture(params=[TRACES, SPECTRA], ids=["traces", "spectra"])
def kind(request):
    return request.param


@pytest.fixture
def show(kind, qtbot):
    return opener(qtbot, *kind)


def test_what_the_panel_needs_is_computed_or_given(qapp, kind):
    known = (
        {rule.__name__ for rule in RULES}
        | {"limb_data"}
        | set(sources(start_design("synthetic-1"), View()))
    )
    assert kind.panel().needs <= known


@pytest.mark.parametrize(("limb", "badge"), [("synthetic-2", "SYNTHETIC"), ("measured-1", "")])
def test_only_synthetic_limbs_carry_the_badge(show, limb, badge):
    assert header_of(show(limb=limb)).badge == badge


def test_while_the_first_curves_are_computed_nobody_is_told_to_select_outputs(show, kind, qtbot):
    panel = show(replace(kind.view, outputs=()))
    assert plot_of(panel).message == "Select outputs on the skin map"
    panel.show_stale(True)
    panel.show_state(start_design("synthetic-1"), kind.view)
    assert plot_of(panel).message == ""
    qtbot.waitUntil(lambda: plot_of(panel).message == "Computing…")
    panel.show_state(start_design("synthetic-1"), kind.view)
    assert plot_of(panel).message == "Computing…"
    panel.show_results(kind.results_for(kind.view))
    assert plot_of(panel).message == ""
    assert plot_of(panel).curves is not None


def test_files_of_the_curves_say_whose_they_are_and_how_they_were_made(show):
    panel = show(View(method="pca", outputs=(29,), span="loudest"))
    curves = panel.findChild(SignalView).plot.curves
    for fact in (
        "NOTE on the limb: made from files of one's own",
        "limb: Synthetic 1 (175 mm), synthetic-1; scaling: Peak of each input (upstream)",
        "axes: x, y, z (xyz); method: Principal axis (pca)",
        "levels: RMS over the loudest 100 ms (loudest)",
    ):
        assert fact in curves.about()
    assert any("clip of the input at place 7: Tone(" in line for line in curves.about())
    # The caption below a picture says the rest.
    assert curves.heading == ("Synthetic 1 (175 mm)", "x, y, z, principal axis")


def test_outputs_near_the_noise_are_pale_and_the_plot_says_so(show, kind):
    panel = show(replace(kind.view, outputs=(29, 52)))
    plot = plot_of(panel)
    colours = [curve.pen.color() for row in plot.stack.rows for curve in row.curves[:2]]
    panel._staleness.set_stale(True, at_once=True)
    panel.show_noisy((52, 70))
    first, second = (curve.pen.color() for row in plot.stack.rows for curve in row.curves[:2])
    assert (first, second) == (colours[0], LIGHT.pale(colours[1]))
    assert "pale" in plot.texts.notes[0]
    assert [name.noisy for name in panel.findChild(SignalView).legend.text.names] == [False, True]
    # It is no news of the design.
    assert panel.is_stale
    panel.show_noisy(())
    assert plot.texts.notes == ()
