from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QApplication, QLabel, QToolButton

from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.effects.level import Fade
from skinsource.design.signal_path import UnplayableInput
from skinsource.design.waveforms.pulses import Tap
from skinsource.design.waveforms.samples import Recording
from skinsource.design.waveforms.tones import Tone
from skinsource.specs.samples import Samples
from skinsource_gui.panels.timeline.head_row import row_places
from skinsource_gui.qt.theme import DARK, apply_theme
from tests.gui.timeline.bench import PLACES, Bench, click, design_of, results_of
from tests.gui.timeline.lanes_bench import LanesBench


def test_there_is_one_row_for_each_input_in_the_order_of_the_design(bench):
    assert [row.state.track.location for row in bench.rows.rows] == list(PLACES)
    assert "7, Digit II, pad: Tone 100 Hz" in bench.row(0).accessibleName()


def test_an_empty_list_says_what_to_do(bench):
    bench.show(Design(limb="synthetic-1"))
    label = bench.panel.findChild(QLabel, "inputs_empty")
    assert label.isVisible()
    assert label.text() == "Click a place on the hand to add a track"
    assert bench.rows.rows == ()


def test_a_click_on_a_row_selects_its_input_and_takes_the_keys(bench):
    click(bench.row(2), QPoint(60, 10))
    assert bench.view.selected_input == 3
    assert bench.rows.hasFocus()
    assert bench.edits == []


def test_the_arrow_keys_select_and_stop_at_the_ends(bench):
    bench.key(Qt.Key.Key_Up)
    assert bench.view.selected_input == 1
    for _ in range(5):
        bench.key(Qt.Key.Key_Down)
    assert bench.view.selected_input == 3
    bench.key(Qt.Key.Key_Home)
    assert bench.view.selected_input == 1


def test_the_arrow_keys_begin_at_the_ends_where_nothing_is_selected(qtbot):
    bench = Bench(qtbot, design_of(*PLACES), selected=-1)
    bench.key(Qt.Key.Key_Down)
    assert bench.view.selected_input == 1


def test_a_selection_that_does_not_exist_is_none(qtbot):
    bench = Bench(qtbot, design_of(*PLACES), selected=7)
    assert bench.rows.last_row is None
    bench.key(Qt.Key.Key_Delete)
    assert bench.edits == []


def test_the_keys_m_and_s_mute_and_solo_the_selected_input(bench):
    bench.key(Qt.Key.Key_M)
    assert bench.design.inputs[0].muted
    bench.key(Qt.Key.Key_M)
    assert not bench.design.inputs[0].muted
    bench.key(Qt.Key.Key_S)
    assert bench.design.inputs[0].solo
    assert bench.labels == [
        "Mute input at 7 (II pad)",
        "Unmute input at 7 (II pad)",
        "Solo input at 7 (II pad)",
    ]
    assert bench.row(0).solo.isChecked()


def test_the_keys_m_and_s_also_work_while_a_number_has_the_focus(bench):
    click(bench.row(1).amplitude)
    bench.key(Qt.Key.Key_M)
    assert [track.muted for track in bench.design.inputs] == [False, True, False]


def test_buttons_act_on_their_own_row_and_leave_the_selection(bench):
    click(bench.row(1).mute)
    click(bench.row(2).solo)
    assert bench.design.inputs[1].muted
    assert bench.design.inputs[2].solo
    assert bench.view.selected_input == 1


def test_what_is_not_heard_is_shown_as_silent(bench):
    bench.show(bench.design.with_input(1, muted=True))
    assert [row.state.silent for row in bench.rows.rows] == [False, True, False]
    bench.show(bench.design.with_input(1, solo=True))
    assert [row.state.silent for row in bench.rows.rows] == [True, True, True]
    bench.show(bench.design.with_input(0, solo=True))
    assert [row.state.silent for row in bench.rows.rows] == [False, True, True]


