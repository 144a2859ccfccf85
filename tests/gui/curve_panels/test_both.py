"""What traces and spectra do alike; two cursors in them, and what they read."""

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

import skinsource as ss
from skinsource.design.design import View
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.engine.quantities import RULES, sources
from skinsource.signals.analysis.intervals import interval_of
from skinsource.signals.spectra import MEAN_OF_BINS, mean_of_bins
from skinsource_gui.panels.spectra.panel import SpectraPanel, SpectraSettings, curves_of
from skinsource_gui.panels.traces.panel import TracesPanel, TracesSettings
from skinsource_gui.plots.signal_view import SignalView
from skinsource_gui.qt.theme import LIGHT
from skinsource_gui.state.preferences import start_design
from tests.gui.curve_panels import bench
from tests.gui.signal_view.test_navigation import choose, open_menu
from tests.gui.skin.bench import drag


class Kind(NamedTuple):
    """One of the panels, the view it starts with, and its results."""

    panel: type
    view: View
    results_for: Callable


TRACES = Kind(TracesPanel, bench.SIGNED, bench.traces_for)
SPECTRA = Kind(SpectraPanel, bench.LINEAR, bench.spectra_for)


@pytest.fixture(params=[TRACES, SPECTRA], ids=["traces", "spectra"])
def kind(request):
    return request.param


@pytest.fixture
def show(kind, qtbot):
    return bench.opener(qtbot, *kind)


def test_what_the_panel_needs_is_computed_or_given(qapp, kind):
    known = (
        {rule.__name__ for rule in RULES}
        | {"limb_data"}
        | set(sources(start_design("synthetic-1"), View()))
    )
    assert kind.panel().needs <= known


@pytest.mark.parametrize(("limb", "badge"), [("synthetic-2", "SYNTHETIC"), ("measured-1", "")])
def test_only_synthetic_limbs_carry_the_badge(show, limb, badge):
    assert bench.header_of(show(limb=limb)).badge == badge


def test_while_the_first_curves_are_computed_nobody_is_told_to_select_outputs(show, kind, qtbot):
    panel = show(replace(kind.view, outputs=()))
    assert bench.plot_of(panel).message == "Select outputs on the skin map"
    panel.show_stale(True)
    panel.show_state(start_design("synthetic-1"), kind.view)
    assert bench.plot_of(panel).message == ""
    qtbot.waitUntil(lambda: bench.plot_of(panel).message == "Computing…")
    panel.show_state(start_design("synthetic-1"), kind.view)
    assert bench.plot_of(panel).message == "Computing…"
    panel.show_results(kind.results_for(kind.view))
    assert bench.plot_of(panel).message == ""
    assert bench.plot_of(panel).curves is not None


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
    whole = show(View(outputs=(29,))).findChild(SignalView).plot.curves
    assert "levels: RMS over the whole record (record), 0.5 s" in whole.about()
    # The caption below a picture says the rest.
    assert curves.heading == ("Synthetic 1 (175 mm)", "x, y, z, principal axis")


def test_outputs_near_the_noise_are_pale_and_the_plot_says_so(show, kind):
    panel = show(replace(kind.view, outputs=(29, 52)))
    plot = bench.plot_of(panel)
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


BETWEEN_S, BETWEEN_HZ = (0.08, 0.12), (60.0, 200.0)


def with_cursors(qtbot, kind, settings):
    show = bench.opener(qtbot, *kind)
    return lambda at=None, **options: show(
        with_settings(bench.SIGNED, kind.panel.name, settings(cursors=at, **options))
    )


@pytest.fixture
def traces(qtbot):
    return with_cursors(qtbot, TRACES, TracesSettings)


@pytest.fixture
def spectra(qtbot):
    return with_cursors(qtbot, SPECTRA, SpectraSettings)


def legend_of(panel):
    return panel.findChild(SignalView).legend.text


def numbers(line):
    """Numbers of a line after its name, in order."""
    words = line.split(": ", 1)[1].replace(",", " ").replace(";", " ").split()
    return [float(word) for word in words if word.replace(".", "", 1).isdigit()]


