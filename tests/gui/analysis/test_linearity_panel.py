"""Snapshots held against each other: strengths in proportion, inputs that add up."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QImage, QPainter
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

import skinsource as ss
from skinsource import View, evaluate
from skinsource.design.design import Snapshot
from skinsource.design.edits.setup import remove_delay
from skinsource.design.panel_settings import settings_of
from skinsource.perception.validity import probe_velocity
from skinsource.studies.checking import Proportion, Superposition, proportion, superposition
from skinsource_gui.panels.analysis import linearity
from skinsource_gui.panels.analysis.settings import LinearitySettings
from skinsource_gui.plots.figure import Axis, fitted_axes, legend_texts
from skinsource_gui.plots.pictures import save_drawing
from skinsource_gui.qt.theme import LIGHT
from skinsource_gui.state.compared import Compared
from tests.gui.analysis.analysis_bench import analysis
from tests.gui.test_pictures_out import texts_of

RATE_HZ = 1300.0
TIME_S = np.arange(4000) / RATE_HZ
RATIOS = np.array([1.0, 2.0, 4.0])
ROWS = (1, 3)


def responses(n_times=4000):
    return np.random.default_rng(5).normal(size=(4, n_times))


def bent():
    saturated = np.tanh(RATIOS[:, None, None] * responses())
    return proportion(RATIOS, saturated, RATE_HZ, None)


def test_without_a_zoom_the_part_around_the_loudest_instant_is_drawn():
    curves = responses()
    curves[2, 3000] = 50.0
    first, end = linearity.part_of(TIME_S, curves, None)
    assert (TIME_S[first], TIME_S[end]) == pytest.approx((3000 / RATE_HZ - 0.015,) * 2, abs=0.04)
    assert first < 3000 < end
    assert TIME_S[end] - TIME_S[first] == pytest.approx(0.03, abs=2 / RATE_HZ)


@pytest.mark.parametrize("zoom", [(-1.0, 100.0), (0.5, 3.0), (0.0, 3.07)])
def test_a_long_part_is_drawn_from_its_begin_on_as_far_as_lines_are_quick(zoom):
    first, end = linearity.part_of(TIME_S, responses(), zoom)
    assert TIME_S[first] == pytest.approx(max(zoom[0], 0.0), abs=1 / RATE_HZ)
    assert end - first == 1500


@pytest.mark.parametrize("zoom", [(-2.0, -1.0), (90.0, 91.0), (1.0, 1.0)])
def test_of_a_part_in_which_there_is_nothing_two_samples_are_drawn(zoom):
    first, end = linearity.part_of(TIME_S, responses(), zoom)
    assert 0 <= first == end - 2 <= TIME_S.size - 2


def test_each_strength_is_seen_below_the_next_one_and_in_the_colour_of_its_output():
    over = linearity.diagrams_of_proportion(
        bent(), ROWS, TIME_S, (0.1, 0.2), linearity.of_amplitudes("m/s²")
    )[0].curves
    assert [curve.rank for curve in over] == [0, 0, 0, 1, 1, 1]
    for curves in (over[:3], over[3:]):
        widths, pale = ([getattr(curve, name) for curve in curves] for name in ("width_px", "pale"))
        assert widths == sorted(widths, reverse=True)
        assert pale == sorted(pale, reverse=True)
        assert (pale[0] > 0.5, pale[-1]) == (True, 0.0)
    # Each is what it is, divided by its strength.
    at = np.searchsorted(over[0].x, 0.15)
    sample = np.argmin(np.abs(TIME_S - over[0].x[at]))
    assert TIME_S[sample] == pytest.approx(over[0].x[at], abs=1 / RATE_HZ)
    divided = bent().divided[:, 3, sample - 1 : sample + 2]
    for curve, around in zip(over[3:], divided, strict=True):
        assert around.min() - 0.5 < curve.y[at] < around.max() + 0.5


def test_dots_stand_at_what_was_found_and_lines_at_what_would_be_straight():
    fits = bent()
    growth, straight = linearity.diagrams_of_proportion(
        fits, ROWS, TIME_S, None, linearity.of_amplitudes("V")
    )[1:]
    assert growth.x.title == "Strength (V)"
    for rank, row in enumerate(ROWS):
        line, dots = growth.curves[2 * rank : 2 * rank + 2]
        np.testing.assert_array_equal(line.y, fits.line[:, row])
        np.testing.assert_array_equal(dots.y, fits.rms[:, row])
        assert (line.width_px > 0.0, dots.width_px) == (True, 0.0)
        np.testing.assert_array_equal(straight.curves[rank].y, fits.adjusted_r2[row])
    assert growth.y.shown[1] >= fits.rms[:, ROWS].max()
    assert growth.x.shown[1] >= RATIOS[-1]
    assert straight.x.shown[1] >= fits.frequency_hz[-1]


def test_a_response_without_a_frequency_in_its_band_has_no_straightness_to_tell():
    short = RATIOS[:, None, None] * responses(30)
    fits = proportion(RATIOS, short, RATE_HZ, (3.0, 5.0))
    assert "R²" not in linearity.proportion_text(fits)
    *_, straight = linearity.diagrams_of_proportion(
        fits, ROWS, TIME_S[:30], None, linearity.of_amplitudes("×")
    )
    assert straight.x.shown[1] > 0.0
    least = np.nanmin(bent().adjusted_r2)
    assert f"R² in bands of 2 Hz ≥ {least:.6f}" in linearity.proportion_text(bent())


def test_the_sum_is_wide_below_the_joint_response_and_they_are_held_against_each_other():
    parts = responses(), 0.5 * responses()[::-1]
    joint = np.tanh(sum(parts))
    fits = superposition(parts, joint)
    over, against = linearity.diagrams_of_superposition(fits, ROWS, TIME_S, (0.1, 0.2))
    first, end = linearity.part_of(TIME_S, joint, (0.1, 0.2))
    for rank, row in enumerate(ROWS):
        wide, thin = over.curves[2 * rank : 2 * rank + 2]
        assert wide.width_px > thin.width_px
        assert np.abs(wide.y).max() > 1.0 > np.abs(thin.y).max() - 0.5
        assert np.corrcoef(wide.y, thin.y)[0, 1] < 0.99
        dots = against.curves[rank]
        np.testing.assert_array_equal(dots.x, fits.separate[row, first:end])
        np.testing.assert_array_equal(dots.y, joint[row, first:end])
    assert against.x.title.startswith("Sum")
    assert against.y.title.startswith("Joint")


def test_bands_and_rms_are_copied_by_strength_output_and_axis():
    fits = bent()
    text = linearity.table_text(
        fits, (20, 26), ("x", "z"), linearity.of_amplitudes("m/s²"), bands=True
    )
    head, *rows = (line.split("\t") for line in text.splitlines())
    columns = dict(zip(head, np.array(rows, float).T, strict=True))
    np.testing.assert_allclose(columns["frequency_hz"], fits.frequency_hz)
    for level, strength in enumerate(RATIOS):
        column = columns[f"band_rms_26_z_m_per_s2 at strength {strength:g}"]
        np.testing.assert_allclose(column, fits.band_rms[level, 3])
    np.testing.assert_allclose(columns["adjusted_r2_20_z"], fits.adjusted_r2[1])
    head, *rows = linearity.table_text(
        fits, (20, 26), ("x", "z"), linearity.of_amplitudes("m/s²")
    ).splitlines()
    names = (f"rms_{channel}_m_per_s2" for channel in ("20_x", "20_z", "26_x", "26_z"))
    assert head.split("\t") == ["strength", *names]
    np.testing.assert_allclose(np.loadtxt(rows), np.column_stack((RATIOS, fits.rms)))


TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.1)
OUTPUTS = (20, 26)


def played(*places, amplitude=1.0):
    tracks = tuple(ss.track(place, TONE, amplitude=amplitude) for place in places)
    return ss.Design(limb="synthetic-1", inputs=tracks, scaling="probe")


def snapshots_of(*designs):
    return tuple(Snapshot(number=k, design=design) for k, design in enumerate(designs, 1))


STRENGTHS = [played(8, amplitude=k) for k in (1.0, 2.0, 4.0)]
PARTS = [played(8), played(13), played(8, 13)]


@pytest.fixture
def show(open_window, qtbot):
    """A window on the last of designs that are kept, with the panel in front."""

    def opened(designs, **view):
        looked = View(**{"axes": "z", "outputs": OUTPUTS, "levels_matched": False, **view})
        window = open_window(designs[-1], replace(looked, snapshots=snapshots_of(*designs)))
        panel = analysis(window, "linearity")
        qtbot.waitUntil(lambda: settled(window, panel), timeout=30_000)
        return window, panel

    return opened


def settled(window, panel):
    QApplication.processEvents()
    return not window.engine.busy and panel.figure.message != "Computing…"


def test_strengths_of_one_stimulus_lie_on_each_other_once_divided(show):
    _, panel = show(STRENGTHS)
    assert panel.figure.message == ""
    assert isinstance(panel.result, Proportion)
    assert panel.result.strengths.tolist() == [1.0, 2.0, 4.0]
    assert "3 strengths" in panel.note_label.whole
    over, growth, straight = panel.picture.diagrams
    assert len(over.curves) == 3 * len(OUTPUTS)
    assert np.ptp([curve.y for curve in over.curves[:3]], axis=0).max() < 1e-9
    assert growth.x.title == "Strength (m/s²)"
    assert straight.y.title == "Adjusted R²"
    assert "synthetic" in panel.about.whole
    panel.grab()
    # Below the pointer are numbers.
    frame = panel.picture.placed[1][1].frame
    at = panel.picture.placed[1][0] + frame.center()
    assert "Strength (m/s²): 2.1" in panel.picture.read(at)
    assert panel.picture.read(QPointF(-5.0, -5.0)) == ""


def test_snapshots_count_alone_where_the_design_in_the_window_is_something_else(show, qtbot):
    window, panel = show(PARTS)
    head, *rows = panel.table_text().splitlines()
    assert head == "output\taxis\tpearson_r"
    assert [row.split("\t")[:2] for row in rows] == [["20", "z"], ["26", "z"]]
    assert [float(row.split("\t")[2]) for row in rows] == pytest.approx([1.0, 1.0])
    assert "Sum of separate responses" in panel.note_label.whole
    assert "alone" not in panel.about.whole
    result = panel.result
    window.document.edit("Elsewhere", played(3))
    qtbot.waitUntil(lambda: "snapshots alone" in panel.about.whole)
    assert isinstance(panel.result, Superposition)
    assert panel.result.largest_difference == result.largest_difference
    assert panel.figure.message == ""
    window.document.edit("Again", PARTS[0])
    qtbot.waitUntil(lambda: "alone" not in panel.about.whole)


def test_while_snapshots_are_computed_anew_what_is_drawn_is_told_to_be_of_others(show, qtbot):
    window, panel = show(STRENGTHS)
    assert not panel.is_stale
    panel.show_snapshots([Compared(snapshot=snapshot) for snapshot in snapshots_of(*STRENGTHS)])
    qtbot.waitUntil(lambda: panel.is_stale)
    assert panel.result is not None
    assert not window.panel("analysis").copy.isEnabled()
    window.document.look(replace(window.document.view, outputs=(30,)))
    qtbot.waitUntil(lambda: not panel.is_stale)
    assert window.panel("analysis").copy.isEnabled()
    panel.show_snapshots([Compared(snapshot=snapshot) for snapshot in snapshots_of(*STRENGTHS)])
    qtbot.waitUntil(lambda: panel.is_stale)
    panel.show_snapshots([])
    assert "with Ctrl+Shift+1 to Ctrl+Shift+4" in panel.figure.message
    assert not panel.is_stale


def test_a_part_is_the_same_whether_the_delay_is_removed_or_not(show, qtbot):
    window, panel = show(PARTS, time_range_s=(0.06, 0.08))
    before = panel.picture.diagrams[0].curves
    # Traces have the window say the instants that its time axes have.
    window.docks["traces"].bring_forward()
    for removed in (True, False):
        window.document.apply(remove_delay(window.document.design, window.document.view, removed))
        shown = (0.008, 0.028) if removed else (0.06, 0.08)
        axis = pytest.approx(shown, abs=1e-3)
        qtbot.waitUntil(lambda axis=axis: panel.picture.diagrams[0].x.shown == axis)
        qtbot.waitUntil(lambda: settled(window, panel))
        assert panel.picture.diagrams[0].x.shown == axis
        now = panel.picture.diagrams[0].curves
        for curve, other in zip(before, now, strict=True):
            np.testing.assert_allclose(curve.y, other.y)


def test_what_cannot_be_held_against_each_other_says_what_to_store(show, qtbot):
    window, panel = show([played(8), played(9)])
    assert "with Ctrl+Shift+1 to Ctrl+Shift+4" in panel.figure.message
    assert panel.table_text() == ""
    assert not window.panel("analysis").copy.isEnabled()
    document = window.document
    document.look(replace(document.view, snapshots=snapshots_of(*PARTS)))
    document.edit("Both", PARTS[2])
    qtbot.waitUntil(lambda: panel.result is not None, timeout=30_000)


def test_what_is_too_long_for_a_picture_says_where_it_is_checked(show, monkeypatch):
    monkeypatch.setattr("skinsource_gui.panels.analysis.linearity._MOST_VALUES", 1000)
    _, panel = show(STRENGTHS)
    assert panel.figure.message.startswith("Too long to show here")
    assert panel.result is None


def test_strengths_on_a_limb_that_is_missing_say_so(show):
    _, panel = show([replace(design, limb="lab-9", limb_digest="0" * 64) for design in STRENGTHS])
    assert "lab-9" in panel.figure.message


def test_adjusted_r2_is_told_of_all_outputs(show, qtbot):
    window, panel = show(STRENGTHS)
    assert [curve.rank for curve in panel.picture.diagrams[2].curves] == [0, 1]
    switch(window, panel, qtbot, "every_output")
    qtbot.waitUntil(lambda: panel.all_outputs is not None, timeout=30_000)
    assert settings_of(window.document.view, "linearity", LinearitySettings).every_output
    assert panel.all_outputs.adjusted_r2.shape[:2] == (72, 1)
    straight = panel.picture.diagrams[2]
    assert [curve.label for curve in straight.curves] == ["median", "worst"]
    assert straight.y.title == "Adjusted R², all outputs"
    assert "of all 72 outputs" in panel.note_label.whole
    head, *rows = (line.split("\t") for line in panel.table_text().splitlines())
    assert head == ["frequency_hz", *(f"adjusted_r2_{k}_z" for k in range(1, 73))]
    assert len(rows) == panel.all_outputs.frequency_hz.size
    panel.grab()
    switch(window, panel, qtbot, "every_output")
    qtbot.waitUntil(lambda: panel.all_outputs is None)
    assert [curve.rank for curve in panel.picture.diagrams[2].curves] == [0, 1]


def test_the_worst_of_all_outputs_is_drawn_below_their_median():
    fits = bent()
    n_bins = fits.frequency_hz.size
    every = np.stack([np.full(n_bins, ratio) for ratio in (1.0, 0.98, 0.5)])
    every[:, 0] = np.nan
    *_, straight = linearity.diagrams_of_proportion(
        fits, ROWS, TIME_S, None, linearity.of_amplitudes("V"), all_outputs=every
    )
    median, worst = straight.curves
    assert median.y == pytest.approx(0.98)
    assert worst.y == pytest.approx(0.5)
    # Where nothing is heard there is no line that could be straight.
    assert worst.x == pytest.approx(fits.frequency_hz[1:])
    silent = np.full((3, n_bins), np.nan)
    *_, straight = linearity.diagrams_of_proportion(
        fits, ROWS, TIME_S, None, linearity.of_amplitudes("V"), all_outputs=silent
    )
    assert straight.curves == ()


def switch(window, panel, qtbot, name):
    QTest.mouseClick(getattr(panel, name), Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: settled(window, panel))


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
    assert over.y.title == "Normalised (m/s² per mm/s)"
    assert growth.x.title == "Probe velocity (mm/s)"
    assert growth.curves[0].x == pytest.approx(1e3 * np.array(fastest))
    assert over.curves[0].y * 1e3 * fastest[0] == pytest.approx(divided)
    head, *rows = panel.table_text().splitlines()
    assert head.startswith("probe_velocity_m_per_s\trms_20_z_m_per_s2")
    assert [float(row.split("\t")[0]) for row in rows] == pytest.approx(fastest)


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
    origin, axes = panel.picture.placed[1]
    assert "In the band (m/s²)" in panel.picture.read(origin + axes.frame.center())


def test_the_switches_compute_no_prediction_and_are_about_strengths(show, requests, qtbot):
    window, panel = show(STRENGTHS)
    requests.clear()
    traces = panel._drawn[-len(STRENGTHS) :]
    for name in ("velocity", "bands", "velocity", "bands"):
        before = panel.picture.diagrams
        switch(window, panel, qtbot, name)
        assert panel.picture.diagrams is not before
        drawn = panel._drawn[-len(STRENGTHS) :]
        assert all(trace is other for trace, other in zip(traces, drawn, strict=True))
    assert not any("snapshot" in request.slot for request in requests)
    window.document.look(replace(window.document.view, snapshots=snapshots_of(*PARTS)))
    window.document.edit("Both", PARTS[2])
    qtbot.waitUntil(lambda: len(panel.picture.diagrams) == 2, timeout=30_000)
    assert not panel.velocity.isVisible()
    assert not panel.bands.isVisible()


X = Axis(shown=(0.5, 8.0), title="Strength (m/s²)", log=True)
Y = Axis(shown=(1e-3, 1.0), title="In the band (m/s²)", log=True)
CURVES = tuple(
    linearity.Curve(
        x=np.array([0.75, 6.0]),
        y=np.array([0.1, 0.8]) / 1.3**k,
        rank=k % 2,
        width_px=1.0,
        label=f"{50 * 2 ** (k // 2)} Hz",
    )
    for k in range(8)
)


@pytest.fixture
def painter(qapp):
    del qapp
    image = QImage(400, 300, QImage.Format.Format_RGB32)
    painter = QPainter(image)
    yield painter
    painter.end()


@pytest.mark.parametrize("size", [(160, 90), (230, 130), (500, 400)])
@pytest.mark.parametrize("letters_px", [11, 14])
@pytest.mark.parametrize("height", [1.0, 0.008], ids=["high", "at the bottom"])
def test_labels_of_bands_are_whole_inside_the_plot_and_apart(painter, size, letters_px, height):
    curves = tuple(replace(curve, y=height * curve.y) for curve in CURVES)
    font = QFont(painter.font())
    font.setPixelSize(letters_px)
    metrics, room = QFontMetricsF(font), QRectF(0, 0, *size)
    axes = fitted_axes(room, X, Y, metrics)
    axes = fitted_axes(room, linearity.x_with_room_for_labels(axes, curves, metrics), Y, metrics)
    letters, places = linearity.places_of_labels(axes, curves, font)
    line = QFontMetricsF(letters).height()
    if size[1] > 200:
        assert len(places) == len(curves)
    for place, curve in places:
        assert QFontMetricsF(letters).horizontalAdvance(curve.label) <= place.width()
        assert place.right() <= axes.frame.right()
        assert axes.frame.top() - 0.1 * line <= place.top()
        assert place.bottom() <= axes.frame.bottom() + 0.1 * line
    assert np.diff([place.top() for place, _ in places]).min() >= 0.85 * line
    # They stand in the order of their curves.
    ends = [curve.y[-1] for _, curve in places]
    assert ends == sorted(ends, reverse=True)


def test_a_legend_has_all_outputs_or_counts_those_without_room(painter):
    assert legend_texts((20,), 400.0, painter) == ["Output", "20"]
    assert legend_texts((20, 26), 400.0, painter) == ["Outputs", "20", "26"]
    few = legend_texts(tuple(range(1, 60)), 300.0, painter)
    assert few[-1] == f"+{59 - len(few) + 2}"


def test_the_picture_says_which_output_has_which_colour(show, tmp_path):
    window, panel = show(STRENGTHS)
    assert panel.picture.outputs == OUTPUTS
    path = tmp_path / "a.svg"
    save_drawing(path, window.pictures.picture_of("analysis/linearity").draw, 900, 500)
    texts = texts_of(path)
    for word in ("Outputs", *map(str, OUTPUTS)):
        assert word in texts
    drawing = path.read_text("utf-8").lower()
    for rank in range(len(OUTPUTS)):
        assert LIGHT.output_colour(rank).name() in drawing
