"""Strengths as velocities, and outputs band by band: drawn, read and copied."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QFont, QFontMetricsF
from PySide6.QtTest import QTest

import skinsource as ss
from skinsource.design.panel_settings import settings_of
from skinsource.engine.evaluation import evaluate
from skinsource.perception.validity import probe_velocity
from skinsource.studies.figures.figures import lines_of
from skinsource_gui.panels.linearity.settings import LinearitySettings
from skinsource_gui.plots.figure import Axis, fitted_axes
from tests.gui.linearity.test_linearity_panel import (
    OUTPUTS,
    PARTS,
    STRENGTHS,
    settled,
    show,
    snapshots_of,
)

__all__ = ["show"]

RATE_HZ = 1300.0


def switch(window, panel, qtbot, name):
    QTest.mouseClick(getattr(panel, name), Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: settled(window, panel))


def test_a_divided_response_has_the_unit_of_response_and_strength(show):
    _, panel = show(STRENGTHS)
    over, growth, _ = panel.picture.diagrams
    assert over.y.title == "Divided (m/s² per m/s²)"
    assert growth.x.title == "Strength (m/s²)"
    _, panel = show([replace(design, scaling="relative") for design in STRENGTHS])
    assert panel.picture.diagrams[0].y.title == "Divided (m/s²)"
    assert not panel.velocity.isVisible()


def test_strengths_are_velocities_of_the_probe_where_these_are_known(show, qtbot):
    window, panel = show(STRENGTHS)
    divided = panel.picture.diagrams[0].curves[0].y
    fastest = []
    for design in STRENGTHS:
        [(_, drive)] = evaluate(design, "place_drives")["place_drives"]
        fastest.append(probe_velocity(drive, RATE_HZ))
        fastest_m_per_s = evaluate(design, "fastest_probe_m_per_s")["fastest_probe_m_per_s"]
        assert fastest_m_per_s == pytest.approx(fastest[-1])
    switch(window, panel, qtbot, "velocity")
    settings = settings_of(window.document.view, "linearity", LinearitySettings)
    assert settings.velocity
    over, growth, _ = panel.picture.diagrams
    assert (over.y.title, over.y.short) == ("Divided (m/s² per mm/s)", "m/s² per mm/s")
    assert growth.x.title == "Probe velocity (mm/s)"
    assert growth.curves[0].x == pytest.approx(1e3 * np.array(fastest))
    assert over.curves[0].y * 1e3 * fastest[0] == pytest.approx(divided)
    head, *rows = panel.table().splitlines()
    assert head.startswith("probe_velocity_m_per_s\trms_20_z_m_per_s2")
    assert [float(row.split("\t")[0]) for row in rows] == pytest.approx(fastest)


@pytest.mark.parametrize("scaling", ["relative", "upstream"])
def test_no_velocity_is_known_in_other_scalings(scaling):
    design = replace(STRENGTHS[0], scaling=scaling)
    assert evaluate(design, "fastest_probe_m_per_s")["fastest_probe_m_per_s"] is None


def test_outputs_are_drawn_band_by_band_over_logarithmic_axes(show, qtbot):
    window, panel = show(STRENGTHS)
    switch(window, panel, qtbot, "bands")
    growth = panel.picture.diagrams[1]
    assert growth.x.log
    assert growth.y.log
    labels = [curve.label for curve in growth.curves if curve.label]
    assert labels == ["50 Hz", "100 Hz", "200 Hz", "400 Hz"] * len(OUTPUTS)
    for line, dots in zip(growth.curves[::2], growth.curves[1::2], strict=True):
        assert dots.y == pytest.approx(line.y, rel=1e-6)
        assert dots.y / dots.x == pytest.approx(dots.y[0] / dots.x[0], rel=1e-6)
    panel.grab()
    origin, axes = panel.picture._placed[1]
    assert "In the band (m/s²)" in panel.picture.read(origin + axes.frame.center())


def test_the_copied_bands_are_those_of_the_printed_figure(window, qtbot):
    window.scenes.open("5D")
    panel = window.panel("linearity")
    qtbot.waitUntil(lambda: panel.result is not None, timeout=60_000)
    assert panel.bands.isChecked()
    head, *rows = (line.split("\t") for line in panel.table().splitlines())
    fits = lines_of(ss.scenes.open_scene("5D"))
    numbers = np.array([[float(cell) for cell in row] for row in rows])
    assert numbers[:, 0] == pytest.approx(fits.frequency_hz)
    for level, strength in enumerate((0.75, 1.5, 3.0, 6.0)):
        for output in (20, 26):
            column = head.index(f"band_rms_{output}_z_m_per_s2 at strength {strength:g}")
            expected = fits.output_rms[level, output - 1]
            assert numbers[:, column] == pytest.approx(expected, rel=1e-6)
    assert numbers[:, head.index("adjusted_r2_26_z")] == pytest.approx(1.0)
    assert "RMS over all bands" not in window.document.design.notes


@pytest.mark.parametrize(("name", "switched"), [("5A", "velocity"), ("5E", "bands")])
def test_scenes_open_with_what_their_figures_tell(window, qtbot, name, switched):
    window.scenes.open(name)
    panel = window.panel("linearity")
    qtbot.waitUntil(lambda: panel.result is not None, timeout=60_000)
    assert getattr(panel, switched).isChecked()


def test_the_switches_compute_no_prediction_and_are_about_strengths(show, qtbot):
    window, panel = show(STRENGTHS)
    asked = []
    ask = window.engine.request
    window.engine.request = lambda request: (asked.append(request.slot.name), ask(request))
    traces = panel._drawn[-len(STRENGTHS) :]
    for name in ("velocity", "bands", "velocity", "bands"):
        before = panel.picture.diagrams
        switch(window, panel, qtbot, name)
        assert panel.picture.diagrams is not before
        drawn = panel._drawn[-len(STRENGTHS) :]
        assert all(trace is other for trace, other in zip(traces, drawn, strict=True))
    assert not any("snapshot" in request for request in asked)
    window.document.look(replace(window.document.view, snapshots=snapshots_of(*PARTS)))
    window.document.edit("Both", PARTS[2])
    qtbot.waitUntil(lambda: len(panel.picture.diagrams) == 2, timeout=30_000)
    assert not panel.velocity.isVisible()
    assert not panel.bands.isVisible()


def test_a_logarithmic_axis_places_reads_and_labels_by_factors(qtbot):
    axis = Axis(shown=(0.5, 50.0), title="Strength", log=True)
    assert axis.part(np.array([0.5, 5.0, 50.0])) == pytest.approx([0.0, 0.5, 1.0])
    assert np.isnan(axis.part(np.array([0.0]))).all()
    assert axis.value(0.5) == pytest.approx(5.0)
    assert {"1", "10"} <= {tick.label for tick in axis.ticks(200.0, 60.0)}


def test_a_title_that_has_no_room_gives_way_to_the_short_one(qtbot):
    metrics = QFontMetricsF(QFont())
    axis = Axis(shown=(0.0, 1.0), title="Divided (m/s² per mm/s)", short="m/s² per mm/s")
    room = metrics.horizontalAdvance(axis.title)
    assert axis.title_in(metrics, room) == axis.title
    assert axis.title_in(metrics, room - 1.0) == axis.short
    assert fitted_axes(QRectF(0, 0, 300, 200), axis, axis, metrics).frame.height() > 100