def test_a_sine_has_the_velocity_and_the_displacement_of_the_textbook():
    time_s = np.arange(2600) / 1300
    omega = 2 * np.pi * 325.0
    # All samples miss the peak.
    acceleration = 2.0 * np.sin(omega * time_s + np.pi / 4)[None]
    found = interval_of(acceleration, time_s, (0.8, 1.2), 25.0)
    assert found.peak[0] == pytest.approx(2.0, rel=1e-3)
    # Over whole periods: the sample at the end belongs to the next one.
    assert found.rms[0] == pytest.approx(np.sqrt(2.0), rel=1e-12)
    assert found.velocity[0] == pytest.approx(2.0 / omega, rel=1e-3)
    assert found.displacement[0] == pytest.approx(2.0 / omega**2, rel=1e-3)


def test_a_magnitude_has_the_velocity_of_the_motion_along_its_axes():
    time_s = np.arange(2600) / 1300
    omega = 2 * np.pi * 130.0
    axes = np.array([3.0, 4.0])[:, None] * np.sin(omega * time_s)
    magnitude = np.hypot(*axes)[None]
    found = interval_of(magnitude, time_s, (0.8, 1.2), 25.0, axes[None])
    assert found.peak[0] == pytest.approx(5.0, rel=1e-3)
    assert found.velocity[0] == pytest.approx(5.0 / omega, rel=1e-3)
    assert found.displacement[0] == pytest.approx(5.0 / omega**2, rel=1e-3)


@pytest.mark.parametrize(("method", "moves"), [("pca", True), ("mag", False)])
def test_a_line_of_a_rectified_spectrum_has_no_velocity(method, moves):
    view = replace(bench.SIGNED, method=method)
    results = bench.spectra_for(view)
    curves = curves_of(results, SpectraSettings())
    measured = curves.measure((50.0, 150.0))
    assert all(("mm/s" in line) is moves for line in measured.details)
    assert any("rectified" in line for line in curves.about()) is not moves


def test_what_drifts_has_no_velocity():
    time_s = np.arange(1300) / 1300
    found = interval_of(np.ones((1, 1300)), time_s, (0.4, 0.6), 25.0)
    assert found.velocity[0] < 1e-3


def test_traces_are_measured_between_the_cursors_even_relative_to_their_peaks(traces):
    for relative in (False, True):
        text = legend_of(traces(BETWEEN_S, relative=relative))
        results = bench.traces_for(bench.SIGNED)
        inside = (results["response_time_s"] >= BETWEEN_S[0]) & (
            results["response_time_s"] < BETWEEN_S[1]
        )
        assert text.where == "peak, RMS in m/s² · 80.0 to 120.0 ms, Δt 40.0 ms"
        for line, trace in zip(text.details, results["selected_traces"], strict=True):
            peak, _, _, rms = numbers(line)
            assert peak == pytest.approx(np.abs(trace[inside]).max(), rel=0.01)
            assert rms == pytest.approx(np.sqrt(np.mean(trace[inside] ** 2)), rel=0.01)


def test_a_cursor_behind_the_end_of_the_record_is_held_there_until_the_record_is_longer(traces):
    panel = traces((0.08, 0.98))
    for n_times, end_s in ((651, 0.5), (1301, 0.98)):
        panel.show_results(bench.traces_for(bench.SIGNED, n_times=n_times))
        assert legend_of(panel).where.endswith(f"Δt {(end_s - 0.08) * 1e3:.0f} ms")
        assert bench.plot_of(panel).cursors.lines[1].position == pytest.approx(end_s)


def test_the_numbers_of_all_outputs_stay_while_the_pointer_is_in_the_plot(traces):
    panel = traces(BETWEEN_S)
    before = legend_of(panel)
    bench.plot_of(panel).crosshair.put(3)
    assert legend_of(panel) == before
    assert len(before.readings) == len(bench.SIGNED.outputs)
    assert not legend_of(traces()).details