@pytest.mark.parametrize("scale", [1.0, 1.3, 2.0])
def test_heads_and_the_buttons_above_them_have_room_for_larger_text(bench, scale):
    font = bench.panel.font()
    font.setPointSizeF(font.pointSizeF() * scale)
    bench.panel.setFont(font)
    QApplication.processEvents()
    buttons = bench.panel.findChildren(QToolButton)
    snap = next(button for button in buttons if button.objectName() == "timeline_snap")
    assert snap.width() >= snap.sizeHint().width()
    places = row_places(bench.row(0).width(), bench.row(0).fontMetrics().height())
    number = bench.row(0).fontMetrics().horizontalAdvance("15")
    assert places.swatch.width() >= number
    assert places.name.left() >= places.swatch.right()


def test_the_head_of_a_recording_that_keeps_its_size_says_the_peak_beside_a_gain(bench):
    first, other = bench.row(0), bench.row(1)
    beside = other.amplitude.geometry()
    samples = Samples(values=4.88 * np.hanning(301), sample_rate_hz=1300.0, unit="m/s²")
    clip = replace(bench.design.inputs[0].clips[0], waveform=Recording(samples))
    bench.show(bench.design.with_input(0, clips=(clip,), amplitude=-0.5))
    assert (first.amplitude.spec.label, first.amplitude.spec.unit) == ("Gain", "")
    assert first.amplitude.text() == "\N{MINUS SIGN}0.5"
    assert first.state.peak == "2.44 m/s²"
    assert "Peak 2.44 m/s²" in first.toolTip()
    places = row_places(first.width(), first.fontMetrics().height(), peak=True)
    assert first.amplitude.geometry() == places.amplitude
    assert places.amplitude.right() < places.peak.left()
    assert places.peak.right() < places.remove.left()
    assert first.fontMetrics().horizontalAdvance(first.state.peak) <= places.peak.width()
    assert (other.amplitude.spec.unit, other.amplitude.geometry()) == ("m/s²", beside)
    bench.show(bench.design.with_clip(clip.id, waveform=Tone()))
    assert first.amplitude.spec.unit == "m/s²"
    assert first.amplitude.geometry() == beside


def test_a_place_that_is_not_on_this_hand_is_named(bench):
    bench.show(design_of(7, 25))
    row = bench.row(1)
    assert row.accessibleName().startswith("Input at 25, Place 25, not on this hand: Tone")
    assert not bench.panel.grab().isNull()


ALT, NONE = Qt.KeyboardModifier.AltModifier, Qt.KeyboardModifier.NoModifier


TONE = Tone(100.0, 0.0, 0.2)


@pytest.fixture
def four_lanes(qtbot):
    made = LanesBench(qtbot)
    made.panel.resize(1000, 400)
    clips = (Clip(onset_s=0.1, waveform=TONE), Clip(onset_s=0.5, waveform=Tap()))
    tracks = tuple(Input(location=1 + k, clips=clips) for k in range(4))
    made.view = replace(made.view, time_range_s=(0.0, 1.2), selected_inputs=())
    made.show(Design(limb="synthetic-1", inputs=tracks))
    made.panel.show_results(results_of(made.design))
    settled(made)
    return made


def settled(four_lanes):
    """Have everything painted that is to be painted; how many lanes that were."""
    before = four_lanes.lanes.item.painted_lanes
    QApplication.processEvents()
    four_lanes.lanes.viewport().repaint()
    return four_lanes.lanes.item.painted_lanes - before


def picture(four_lanes):
    return four_lanes.lanes.viewport().grab().toImage()


def changed(four_lanes, index, **changes):
    """Show a design in which the first clip of a track is something else."""
    clip = four_lanes.design.inputs[index].clips[0]
    four_lanes.show(four_lanes.design.with_clip(clip.id, **changes))


