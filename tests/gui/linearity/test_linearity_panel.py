"""Snapshots held against each other: strengths in proportion, inputs that add up."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QFontInfo, QFontMetricsF
from PySide6.QtWidgets import QApplication

import skinsource as ss
from skinsource.design.comparing import Snapshot
from skinsource.design.edits.setup import remove_delay
from skinsource.design.view import View
from skinsource.studies.checking import Proportion, Superposition
from skinsource_gui.panels.figure_panel import SILENT
from skinsource_gui.panels.linearity.diagram import font_in
from skinsource_gui.qt.theme import scaled
from skinsource_gui.state.compared import Compared

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
def show(make_window, qtbot):
    """A window on the last of designs that are kept, with the panel in front."""

    def opened(designs, **view):
        looked = View(**{"axes": "z", "outputs": OUTPUTS, "levels_matched": False, **view})
        window = make_window(designs[-1], replace(looked, snapshots=snapshots_of(*designs)))
        window.docks["linearity"].bring_forward()
        panel = window.panel("linearity")
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
    assert panel.result.largest_difference < 1e-9
    assert "3 strengths" in panel.note_label.text
    over, growth, straight = panel.picture.diagrams
    assert len(over.curves) == 3 * len(OUTPUTS)
    assert np.ptp([curve.y for curve in over.curves[:3]], axis=0).max() < 1e-9
    assert growth.x.title == "Strength (m/s²)"
    assert straight.y.title == "Adjusted R²"
    assert "synthetic" in panel.about.text
    panel.grab()
    # Below the pointer are numbers.
    frame = panel.picture._placed[1][1].frame
    at = panel.picture._placed[1][0] + frame.center()
    assert "Strength (m/s²): 2.1" in panel.picture.read(at)
    assert panel.picture.read(QPointF(-5.0, -5.0)) == ""


def test_inputs_alone_add_up_to_all_of_them(show):
    _, panel = show(PARTS)
    assert isinstance(panel.result, Superposition)
    assert panel.result.largest_difference < 1e-9
    assert "Sum of separate and joint" in panel.note_label.text
    panel.grab()
    head, *rows = panel.table().splitlines()
    assert head == "output\taxis\tpearson_r"
    assert [row.split("\t")[:2] for row in rows] == [["20", "z"], ["26", "z"]]
    assert [float(row.split("\t")[2]) for row in rows] == pytest.approx([1.0, 1.0])


def test_the_design_in_the_window_counts_though_it_is_no_snapshot(show, qtbot):
    window, panel = show(STRENGTHS)
    document = window.document
    document.edit("Louder", document.design.with_input(0, amplitude=9.0))
    qtbot.waitUntil(lambda: panel.result is not None and len(panel.result.strengths) == 4)
    assert panel.result.strengths[-1] == 9.0
    assert len(panel.table().splitlines()) == 5


@pytest.mark.parametrize(("designs", "kind"), [(STRENGTHS, Proportion), (PARTS, Superposition)])
def test_snapshots_count_alone_where_the_design_in_the_window_is_something_else(
    show, qtbot, designs, kind
):
    window, panel = show(designs)
    assert "alone" not in panel.about.text
    result = panel.result
    window.document.edit("Elsewhere", played(3))
    qtbot.waitUntil(lambda: "snapshots alone" in panel.about.text)
    assert isinstance(panel.result, kind)
    assert panel.result.largest_difference == result.largest_difference
    assert panel.figure.message == ""
    window.document.edit("Again", designs[0])
    qtbot.waitUntil(lambda: "alone" not in panel.about.text)


def test_while_snapshots_are_computed_anew_what_is_drawn_is_told_to_be_of_others(show, qtbot):
    window, panel = show(STRENGTHS)
    assert not panel.is_stale
    panel.show_snapshots([Compared(snapshot=snapshot) for snapshot in snapshots_of(*STRENGTHS)])
    qtbot.waitUntil(lambda: panel.is_stale)
    assert panel.result is not None
    assert not panel.copy.isEnabled()
    window.document.look(replace(window.document.view, outputs=(30,)))
    qtbot.waitUntil(lambda: not panel.is_stale)
    assert panel.copy.isEnabled()
    panel.show_snapshots([Compared(snapshot=snapshot) for snapshot in snapshots_of(*STRENGTHS)])
    qtbot.waitUntil(lambda: panel.is_stale)
    panel.show_snapshots([])
    assert "with Ctrl+1 to Ctrl+4" in panel.figure.message
    assert not panel.is_stale


def test_words_above_the_diagrams_have_a_row_of_their_own(show):
    _, panel = show(STRENGTHS)
    switches = max(widget.geometry().bottom() for widget in (panel.bands, panel.copy))
    assert switches < panel.about.y()
    assert panel.about.geometry().bottom() < panel.picture.y()
    assert panel.about.width() > 0.9 * panel.width()


def test_other_outputs_are_shown_as_soon_as_they_are_selected(show, qtbot):
    window, panel = show(STRENGTHS)
    window.document.look(replace(window.document.view, outputs=(30,)))
    qtbot.waitUntil(lambda: len(panel.picture.diagrams[0].curves) == 3)
    assert panel.result.rms.shape == (3, 1)
    window.document.look(replace(window.document.view, outputs=()))
    qtbot.waitUntil(lambda: "elect" in panel.figure.message)
    assert not panel.copy.isEnabled()


def test_the_part_to_which_traces_are_zoomed_is_drawn(show, qtbot):
    window, panel = show(PARTS)
    window.document.look(replace(window.document.view, time_range_s=(0.08, 0.1)))
    qtbot.waitUntil(
        lambda: panel.picture.diagrams[0].x.shown == pytest.approx((0.08, 0.1), abs=1e-3)
    )


@pytest.mark.parametrize("designs", [STRENGTHS, PARTS])
def test_a_part_is_the_same_whether_the_delay_is_removed_or_not(show, qtbot, designs):
    window, panel = show(designs, time_range_s=(0.06, 0.08))
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


def test_rms_are_copied_by_strength_output_and_axis(show):
    _, panel = show(STRENGTHS, axes="xz")
    head, *rows = (line.split("\t") for line in panel.table().splitlines())
    columns = [f"rms_{output}_{axis}_m_per_s2" for output in OUTPUTS for axis in "xz"]
    assert head == ["strength", *columns]
    table = np.array(rows, float)
    traces = ss.evaluate(STRENGTHS[0], "axis_traces", view=View(axes="xz", outputs=OUTPUTS))
    rms = np.sqrt(np.mean(traces["axis_traces"] ** 2, axis=-1)).ravel()
    np.testing.assert_allclose(table[:, 0], [1.0, 2.0, 4.0])
    np.testing.assert_allclose(table[:, 1:], table[:, :1] * rms, rtol=1e-6)


def test_actuators_that_are_switched_off_make_no_volts(show):
    coil = ss.ActuatorAt(model=ss.actuators.load("example-voice-coil"))
    off = ss.Actuation(actuators=(coil,), on=False)
    _, panel = show([replace(design, actuation=off) for design in STRENGTHS])
    assert panel.picture.diagrams[1].x.title == "Strength (m/s²)"


def test_what_cannot_be_held_against_each_other_says_what_to_store(show, qtbot):
    window, panel = show([played(8), played(9)])
    assert "with Ctrl+1 to Ctrl+4" in panel.figure.message
    assert panel.table() == ""
    assert not panel.copy.isEnabled()
    document = window.document
    document.look(replace(document.view, snapshots=snapshots_of(*PARTS)))
    document.edit("Both", PARTS[2])
    qtbot.waitUntil(lambda: panel.result is not None, timeout=30_000)


def test_of_several_axes_z_is_drawn_and_all_are_counted(show):
    _, panel = show(STRENGTHS, axes="xyz")
    assert panel.result.rms.shape == (3, 3 * len(OUTPUTS))
    growth = panel.picture.diagrams[1].curves
    for rank, row in enumerate((2, 5)):
        np.testing.assert_array_equal(growth[2 * rank + 1].y, panel.result.rms[:, row])
    assert "Along z" in panel.about.text


def test_what_is_too_long_for_a_picture_says_where_it_is_checked(show, monkeypatch):
    monkeypatch.setattr("skinsource_gui.panels.linearity.panel._MOST_VALUES", 1000)
    _, panel = show(STRENGTHS)
    assert panel.figure.message.startswith("Too long to be shown here")
    assert panel.result is None


def test_what_plays_nothing_is_said_to_be_silent(show):
    still = [replace(design, inputs=(replace(design.inputs[0], clips=()),)) for design in STRENGTHS]
    _, panel = show(still)
    assert panel.figure.message == SILENT


def test_strengths_on_a_limb_that_is_missing_say_so(show):
    _, panel = show([replace(design, limb="lab-9", limb_digest="0" * 64) for design in STRENGTHS])
    assert "lab-9" in panel.figure.message


def test_hidden_it_has_no_traces_computed(show, qtbot):
    window, _ = show(STRENGTHS)
    asked = []
    ask = window.engine.request
    window.engine.request = lambda request: (asked.append(request.slot.name), ask(request))
    window.docks["linearity"].hide()
    window.document.look(replace(window.document.view, outputs=(30, 31)))
    qtbot.waitUntil(lambda: not window.engine.busy)
    assert not any("snapshot" in request for request in asked)


@pytest.mark.parametrize("name", ["5A", "5D", "5F"])
def test_scenes_of_linearity_open_with_it(make_window, qtbot, name):
    window = make_window()
    window.scenes.open(name)
    assert window.docks["linearity"].in_sight
    panel = window.panel("linearity")
    qtbot.waitUntil(lambda: panel.result is not None, timeout=60_000)
    kind = Superposition if name == "5F" else Proportion
    assert isinstance(panel.result, kind)
    assert panel.result.largest_difference < 1e-9


def test_in_the_largest_letters_those_of_narrow_diagrams_are_smaller_but_can_be_read(qapp):
    font = scaled(qapp.font(), 3.0)
    line, usual_px = QFontMetricsF(font).height(), QFontInfo(qapp.font()).pixelSize()

    def drawn_in(*widths):
        return font_in([QRectF(0, 0, width, 300) for width in widths], font)

    assert drawn_in(20 * line, 10 * line) is font
    seven = QFontMetricsF(drawn_in(20 * line, 7 * line)).height()
    assert seven == pytest.approx(0.7 * line, rel=0.05)
    assert QFontInfo(drawn_in(10.0)).pixelSize() >= usual_px
    small = scaled(qapp.font(), 11.0 / usual_px)
    assert font_in([QRectF(0, 0, 10.0, 300)], small) is small