@pytest.mark.parametrize("options", [{}, {"log_magnitude": False}, {"averaged": True}])
def test_spectra_tell_the_drawn_peak_its_frequency_and_the_rms_of_the_band(spectra, options):
    text = legend_of(spectra(BETWEEN_HZ, **options))
    frequency_hz, magnitude = bench.spectra_for(bench.SIGNED)["selected_spectra"]
    inside = (frequency_hz >= BETWEEN_HZ[0]) & (frequency_hz <= BETWEEN_HZ[1])
    assert text.where == "peak in m/s² at Hz · Δf 140 Hz"
    drawn = mean_of_bins(magnitude, MEAN_OF_BINS if "averaged" in options else 1)[:, inside]
    for line, curve, shown in zip(text.details, magnitude, drawn, strict=True):
        peak, at_hz, speed_mm, way_um, rms = numbers(line)
        assert peak == pytest.approx(shown.max(), rel=0.01)
        assert at_hz == pytest.approx(frequency_hz[inside][shown.argmax()], rel=0.01)
        assert line.endswith("unsmoothed spectrum") == ("averaged" in options)
        assert speed_mm == pytest.approx(peak / (2 * np.pi * at_hz) * 1e3, rel=0.02)
        assert way_um == pytest.approx(peak / (2 * np.pi * at_hz) ** 2 * 1e6, rel=0.02)
        assert rms == pytest.approx(np.sqrt(np.sum(curve[inside] ** 2) / 2), rel=0.01)


@pytest.mark.parametrize("longer", [1, 3])
def test_the_rms_between_all_frequencies_is_that_of_the_record_whatever_rings_beyond_it(longer):
    signal = ss.sinusoid(130.0, duration_s=0.5) + 0.5 * ss.sinusoid(260.0, duration_s=0.5)
    response = np.pad(signal, (0, (longer - 1) * signal.size))
    frequency_hz, magnitude = ss.magnitude_spectrum(response[None], 1300.0)
    results = bench.spectra_for(bench.SIGNED) | {
        "selected_spectra": (frequency_hz, longer * magnitude),
        "response_samples": response.size,
        "outputs": (29,),
    }
    line = curves_of(results, SpectraSettings()).measure((0.0, 650.0)).details[0]
    assert numbers(line)[-1] == pytest.approx(ss.rms(signal), rel=0.005)


def test_the_menu_brings_cursors_takes_them_away_and_copies_what_they_read(traces):
    panel = traces()
    signals = panel.findChild(SignalView)
    menu = open_menu(signals)
    assert not any("Copy what cursors" in action.text() for action in menu.actions())
    menu.close()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    choose(signals, "Cursors")
    low, high = settings_of(panel.views[-1], "traces", TracesSettings).cursors
    first, last = bench.plot_of(panel).x_window.extent
    assert first < low < high < last
    choose(signals, "Copy what cursors read")
    copied = QApplication.clipboard().text().splitlines()
    assert copied == [legend_of(panel).where, *legend_of(panel).details]
    choose(signals, "Cursors")
    assert settings_of(panel.views[-1], "traces", TracesSettings).cursors is None
    assert not legend_of(panel).readings


def test_keys_put_a_cursor_at_the_crosshair_and_the_other_makes_room(traces):
    panel = traces(BETWEEN_S)
    plot = bench.plot_of(panel)
    plot.setFocus()
    QTest.keyClick(plot, Qt.Key.Key_Home)
    QTest.keyClick(plot, Qt.Key.Key_O)
    first_s, second_s = settings_of(panel.views[-1], "traces", TracesSettings).cursors
    assert first_s < second_s <= plot.curves.x[1]
    QTest.keyClick(plot, Qt.Key.Key_End)
    QTest.keyClick(plot, Qt.Key.Key_I)
    first_s, second_s = settings_of(panel.views[-1], "traces", TracesSettings).cursors
    assert first_s < second_s == pytest.approx(plot.curves.x[-1])


@pytest.mark.parametrize("log", [False, True])
def test_a_cursor_follows_the_mouse_on_any_axis(spectra, log):
    panel = spectra(BETWEEN_HZ, log_frequency=log)
    plot = bench.plot_of(panel)
    area = plot.places.area

    def at(hz):
        part = plot.x_window.part(plot.x_window.axis.position(hz))
        return QPoint(round(area.left() + part * area.width()), round(area.center().y()))

    viewport = plot.viewport()
    QTest.mouseMove(viewport, at(BETWEEN_HZ[1]))
    drag(viewport, at(BETWEEN_HZ[1]), at(300.0))
    low_hz, high_hz = settings_of(panel.views[-1], "spectra", SpectraSettings).cursors
    assert low_hz == pytest.approx(BETWEEN_HZ[0])
    assert high_hz == pytest.approx(300.0, rel=0.05)


def test_a_peak_hold_tells_no_rms():
    results = bench.spectra_for(replace(bench.SIGNED, span="loudest"))
    details = curves_of(results, SpectraSettings()).measure(BETWEEN_HZ).details
    assert not any("RMS" in line for line in details)
