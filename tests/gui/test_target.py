"""A target is painted on the skin map; its drives follow, and its panel says how near they come."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QFontMetricsF, QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow, QScrollArea

from skinsource import Clip, Design, Input, View, actuators, edits, load_limb, track
from skinsource.actuators.actuation import Actuation, ActuatorAt
from skinsource.actuators.equalising import RegularisedInverse
from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.design.effects.level import Fade
from skinsource.design.panel_settings import TARGET, TargetSettings, brush_of, with_settings
from skinsource.design.target import Target, is_unsolved, target_in
from skinsource.design.waveforms import Layers, Tap, Tone
from skinsource.inverse.aiming import aim, aim_of, ways
from skinsource.inverse.focusing import Wish
from skinsource_gui.panels.target.panel import TargetPanel, head_text, over_text, row_of
from tests.core.own_limbs.lab_bench import N_INPUTS, installed
from tests.gui.panel_host import PanelHost
from tests.gui.timeline.bench import LanesBench

START = Design(limb="synthetic-1", inputs=(track(7, Tone()),))


@pytest.fixture
def at_target(open_window, qtbot):
    """The studio with the strong brush, and a function that waits until all is solved."""

    def begin(brush="strong", design=START):
        view = with_settings(View(), TARGET, TargetSettings(brush=brush))
        window = open_window(design, view)
        window.workspaces.bring(TARGET)

        def settled():
            qtbot.waitUntil(lambda: not window.aiming.busy, timeout=30_000)
            window.catch_up()

        window.settle_target = settled
        window.wait_until = qtbot.waitUntil
        settled()
        return window

    return begin


def stroke(window, *outputs):
    """Drag over outputs of the map with the left button."""
    skin = window.panel("skin").map
    places = [skin.stage.place_of(output) for output in outputs]
    left, none = Qt.MouseButton.LeftButton, Qt.MouseButton.NoButton
    for kind, at, button in (
        (QEvent.Type.MouseButtonPress, places[0], left),
        *((QEvent.Type.MouseMove, at, none) for at in places[1:]),
        (QEvent.Type.MouseButtonRelease, places[-1], left),
    ):
        held = none if kind == QEvent.Type.MouseButtonRelease else left
        on_screen = QPointF(skin.mapToGlobal(at))
        event = QMouseEvent(kind, at, on_screen, button, held, Qt.KeyboardModifier.NoModifier)
        skin.event(event)
    window.settle_target()


def target_of(window):
    found = target_in(window.document.design)
    return None if found is None else found[1]


def test_a_stroke_paints_outputs_and_its_drives_join_it_in_one_step(at_target):
    window = at_target()
    stroke(window, 28, 29)
    assert target_of(window).strong == (28, 29)
    assert not is_unsolved(window.document.design)
    assert len(window.document.design.inputs) == 16
    assert window.document.undo_stack.count() == 1
    window.document.undo_stack.undo()
    assert window.document.design == START
    window.document.undo_stack.redo()
    assert not is_unsolved(window.document.design)


def test_brushes_paint_strong_quiet_and_free(at_target):
    window = at_target()
    stroke(window, 30)
    window.panel(TARGET).brushes["quiet"].click()
    stroke(window, 19, 20)
    assert (target_of(window).strong, target_of(window).quiet) == ((30,), (19, 20))
    window.panel(TARGET).brushes["erase"].click()
    stroke(window, 20)
    assert target_of(window).quiet == (19,)
    content = window.panel("skin").content
    assert (content.strong, content.quiet) == ((30,), (19,))


def test_t_takes_the_strong_brush_and_puts_it_away(at_target):
    window = at_target("select")
    window.do("aim")
    assert brush_of(window.document.view) == "strong"
    assert window.panel(TARGET).isVisible()
    assert window.actions_by_name["aim"].isChecked()
    window.do("aim")
    assert brush_of(window.document.view) == ""


@pytest.mark.parametrize("panel", ["hand", "skin", "timeline", TARGET])
def test_esc_puts_the_brush_away_wherever_the_keyboard_is(at_target, panel):
    window = at_target()
    window.activateWindow()
    window.docks[panel].enter()
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Escape)
    assert brush_of(window.document.view) == ""


def test_a_panel_in_front_of_the_target_puts_the_brush_away_and_outputs_are_selected(at_target):
    window = at_target()
    window.docks["timeline"].enter()
    assert not window.panel(TARGET).isVisible()
    assert brush_of(window.document.view) == ""
    stroke(window, 30)
    assert target_of(window) is None
    assert window.document.view.outputs == (30,)


def test_a_floating_target_that_is_closed_puts_the_brush_away(qtbot):
    studio, host = QMainWindow(), PanelHost(TargetPanel(), START)
    qtbot.addWidget(studio)
    dock = QDockWidget(studio)
    studio.addDockWidget(Qt.DockWidgetArea.LeftDockWidgetArea, dock)
    dock.setWidget(host.panel)
    dock.setFloating(True)
    studio.show()
    host.show()
    host.panel.brushes["strong"].click()
    assert brush_of(host.view) == "strong"
    dock.close()
    assert brush_of(host.view) == ""


def test_the_keyboard_paints_too(at_target):
    window = at_target()
    skin = window.panel("skin").map
    skin.picker.cursor_output = 30
    QTest.keyClick(skin, Qt.Key.Key_Return)
    window.settle_target()
    assert target_of(window).strong == (30,)


def test_the_table_says_what_three_ways_do(at_target):
    window = at_target()
    panel = window.panel(TARGET)
    assert panel.ways.isHidden()
    assert "paint a strong output" in panel.said.text()
    stroke(window, 30)
    ways = [panel.ways.item(row, 0).text() for row in range(3)]
    assert ways == ["Best input: 12", "Time reversal", "Target"]
    assert panel.ways.item(2, 1).text().endswith("II middle rad.")
    assert panel.ways.item(2, 6).text().endswith("of 40")
    assert not panel.ways.horizontalScrollBar().maximum()
    assert "one actuator does nearly as well." in panel.said.text()
    assert "The rows leave out 1 other track." in panel.said.text()
    document = window.document
    document.apply(edits.remove_inputs(document.design, document.view, document.design.ids[:1]))
    window.settle_target()
    assert "other track" not in panel.said.text()


def test_the_slider_changes_drives_and_is_one_step(at_target):
    window = at_target()
    stroke(window, 30)
    before = target_of(window).drives
    slider = window.panel(TARGET).sharpness
    slider.setSliderDown(True)
    for steps in (50, 55, 60):
        slider.setValue(steps)
        window.settle_target()
    slider.setSliderDown(False)
    assert target_of(window).beta == pytest.approx(1e-3)
    assert target_of(window).drives != before
    assert not is_unsolved(window.document.design)
    assert window.document.undo_stack.count() == 2


def test_while_a_drag_goes_on_nothing_is_judged(at_target, monkeypatch):
    window, unseen = at_target(), []
    stroke(window, 30)
    find = Wish.unseen_contrast_db
    monkeypatch.setattr(Wish, "unseen_contrast_db", lambda *given: unseen.append(1) or find(*given))
    window.aiming.rest.setInterval(10**8)
    slider = window.panel(TARGET).sharpness
    slider.setSliderDown(True)
    for steps in (50, 55, 60):
        slider.setValue(steps)
        window.wait_until(lambda: not is_unsolved(window.document.design))
    assert window.aiming.busy
    assert not unseen
    window.aiming.rest.start(0)
    window.settle_target()
    assert len(unseen) == 1


def test_a_peak_bounds_the_drives_and_says_what_is_reached(at_target):
    window = at_target()
    stroke(window, 30)
    document = window.document
    within = replace(target_of(window), peak=0.15)
    document.apply(edits.change_target(document.design, document.view, within))
    window.settle_target()
    assert max(max(np.abs(drive.values)) for drive in target_of(window).drives) <= 0.15
    panel = window.panel(TARGET)
    assert "Not reachable within a peak of 0.15 m/s²:" in panel.said.text()
    reached = float(panel.about.text().split()[3])
    assert 0.0 < reached < 1.0
    assert f"{reached:.2g} m/s² at most" in panel.said.text()


def test_limits_of_a_rig_are_told_as_soon_as_the_design_has_it(at_target):
    window = at_target()
    stroke(window, 30)
    coil = ActuatorAt(model=actuators.load("example-voice-coil"))
    wired = (RigChannel(place=n, output=n, full_scale_v=1e-6) for n in range(1, 21))
    driven = {"actuation": Actuation(actuators=(coil,), equaliser=RegularisedInverse())}
    document, panel = window.document, window.panel(TARGET)
    document.edit("", replace(document.design, **driven))
    window.settle_target()
    assert "actuator's limits" not in panel.said.text()
    document.edit("", replace(document.design, rig=Rig(channels=tuple(wired))))
    window.settle_target()
    assert "Not reachable within the actuator's limits (place" in panel.said.text()


def test_another_limb_has_other_drives_in_the_same_step(at_target):
    window = at_target()
    stroke(window, 30)
    before, document = target_of(window).drives, window.document
    document.apply(edits.change_limb(document.design, document.view, "synthetic-2"))
    window.settle_target()
    assert target_of(window).drives != before
    assert document.undo_stack.count() == 2
    document.undo_stack.undo()
    assert target_of(window).drives == before
    assert not is_unsolved(document.design)


FADED = Clip(waveform=Tap(), effects=(Fade(out_s=0.01),))


@pytest.mark.parametrize(
    ("clip", "waveform"),
    [(Clip(waveform=Tap(), gain=0.5), Tap()), (replace(FADED, onset_s=0.3), Layers((FADED,)))],
    ids=["plain", "faded"],
)
def test_the_selected_clip_can_be_what_plays(at_target, clip, waveform):
    window = at_target(design=replace(START, inputs=(Input(location=7, clips=(clip,)),)))
    stroke(window, 30)
    window.panel(TARGET).use_clip.click()
    window.settle_target()
    assert target_of(window).waveform == waveform
    assert not is_unsolved(window.document.design)


def test_detached_tracks_stay_as_they_are(at_target):
    window = at_target()
    stroke(window, 30)
    inputs = window.document.design.inputs
    window.panel(TARGET).detach.click()
    assert target_of(window) is None
    assert window.document.design.inputs == inputs


def test_what_cannot_be_solved_plays_nothing_and_says_why(at_target):
    window = at_target()
    stroke(window, 30)
    document = window.document
    document.apply(edits.change_scaling(document.design, document.view, "upstream"))
    window.settle_target()
    assert document.design.inputs == START.inputs
    assert "Choose the scaling Probe acceleration" in window.panel(TARGET).said.text()
    document.apply(edits.change_scaling(document.design, document.view, "probe"))
    window.settle_target()
    assert len(document.design.inputs) == 16


def test_on_a_limb_without_its_axis_a_target_counts_along_all_that_there_are(at_target, user_data):
    installed(axes="x")
    window = at_target(design=Design(limb="lab-1"))
    stroke(window, 3)
    panel = window.panel(TARGET)
    assert target_of(window).places == tuple(range(1, N_INPUTS + 1))
    assert "1 m/s² along x at the strong outputs" in panel.about.text()
    assert panel.people_head.text().endswith("over the loudest other along x")


@pytest.mark.parametrize("limb", ["measured-1", "lab-9"])
def test_of_a_limb_that_is_not_here_the_drives_stay(at_target, limb):
    design = edits.paint_target(START, View(), [30]).design
    solved = aim_of(design).solved(design)
    elsewhere = replace(edits.solve_target(design, View(), solved).design, limb=limb)
    window = at_target(design=elsewhere)
    assert is_unsolved(window.document.design)
    assert window.document.design == elsewhere


@pytest.mark.parametrize(
    ("level_db", "text"),
    [(-3.21, "+3.2 dB"), (4.0, "−4.0 dB"), (-20.1, "> 20 dB")],
)
def test_strong_outputs_are_told_to_be_over_others_by_no_more_than_the_model_is_exact(
    level_db, text
):
    assert over_text(level_db) == text


def test_columns_have_the_signs_of_the_library():
    target = Target(strong=(30,), waveform=Tone(frequency_hz=100.0, duration_s=1.0))
    aimed = aim(target, load_limb("synthetic-1"))
    way, focus = ways(aimed)[2], aimed.focus
    at_tone = int(np.abs(focus.frequencies_hz - 100.0).argmin())
    of_library = focus.loudest_other_db, focus.mean_contrast_db, focus.unseen_contrast_db
    expected = [each[at_tone] for each in (*of_library, focus.contact_db)]
    shown = [text.partition(" dB")[0] for text, _ in row_of(way, "synthetic-1")[1:5]]
    assert [float(text.replace("−", "-")) for text in shown] == pytest.approx(expected, abs=1.0)


def test_other_people_are_beside_it(at_target, preferences):
    window = at_target()
    stroke(window, 30)
    panel = window.panel(TARGET)
    first, *others = panel.people.people
    assert [each.title for each in others] == ["Synthetic 3", "Synthetic 4"]
    assert panel.people_head.text() == "Same drives, other limbs: over the loudest other along z"
    levels = first.shown.levels_db[:42] - first.shown.levels_db[29]
    assert first.loudest_db == np.delete(levels, 29).max()
    loudest = replace(first, loudest_db=12.3)
    panel.people.show_people((loudest, *others), (30,))
    assert "Synthetic 2: −12.3 dB over the loudest other" in panel.people.toolTip()
    assert panel.people.range_db == (-30.0, 13.0)
    heads = [head_text(loudest, QFontMetricsF(panel.font()), room) for room in (200.0, 20.0)]
    assert heads == ["Synthetic 2\n−12.3 dB", "2\n−12.3 dB"]


def test_beside_a_second_analysis_its_fields_are_as_wide_as_their_room(at_target, qtbot):
    window = at_target()
    window.resize(1440, 900)
    for name in ("analysis_2", TARGET):
        window.workspaces.bring(name)
    panel = window.panel(TARGET)
    area = panel.findChild(QScrollArea, "target_fields")
    qtbot.waitUntil(lambda: window.workspaces.settled and panel.width() < 600)
    assert area.widget().width() == area.viewport().width()
    assert panel.grid.geometry().right() < area.viewport().width()
    # Its words have the room of what it has not found yet.
    words = panel.findChild(QScrollArea, "target_words")
    assert words.mapTo(panel, words.rect().bottomRight()).x() > panel.width() - 20


def test_its_clips_lead_back_to_it(qtbot):
    design = edits.paint_target(Design(limb="synthetic-1"), View(), [30]).design
    design = edits.solve_target(design, View(), aim_of(design).solved(design)).design
    bench = LanesBench(qtbot, design)
    requested = []
    bench.panel.action_requested.connect(requested.append)
    bench.menu_at(bench.middle(design.motions[0].clips[0]))["Edit target"].trigger()
    assert requested == ["aim"]