def test_a_lane_that_cannot_be_played_is_framed_and_no_other(four_lanes):
    before = picture(four_lanes)
    (unplayable, *_) = four_lanes.design.inputs
    four_lanes.panel.show_unplayable((UnplayableInput(unplayable.id, "Too low. Choose another."),))
    after = picture(four_lanes)
    frames = [box.rect for box in four_lanes.lanes.content.boxes]
    reddened = [
        QColor(after.pixel(round(rect.center().x()), round(rect.top()))).red()
        > QColor(before.pixel(round(rect.center().x()), round(rect.top()))).red()
        for rect in frames
    ]
    assert reddened == [True, True] + [False] * (len(frames) - 2)


def test_an_edit_of_one_clip_repaints_one_lane(four_lanes):
    changed(four_lanes, 1, onset_s=0.15)
    assert settled(four_lanes) == 1


def test_results_repaint_the_lane_whose_samples_are_new(four_lanes):
    results = results_of(four_lanes.design)
    four_lanes.panel.show_results(results)
    assert settled(four_lanes) == 4
    four_lanes.panel.show_results(dict(results))
    assert settled(four_lanes) == 0
    first, *others = results["clip_waveforms"]
    results["clip_waveforms"] = ((first[0] * 0.5, first[1]), *others)
    four_lanes.panel.show_results(results)
    assert settled(four_lanes) == 1


def test_a_drag_of_a_clip_repaints_its_lane_at_each_move(four_lanes):
    start = four_lanes.box(3).center()
    four_lanes.drag(start, start + QPointF(10, 0), ALT, release=False, steps=1)
    settled(four_lanes)
    four_lanes.lanes.mouse.move(start + QPointF(40, 0), ALT)
    assert settled(four_lanes) == 1
    four_lanes.lanes.mouse.move(start + QPointF(80, 0), ALT)
    assert settled(four_lanes) == 1


EDITS = {
    "clip moved over another": lambda bench: changed(bench, 1, onset_s=0.4),
    "clip stronger than all": lambda bench: changed(bench, 2, gain=3.0),
    "clip muted": lambda bench: changed(bench, 0, muted=True),
    "clip renamed": lambda bench: changed(bench, 0, label="knock"),
    "clip faded": lambda bench: changed(bench, 3, effects=(Fade(),)),
    "track muted": lambda bench: bench.show(bench.design.with_input(2, muted=True)),
    "track alone": lambda bench: bench.show(bench.design.with_input(1, solo=True)),
    "another colour": lambda bench: bench.show(bench.design.with_input(1, colour=7)),
    "clip added": lambda bench: bench.show(
        bench.design.with_input(
            3, clips=(*bench.design.inputs[3].clips, Clip(onset_s=0.8, waveform=TONE))
        )
    ),
    "no clips": lambda bench: bench.show(bench.design.with_input(0, clips=())),
    "loop": lambda bench: bench.show(replace(bench.design, loop_s=(0.2, 0.7))),
    "clip selected": lambda bench: bench._look(replace(bench.view, selected_clips=(3,))),
    "track selected": lambda bench: bench._look(replace(bench.view, selected_inputs=(2,))),
    "other times": lambda bench: bench._look(replace(bench.view, time_range_s=(0.0, 0.9))),
    "hovered": lambda bench: bench.lanes.item.show_hovered(3),
    "no samples": lambda bench: bench.panel.show_problem("No limb."),
    "theme": lambda bench: apply_theme(QApplication.instance(), DARK),
}


def test_a_clip_that_the_inspector_showed_already_is_seen_to_be_selected(four_lanes):
    four_lanes._look(replace(four_lanes.view, selected_inputs=(2,)))
    settled(four_lanes)
    shown = picture(four_lanes)
    four_lanes._look(replace(four_lanes.view, selected_clips=(3,)))
    assert settled(four_lanes) == 1
    assert picture(four_lanes) != shown


@pytest.mark.parametrize("name", EDITS)
def test_what_was_not_repainted_looks_as_if_everything_were(four_lanes, name):
    before = picture(four_lanes)
    EDITS[name](four_lanes)
    settled(four_lanes)
    zoomed_picture = picture(four_lanes)
    assert zoomed_picture != before
    four_lanes.lanes.item.update()
    settled(four_lanes)
    assert zoomed_picture == picture(four_lanes)
