"""The stage: words, maps in motion in one scale, traces and a knob, on screens of any size."""

import re
from contextlib import nullcontext
from dataclasses import replace
from functools import partial
from math import sqrt

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, QRect, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QFrame, QLabel, QListWidget

import skinsource as ss
from skinsource.base.job import never, silent
from skinsource.design import edits
from skinsource.design.comparing import difference_db, gain_text
from skinsource.design.design import Snapshot
from skinsource.design.design_file import save_design
from skinsource.design.panel_settings import StageSettings, stage_settings, with_settings
from skinsource.engine.loops import loop_of
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource_gui.pages.files import maps_film
from skinsource_gui.panels.compare.motion import MOST_S
from skinsource_gui.panels.compare.settings import CompareSettings
from skinsource_gui.panels.compare.stage import Dial, _number
from skinsource_gui.panels.compare.view import bold
from skinsource_gui.panels.traces.panel import TracesSettings
from skinsource_gui.plots.pictures import MOVING, letters_px
from skinsource_gui.qt.theme import current_theme, tabular
from tests.gui.exporting import shown

SENTENCE = "Waves run towards the wrist. Try: turn the frequency to 50 Hz."


@pytest.fixture
def design():
    tone = ss.waveforms.Tone(frequency_hz=100.0)
    return ss.Design(
        limb="synthetic-1",
        inputs=(ss.track(7, tone),),
        title="A tone",
        notes=f"{SENTENCE}\nSource: nobody.",
    )


def show(window, stage=None, **compare):
    view = with_settings(window.document.view, "stage", stage or StageSettings())
    window.document.look(with_settings(view, "compare", CompareSettings(**compare)))


def stored(designs):
    return tuple(Snapshot(number=k, design=each) for k, each in enumerate(designs, 1))


@pytest.fixture
def stage(open_window, design, qtbot):
    window = open_window(design)
    window.do("present")
    qtbot.waitUntil(lambda: not window.engine.busy and window.workspaces.settled)
    panel = window.panel("stage")
    # Tests move it by themselves.
    panel.clock.held = True
    panel._rest.setInterval(60_000)
    yield panel
    panel.clock.held = False
    if window.presenter.presenting:
        window.do("present")


def scene_on(panel, qtbot, name, limb):
    """A scene, once curves of it are on the stage."""
    window, opened = panel.window(), ss.scenes.open_scene(name, available=(limb,))
    window.document.start_over(opened.design, opened.view, None)
    qtbot.waitUntil(lambda: window.workspaces.settled and not window.engine.busy, timeout=15_000)
    qtbot.waitUntil(lambda: bool(panel.strip.curves) and not panel.is_stale)
    return opened


def tick(panel, seconds=0.05):
    panel.clock.ticked.emit(seconds)


def complete(panel, qtbot, n):
    """The maps, once there are ``n`` of the present design."""

    def drawn():
        cells = panel.maps.content.cells
        return len(cells) == n and all(cell.small and not cell.stale for cell in cells)

    qtbot.waitUntil(drawn, timeout=15_000)
    return panel.maps.content.cells


def side_by_side(panel, qtbot, n, **compare):
    show(panel.window(), StageSettings(compared=True), **compare)
    return complete(panel, qtbot, n)


COMPARED = {"frequencies": 4, "limbs": 4, "axes": 3}


@pytest.mark.parametrize("of", COMPARED)
def test_maps_side_by_side_move_together_in_one_scale(stage, qtbot, of):
    before = side_by_side(stage, qtbot, COMPARED[of], of=of)
    assert stage.maps.content.common_scale is not None
    tick(stage)
    after = stage.maps.content.cells
    for one, other in zip(before, after, strict=True):
        assert not np.array_equal(one.values_db, other.values_db)
    # Axes that move are captioned with none of them.
    assert of != "axes" or "normal" not in stage.maps.content.common_scale.text_below


@pytest.mark.parametrize("of", COMPARED)
def test_levels_of_what_moves_are_as_many_maps_of_levels(stage, qtbot, of):
    moving = side_by_side(stage, qtbot, COMPARED[of], of=of, shown="motion")
    stage.show_levels()
    still = complete(stage, qtbot, COMPARED[of])
    assert {cell.scale.unit for cell in still} == {"dB"}
    assert [cell.heading for cell in still] == [cell.heading for cell in moving]


def test_motions_that_pass_go_on_until_the_longest_is_over(stage, qtbot):
    document = stage.window().document
    document.edit("", replace(document.design, inputs=(ss.track(7, ss.waveforms.Tap()),)))
    side_by_side(stage, qtbot, 4, of="limbs")
    moving = stage.moving
    moving.turns = 0.99
    for k, side in enumerate(stage.compared):
        whole = side.values["moving_z"]
        assert loop_of(side.snapshot.design, whole).duration_s <= moving.longest_s
        now = whole.acceleration(moving.begin_s + whole.delay_s + 0.99 * moving.longest_s)
        np.testing.assert_allclose(moving.values(k), now[:, 0], atol=1e-12)


def test_maps_and_traces_move_along_the_axis_of_the_view_and_say_it(stage, qtbot):
    window = stage.window()
    window.document.look(replace(window.document.view, axes="x", outputs=(20,)))
    (cell,) = complete(stage, qtbot, 1)
    assert "along x" in cell.scale.text_below
    assert "along x" in stage.strip._words[1]
    response = ss.evaluate(window.document.design, "moving_vector")["moving_vector"]
    ((loop, _),) = stage.moving.loops
    np.testing.assert_allclose(loop.moving.signals[:, 0], response.signals[:, 0], atol=1e-9)
    assert loop.moving.largest == pytest.approx(np.abs(response.signals[:, 0]).max())


def test_six_maps_cost_as_many_interpolations_a_frame_and_no_prediction(stage, qtbot, monkeypatch):
    window = stage.window()
    others = (50.0, 150.0, 200.0, 300.0, 400.0)
    side_by_side(stage, qtbot, 6, of="frequencies", frequencies_hz=others)
    qtbot.waitUntil(lambda: not window.engine.busy)
    requests = []
    window.engine.finished.connect(requests.append)
    interpolate, made = SurfaceOperator.interpolate, []
    monkeypatch.setattr(
        SurfaceOperator, "interpolate", lambda *given: made.append(1) or interpolate(*given)
    )
    places = stage.maps.places
    for _ in range(5):
        tick(stage)
    assert len(made) == 5 * 6
    # Nothing is laid out again either.
    assert stage.maps.places is places
    assert not requests
    assert not window.engine.busy


def test_the_knob_turns_the_frequency_while_the_maps_go_on(stage, qtbot):
    window = stage.window()
    complete(stage, qtbot, 1)
    tick(stage)
    turns, ends = stage.moving.turns, stage.strip.ends
    assert turns > 0.0
    stage.moving.turns = turns = 2.5
    stage.knob.edited.emit(95.0, None)
    assert stage.strip.marked == pytest.approx(2.5 / 95.0)
    stage.knob.dial.setValue(0)
    assert window.document.design.clips[0].waveform.frequency_hz == 25.0
    qtbot.waitUntil(lambda: not window.engine.busy and not stage.is_stale)
    assert stage.moving.turns == turns
    assert stage.moving.loops[0][0].duration_s == pytest.approx(0.04)
    # Scales stay until they are fitted, so that it is seen what is weaker and faster.
    assert stage.strip.ends == ends
    # Once the knob rests, nothing is cut.
    stage.knob.dial.setSliderDown(True)
    stage._rest.timeout.emit()
    assert stage.strip.ends == ends
    stage.knob.dial.setSliderDown(False)
    # A period that is cut is enough.
    stage._held_ends = ends[0], (-1e3, 1e3)
    stage.show_maps()
    stage._rest.timeout.emit()
    assert stage.strip.ends[0] == pytest.approx((0.0, 0.12))
    stage.knob.dial.setValue(1000)
    assert window.document.design.clips[0].waveform.frequency_hz == 600.0
    # One turn is one step of undo.
    window.do("undo")
    assert window.document.design.clips[0].waveform.frequency_hz == 95.0


UP = [QPoint(90, 90), QPoint(90, 40)]
CLOCKWISE = [QPoint(50, 10), QPoint(60, 10), QPoint(90, 50)]
BACK = [QPoint(50, 10), QPoint(40, 10), QPoint(10, 50)]
DRAGS = (UP[:1], 500), (UP, 700), (UP[::-1], 300), (CLOCKWISE, 800), (BACK, 200)


@pytest.mark.parametrize(("path", "value"), DRAGS)
def test_a_drag_turns_the_knob_by_as_much_as_the_mouse_moves(qtbot, path, value):
    dial = Dial()
    qtbot.addWidget(dial)
    dial.setRange(0, 1000)
    dial.setValue(500)
    dial.resize(100, 100)
    QTest.mousePress(dial, Qt.MouseButton.LeftButton, pos=path[0])
    for at in path[1:]:
        QTest.mouseMove(dial, at)
    QTest.mouseRelease(dial, Qt.MouseButton.LeftButton, pos=path[-1])
    QTest.keyClick(dial, Qt.Key.Key_Home)
    assert dial.value() == pytest.approx(value, abs=20)
    assert not dial.isSliderDown()


@pytest.mark.parametrize("moves", [True, False])
def test_the_scale_of_maps_stays_while_the_knob_turns(stage, qtbot, moves):
    window = stage.window()
    show(window, StageSettings(control="amplitude", moves=not moves))
    stage.show_levels()
    (cell,) = complete(stage, qtbot, 1)
    # Levels come in place of motion, and stand still.
    assert (cell.scale.unit, stage.clock._timer.isActive()) == ("m/s²" if moves else "dB", moves)
    qtbot.waitUntil(lambda: not window.engine.busy)
    scale = stage.maps.content.common_scale
    stage.knob.dial.setValue(900)
    qtbot.waitUntil(lambda: not window.engine.busy and not stage.is_stale)
    assert stage.maps.content.common_scale.range_db == scale.range_db
    assert stage._rest.isActive()
    stage._rest.timeout.emit()
    assert stage.maps.content.common_scale.range_db[1] > scale.range_db[1]
    # With another design it is fitted by itself.
    window.do("undo")
    qtbot.waitUntil(lambda: not window.engine.busy and not stage.is_stale)
    assert stage.maps.content.common_scale.range_db == scale.range_db
    # What is softer is not cut, and seen to be softer.
    fitted = stage.strip.ends
    stage.knob.dial.setValue(250)
    qtbot.waitUntil(lambda: not window.engine.busy and not stage.is_stale)
    stage._rest.timeout.emit()
    assert stage.strip.ends == fitted


@pytest.mark.parametrize(
    ("control", "turned"),
    [("all", "frequency_hz"), ("amplitude", "amplitude"), ("onset", "onset_s")],
)
def test_a_design_says_what_is_turned_also_one_of_before(stage, control, turned):
    window = stage.window()
    view = with_settings(window.document.view, "stage", StageSettings())
    before = with_settings(view, "frequency_and_amplitude", StageSettings(control=control))
    window.document.look(before)
    stage.knob.dial.setValue(700)
    after = window.document.design
    was = {"frequency_hz": 100.0, "amplitude": 1.0, "onset_s": 0.0}
    now = after.clips[0].waveform.frequency_hz, after.inputs[0].amplitude, after.clips[0].onset_s
    assert [name for name, value in zip(was, now, strict=True) if value != was[name]] == [turned]


def shown_at(stage, *size):
    window = stage.window()
    window.showNormal()
    window.resize(*size)
    return window


def test_the_names_of_curves_are_as_long_as_there_is_room(stage, qtbot):
    window = shown_at(stage, 1280, 720)
    complete(stage, qtbot, 1)
    strip, few = stage.strip, (29,)
    for outputs in (few, (20, 24, 28, 52, 57, 62, 72)):
        window.document.look(replace(window.document.view, outputs=outputs))
        labels = strip._labels(strip.width())
        assert len(labels) == len(outputs)
        assert strip.fontMetrics().horizontalAdvance("   ".join(labels)) <= strip.width()
        assert (labels == [curve.names[0] for curve in strip.curves]) == (outputs == few)


def test_curves_and_maps_of_several_tones_agree_at_the_cursor(stage, qtbot):
    side_by_side(stage, qtbot, 3, of="frequencies", frequencies_hz=(60.0, 150.0))
    row = stage.view.outputs[0] - 1
    for turns in (0.3, 3.4, 7.9):
        stage.moving.turns = turns
        tick(stage, 0.0)
        for k, curve in enumerate(stage.strip.curves):
            value = np.interp(stage.strip.marked, curve.x, curve.y)
            assert value == pytest.approx(stage.moving.values(k)[row], abs=0.02)


def test_maps_that_come_late_are_in_phase_with_those_that_move(stage, qtbot):
    side_by_side(stage, qtbot, 4, of="limbs")
    first, *others = stage.compared
    stage.show_on_limbs([first, replace(first, values=None), *others])
    tick(stage)
    before = stage.maps.content.cells[0].values_db
    stage.show_on_limbs([first, first, *others])
    one, late, *_ = stage.maps.content.cells
    # Those that moved go on from where they were.
    np.testing.assert_array_equal(one.values_db, before)
    np.testing.assert_array_equal(late.values_db, before)


def test_maps_named_by_a_frequency_have_all_tones_at_it(stage, qtbot):
    window, document = stage.window(), stage.window().document

    def edit(*pair_hz):
        inputs = tuple(map(ss.track, (7, 18), map(ss.waveforms.Tone, pair_hz)))
        document.edit("", replace(document.design, inputs=inputs))
        return ss.evaluate(document.design, "output_levels_db")["output_levels_db"]

    expected = {hz: edit(hz, hz) for hz in (50.0, 100.0, 200.0, 400.0)}
    still = StageSettings(compared=True, moves=False)
    show(window, still, of="frequencies", shown="difference")
    # The design stands for a frequency once all its tones have it.
    for pair, called in (((100.0, 400.0), "Working design"), ((200.0, 200.0), "200 Hz")):
        own = edit(*pair)
        others = [hz for hz in expected if (hz, hz) != pair]
        for cell, hz in zip(complete(stage, qtbot, len(others)), others, strict=True):
            assert cell.heading == f"{hz:g} Hz minus {called}"
            assert cell.values_db == pytest.approx(difference_db(expected[hz], own), abs=1e-9)


def test_what_leaves_the_conditions_is_said_on_the_stage(stage, qtbot):
    window = stage.window()
    complete(stage, qtbot, 1)
    qtbot.waitUntil(lambda: bool(window.conditions.chip.findings), timeout=10_000)
    qtbot.waitUntil(lambda: not stage.caution.text(), timeout=10_000)
    fast = ss.waveforms.Tone(frequency_hz=640.0)
    loud = window.document.design.with_input(0, amplitude=1e3, clips=(ss.Clip(waveform=fast),))
    window.document.edit("Loud", loud)
    qtbot.waitUntil(lambda: bool(stage.caution.text()), timeout=10_000)
    assert window.conditions.chip.text() == "⚠ Outside the measured band, 2 more"
    told = "outside the measured band; probe too fast; waves shorter than the sensor spacing"
    assert stage.caution.text() == f"⚠ {told}".replace("o", "O", 1)
    assert not stage.caution.geometry().intersects(stage.maps.geometry())
    assert stage.caution.toolTip() == window.conditions.chip.accessibleDescription()


def test_time_windows_are_levels_whatever_moves(stage, qtbot):
    show(stage.window(), StageSettings(compared=True), of="windows")
    qtbot.waitUntil(lambda: len(stage.maps.content.cells) > 1, timeout=15_000)
    assert all(cell.scale.unit == "dB" for cell in stage.maps.content.cells)


@pytest.mark.parametrize(("name", "screen"), [("2H", (1280, 720)), ("I3", (1366, 768))])
def test_all_time_windows_say_how_far_away_the_vibration_is(stage, qtbot, name, screen):
    window = shown_at(stage, *screen)
    opened = ss.scenes.open_scene(name, available=("synthetic-1",))
    window.document.start_over(opened.design, opened.view, None)
    show(window, StageSettings(compared=True), of="windows")
    n_windows = {"2H": 5, "I3": 6}[name]
    qtbot.waitUntil(lambda: len(stage.maps.content.cells) == n_windows, timeout=15_000)
    qtbot.waitUntil(lambda: stage.maps.width() > 0.9 * screen[0])
    metrics = QFontMetricsF(bold(tabular(stage.maps.font())))
    for cell, place in zip(stage.maps.content.cells, stage.maps.places.cells, strict=True):
        room, (heading,) = place.heading, cell.headings
        lines = heading.replace(" (", "\n(").splitlines()
        assert re.fullmatch(r"\(\d+\smm\saway\)", lines[1])
        assert max(map(metrics.horizontalAdvance, lines)) < room.width()
        assert room.height() > 1.9 * metrics.height()


@pytest.mark.parametrize("screen", [(1280, 720), (1366, 768), (1920, 1080)])
@pytest.mark.parametrize(
    ("compared", "scale"), [(False, 1.0), (True, 1.0), (True, 1.4), (False, 1.8)]
)
def test_all_of_it_is_in_sight_with_large_words(stage, qtbot, screen, compared, scale):
    stage.window().appearance._scale_text(scale)
    window = shown_at(stage, *screen)
    show(window, StageSettings(compared=compared), of="limbs")
    complete(stage, qtbot, 4 if compared else 1)
    qtbot.waitUntil(lambda: window.workspaces.settled and stage.width() > 0.9 * screen[0])
    assert stage.heading.text() == "A tone"
    assert stage.sentence.text() == SENTENCE
    assert stage.heading.fontMetrics().height() > 0.05 * screen[1]
    window.presenter.done.emit("Page Down: next scene")
    (card,) = (each for each in window.findChildren(QFrame, "notice") if each.isVisible())
    letters = card.findChild(QLabel, "notice_text").fontMetrics()
    assert letters.height() == stage.caution.fontMetrics().height()
    parts = stage.heading, stage.sentence, stage.switch, stage.maps, stage.strip, stage.knob, card
    areas = [QRect(part.mapTo(window, part.rect().topLeft()), part.size()) for part in parts]
    for area in areas:
        assert window.rect().contains(area)
    assert not any(one.intersects(other) for one in areas for other in areas if one is not other)
    assert stage.knob.dial.height() > 0.1 * screen[1]
    assert stage.knob.field.height() >= stage.knob.field.sizeHint().height()
    assert (
        min(place.map.height() for place in stage.maps.places.cells)
        > (0.31 if scale > 1.0 else 0.35) * screen[1]
    )
    assert not [part for part in (stage.heading, stage.sentence) if _cut(part)]


def _cut(label):
    return label.heightForWidth(label.width()) > label.height()


@pytest.mark.parametrize("kind", ss.waveforms.KINDS)
def test_the_knob_says_what_it_turns_in_words_that_stand_alone(kind):
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(3, kind()),))
    _, name, spec, _ = _number(design, ss.View())
    assert name == "amplitude" or kind.title in spec.label
    view = with_settings(ss.View(), "stage", StageSettings(control="amplitude"))
    _, _, spec, _ = _number(design.with_clip(1, gain=0.5), view)
    assert (spec.label, spec.unit) == ("Input gain", "×")


def test_the_time_axis_shows_all_of_a_motion_that_no_longer_loops(stage, qtbot):
    window = stage.window()
    tone = ss.waveforms.Tone(frequency_hz=100.0)
    assert stage.knob.label.text() == "Tone frequency"
    two = replace(window.document.design, inputs=(ss.track(7, tone), ss.track(12, tone)))
    window.document.edit("Two", two)
    assert stage.knob.label.text() == "Tone frequency, place\N{NO-BREAK SPACE}7"
    complete(stage, qtbot, 1)
    assert stage.strip.ends[0][1] == pytest.approx(0.03)
    stage.knob.dial.setValue(900)
    qtbot.waitUntil(lambda: not window.engine.busy and not stage.is_stale)
    loop = stage.moving.loops[0][0]
    assert loop.phasors is None
    begin_s = loop.begin_s - loop.moving.delay_s
    ends_s = begin_s, begin_s + loop.duration_s
    assert stage.strip.ends[0] == pytest.approx(ends_s)
    tick(stage)
    assert stage.strip.marked is not None
    assert stage.strip._words[2] == f"{1e3 * ends_s[0]:.0f} to {1e3 * ends_s[1]:.0f} ms"


@pytest.mark.parametrize("moves", [True, False])
def test_curves_of_a_comparison_go_with_its_maps(stage, qtbot, moves):
    window = stage.window()
    show(window, StageSettings(compared=True, moves=moves), of="snapshots")
    window.do("store_snapshot_1")
    stage.knob.dial.setValue(0)
    complete(stage, qtbot, 2)
    assert len(stage.strip.curves) == 2
    # What was turned is taken back: the design is the snapshot again, and people are compared.
    window.do("present")
    assert not stage.clock._timer.isActive()
    window.do("arrange_presentation")
    complete(stage, qtbot, 4)
    assert len(stage.strip.curves) == 4
    show(window, StageSettings(compared=True, moves=moves), of="frequencies")
    complete(stage, qtbot, 4)
    assert stage.clock._timer.isActive() is moves
    names = [curve.names for curve in stage.strip.curves]
    assert names == [("50 Hz",), ("100 Hz",), ("200 Hz",), ("400 Hz",)]
    window.document.edit("Empty", replace(window.document.design, inputs=()))
    qtbot.waitUntil(lambda: not (stage.strip.curves or window.engine.busy))


def test_numbers_of_a_scene_are_not_said_of_another_design(stage, qtbot):
    document = stage.window().document
    opened = ss.scenes.open_scene("2B", available=("synthetic-1",))
    document.edit("Scene", opened.design)
    complete(stage, qtbot, 1)
    stage.layout().activate()
    height = stage.heading.height()
    document.edit("Turned", opened.design.with_input(0, amplitude=2.0))
    assert not any(letter.isdigit() for letter in stage.sentence.text().partition("Try")[0])
    assert stage.heading.text() in opened.design.title
    stage.layout().activate()
    assert stage.heading.height() == height
    stage.knob.show_number("amplitude", stage.knob.field.spec, 25.1327)
    assert stage.knob.field.text() == "25.13"


TURNED = {
    "Place 7 · 100 Hz": "Place 7 · 150 Hz",
    "A 0.1 kHz tone, limb 1": "A 150 Hz tone, limb 1",
    "Far · 5 mm/s": "Far",
}


def test_what_is_to_be_tried_is_not_said_once_it_is_done(stage):
    stage.knob.edited.emit(60.0, None)
    assert stage.sentence.text() == SENTENCE
    stage.knob.edited.emit(50.0, None)
    assert stage.sentence.text() == "Waves run towards the wrist."


@pytest.mark.parametrize(("title", "turned"), TURNED.items())
def test_words_of_ones_own_say_the_number_that_is_played(stage, qtbot, title, turned):
    document = stage.window().document
    said = "It reaches 9 cm. At 100 Hz it is strong. It runs. Measured, it is 0.9. Try 50 Hz."
    own = replace(document.design, title=title, notes=said)
    document.start_over(own, document.view, None)
    others = replace(own, title="Far · 50 Hz"), replace(own, title="Far · 20 Hz")
    show(stage.window(), StageSettings(control="amplitude"))
    stage.knob.edited.emit(3.25, None)
    assert stage.sentence.text() == said[17:]
    show(stage.window())
    stage.knob.edited.emit(150.0, None)
    assert (stage.heading.text(), stage.sentence.text()) == (turned, said[41:])
    document.look(replace(document.view, snapshots=stored(others)))
    working = side_by_side(stage, qtbot, 3, of="snapshots")[-1]
    called = turned if turned.endswith(("Hz", "limb 1")) else "Working design"
    assert any(called in name for name in working.headings)
    assert title not in working.headings
    # Another design with the same words is the one that they are said of.
    document.start_over(replace(document.design), document.view, None)
    assert stage.sentence.text() == said


def test_letters_stay_large_when_the_theme_changes(stage, qtbot):
    large = stage.heading.font().pixelSize()
    for theme in ("use_contrast_theme", "use_light_theme"):
        stage.window().do(theme)
        qtbot.waitUntil(lambda: stage.heading.font().pixelSize() == large)


def test_maps_in_motion_are_as_loud_as_they_are_and_say_by_how_much_they_are_matched(stage, qtbot):
    window = stage.window()
    louder = window.document.design, window.document.design.with_input(0, amplitude=4.0)
    window.document.look(replace(window.document.view, snapshots=stored(louder)))
    side_by_side(stage, qtbot, 2, of="snapshots")
    one, other = stage.maps.content.cells
    np.testing.assert_allclose(other.values_db, 4.0 * one.values_db)
    assert not any("matched" in cell.value_text(None) for cell in (one, other))
    window.do("match_levels")
    qtbot.waitUntil(lambda: stage.compared[1].gain != 1.0 and not window.engine.busy)
    one, other = stage.maps.content.cells
    np.testing.assert_allclose(other.values_db, one.values_db, rtol=1e-6)
    gain = gain_text(stage.compared[1].gain)
    assert "matched" not in one.value_text(None)
    assert all(gain in text and "match" in text for text in other.value_texts(None))
    texts = one.scale.text_below, *one.scale.shorter, stage.strip._words[1]
    assert all("matched" in text for text in texts)
    stage.show_levels()
    qtbot.waitUntil(lambda: all(cell.scale for cell in complete(stage, qtbot, 2)))
    assert gain in stage.maps.content.common_scale.text_below
    # The louder one alone says it, too.
    window.do("show_snapshot_2")
    show(window)
    qtbot.waitUntil(lambda: "−12.0 dB, matched" in complete(stage, qtbot, 1)[0].scale.text_below)


def test_slow_motion_is_chosen_on_the_stage_and_said_there(stage, qtbot):
    window = stage.window()
    (cell,) = complete(stage, qtbot, 1)
    assert "1/50" in cell.scale.text_below
    for action, pace in (("play_slower", 100), ("play_faster", 50), ("play_faster", 20)):
        window.do(action)
        assert stage.moving.slow_motion == pace
        assert f"1/{pace}" in stage.maps.content.common_scale.text_below
    turns = stage.moving.turns
    tick(stage, 0.05)
    assert stage.moving.turns - turns == pytest.approx(0.05 / 20 * 100.0)
    window.do("play_automatic")
    assert stage.moving.slow_motion == 50.0
    side_by_side(stage, qtbot, 4, of="frequencies")
    window.do("play_slower")
    qtbot.waitUntil(lambda: stage.moving.slow_motion == 500.0)
    # The fastest is half as fast as it happens: real time is no motion that anybody sees.
    window.document.look(replace(window.document.view, slow_motion=2.0))
    qtbot.waitUntil(lambda: stage.moving.slow_motion == 2.0)
    window.do("play_faster")
    assert window.document.view.slow_motion == 2.0


def test_of_a_long_motion_the_loudest_part_moves_in_half_a_minute(stage, qtbot):
    window, rng = stage.window(), np.random.default_rng(1)
    samples = rng.uniform(-1.0, 1.0, 2600) * np.where(np.arange(2600) // 130 == 12, 1.0, 0.2)
    noise = ss.waveforms.Recording(samples=samples)
    noisy = replace(window.document.design, inputs=(ss.track(7, noise),))
    window.document.edit("Noise", noisy)
    qtbot.waitUntil(lambda: stage.moving.loops[0] and stage.moving.loops[0][0].phasors is None)
    ((loop, _),) = stage.moving.loops
    assert loop.duration_s * stage.moving.slow_motion == pytest.approx(MOST_S)
    assert loop.begin_s < 1.25 + loop.moving.delay_s < loop.begin_s + loop.duration_s
    assert "loudest" in stage.maps.content.common_scale.text_below
    begin_s = loop.begin_s - loop.moving.delay_s
    assert stage.strip.ends[0] == pytest.approx((begin_s, begin_s + loop.duration_s))
    shares = [stage.moving.turns]
    tick(stage, MOST_S / 4)
    assert stage.moving.turns - shares[0] == pytest.approx(0.25)


def seen(stage, qtbot, *waveforms):
    """The values that maps of several designs reach in the part that is shown."""
    document = stage.window().document
    designs = [replace(document.design, inputs=(ss.track(8, each),)) for each in waveforms]
    document.look(replace(document.view, snapshots=stored(designs)))
    document.edit("", designs[0])
    cells = side_by_side(stage, qtbot, len(designs), of="snapshots")
    reached = np.zeros(len(designs))
    for share in np.linspace(0.0, 1.0, 50, endpoint=False):
        stage.moving.turns = share
        now = [np.abs(stage.moving.values(k)).max() for k in range(len(designs))]
        reached = np.maximum(reached, now)
    return cells, reached / [loop.largest for loop, _ in stage.moving.loops]


def test_of_long_motions_the_part_is_shown_in_which_each_is_seen(stage, qtbot):
    tone = ss.waveforms.Tone(frequency_hz=60.0, duration_s=0.2)
    growing = np.linspace(0.2, 1.0, 1300) * np.sin(np.arange(1300))
    long = ss.waveforms.Recording(samples=growing)
    cells, reached = seen(stage, qtbot, tone, ss.waveforms.Tap(), long)
    assert np.all(reached > 0.1)
    assert not any("this part" in cell.value_text(None) for cell in cells)
    words = stage.strip._words[2]
    assert words in stage.maps.content.common_scale.text_below
    assert "loudest" not in stage.maps.content.common_scale.text_below


def test_a_map_that_moves_outside_of_the_part_says_it(stage, qtbot):
    late = ss.waveforms.Recording(samples=np.append(np.zeros(1300), np.ones(30)))
    cells, reached = seen(stage, qtbot, ss.waveforms.Tap(), late)
    k = int(np.argmin(reached))
    assert reached[k] < 0.1 < reached[1 - k]
    said = cells[k].value_texts(None)
    assert all(f"moves {('before', 'after')[k]} this part" in text for text in said)
    assert "this part" not in cells[1 - k].value_text(None)


def test_what_is_held_of_a_long_design_is_said(stage, qtbot):
    document = stage.window().document
    tone, late = document.design, document.design.with_clip(1, onset_s=30.0)
    document.look(replace(document.view, snapshots=stored([tone, late])))
    show(stage.window(), StageSettings(compared=True, plot="spectra"), of="snapshots")
    _, cell = complete(stage, qtbot, 2)
    assert "moves after this part" in cell.value_text(None)
    assert stage.strip._words[1].endswith("60 dB in all, of 0 to 25 s")


def test_maps_beside_each_other_have_one_clock_also_where_some_are_steady(stage, qtbot):
    document = stage.window().document
    tones = [ss.waveforms.Tone(frequency_hz=hz, duration_s=0.2) for hz in (100.0, 50.0, 250.0)]
    designs = [
        replace(document.design, inputs=(ss.track(7, each), ss.track(10, tones[0])))
        for each in tones
    ]
    document.look(replace(document.view, snapshots=stored(designs)))
    document.edit("", designs[0])
    side_by_side(stage, qtbot, 3, of="snapshots")
    stage.moving.turns = 0.0
    for k, (loop, _) in enumerate(stage.moving.loops):
        # Nothing has arrived yet.
        assert np.abs(stage.moving.values(k)).max() < 0.05 * loop.largest
    # Silence has no clock of its own.
    steady = designs[0], replace(designs[0], inputs=())
    document.look(replace(document.view, snapshots=stored(steady)))
    qtbot.waitUntil(lambda: len(stage.maps.content.cells) == 2 and not stage.is_stale)
    assert stage.moving.loops[0][0].duration_s == pytest.approx(0.01)


def test_the_clock_of_the_stage_and_of_its_film_is_that_of_the_traces(stage, qtbot):
    document = stage.window().document
    tap = replace(document.design, inputs=(ss.track(18, ss.waveforms.Tap(), onset_s=0.1),))
    early = replace(tap, inputs=(ss.track(18, ss.waveforms.Tap(), onset_s=0.04),))
    for removed in (True, False):
        view = replace(document.view, delay_removed=removed, outputs=(29,))
        document.look(replace(view, snapshots=stored((early, tap))))
        document.edit("", tap)
        side_by_side(stage, qtbot, 2, of="snapshots")
        found = ss.evaluate(tap, "response_time_s", "selected_traces", view=replace(view, axes="z"))
        trace, curve = found["selected_traces"][0], stage.strip.curves[1]
        expected_s = found["response_time_s"][np.argmin(trace)]
        assert curve.x[np.argmin(curve.y)] == pytest.approx(expected_s, abs=1e-3)
        # There the cursor stands when the map shows it.
        moving = stage.moving
        moving.turns = (expected_s - moving.begin_s) / moving.longest_s
        tick(stage, 0.0)
        assert stage.strip.marked == pytest.approx(expected_s)
        assert moving.values(1)[28] == pytest.approx(trace.min(), rel=0.01)
        assert moving.clock_text.startswith(f"{1e3 * expected_s:.1f} of ")


# Length of a clip, chosen speed, how much is shown in which time, s.
CLIPS = [
    (0.1, 0.0, 0.1, 10.0),
    (1.0, 0.0, 1.0, 18.0),
    (3.0, 0.0, 1.6, 18.0),
    (3.0, 20.0, 2.0, 40.0),
]


@pytest.mark.parametrize("clips", CLIPS)
def test_clips_in_turn_are_soon_seen_and_no_wave_runs_backwards(stage, qtbot, clips):
    length_s, chosen, shown_s, turn_s = clips
    document, moving = stage.window().document, stage.moving
    tone = ss.waveforms.Tone(frequency_hz=200.0, duration_s=length_s)
    motion = ss.motions.Sweep(path=(7, 12, 17), waveform=tone)
    document.look(replace(document.view, slow_motion=chosen))
    document.edit("", replace(document.design, inputs=motion.tracks()))
    qtbot.waitUntil(lambda: not stage.window().engine.busy and not stage.is_stale)
    ((loop, _),) = moving.loops
    seen_s = loop.duration_s, moving.slow_motion * loop.duration_s
    assert seen_s == pytest.approx((shown_s, turn_s), rel=0.2)
    assert ("loudest" in stage.maps.content.common_scale.text_below) is (shown_s < length_s)
    assert stage.clock._timer.interval() == round(1e3 / moving.pictures_per_s)
    # A picture may be late, too.
    before_s = moving.ran_s
    tick(stage, 0.1)
    assert turn_s != 18.0 or (moving.ran_s - before_s) * loop.fastest_hz < 0.45


def test_a_design_without_a_title_is_called_after_its_file(open_window, tmp_path, design):
    path = tmp_path / "2 two fingers.skinsource"
    save_design(path, replace(design, title=""), ss.View())
    window = open_window(replace(design, inputs=(), title=""))
    # No hand is there to click.
    assert "hand" not in window.panel("stage").heading.text()
    window.files.open(path)
    window.do("present")
    assert window.panel("stage").heading.text() == "2 two fingers"
    window.document.edit("", replace(window.document.design, title="Two"))
    assert window.panel("stage").heading.text() == "Two"
    window.do("present")
    for left_of, called in ((None, "Untitled"), (path, "2 two fingers")):
        window.document.recover(replace(design, title=""), ss.View(), left_of)
        window.do("present")
        assert window.panel("stage").heading.text() == called
        window.do("present")


@pytest.mark.parametrize("outputs", [(29, 52), (29, 72)])
def test_several_maps_show_hands_unless_an_output_of_the_arm_is_selected(stage, qtbot, outputs):
    window = stage.window()
    window.document.look(replace(window.document.view, outputs=outputs))
    complete(stage, qtbot, 1)
    assert not stage.maps.places.low
    side_by_side(stage, qtbot, 4, of="limbs")
    assert stage.maps.places.low == (72 not in outputs)
    # What is selected is seen.
    points, areas = stage.maps.points_of(1), stage.maps.places.cells[1].map
    assert all(areas.contains(*points[number - 1]) for number in outputs)


def test_a_key_and_a_switch_show_arms_of_one_map_and_of_several(stage, qtbot, monkeypatch):
    window = stage.window()
    window.document.look(replace(window.document.view, outputs=(72,)))
    complete(stage, qtbot, 1)
    stage.setFocus()
    key = partial(QTest.keyClick, stage.knob.dial, Qt.Key.Key_Z)

    def is_shown(arm):
        return stage.maps.places.low is not arm and stage.arm.isChecked() is arm

    assert is_shown(arm=True)
    for press, arm in ((key, False), (stage.arm.click, True), (key, False)):
        press()
        assert is_shown(arm=arm)
    # What was chosen for one map stays for several: of people where there are no snapshots.
    show(window, StageSettings(compared=True), of="snapshots")
    complete(stage, qtbot, 4)
    assert is_shown(arm=False)
    # It is shown even where there is little room.
    monkeypatch.setattr(stage.maps, "least_lines", 1e3)
    stage.arm.click()
    assert is_shown(arm=True)


@pytest.mark.parametrize("name", ["5B", "2A", "2F"])
def test_whole_sentences_of_scenes_grow_with_the_letters(stage, qtbot, name):
    window = shown_at(stage, 1280, 720)
    opened = ss.scenes.open_scene(name, available=("synthetic-1",))
    window.document.start_over(opened.design, opened.view, None)
    said = opened.design.notes.partition("\n")[0]
    qtbot.waitUntil(lambda: stage.height() > 700 and stage.sentence.text() == said)
    before = stage.sentence.font().pixelSize()
    for scale in (1.5, 2.0):
        window.appearance._scale_text(scale)
        # Beside one map, the plot keeps its part.
        least_px = min(sqrt(scale), 1.2 if name == "2A" else 2.0) * before
        qtbot.waitUntil(lambda px=least_px: stage.sentence.font().pixelSize() >= px)
        stage.layout().activate()
        assert stage.sentence.text() == said
        assert stage.knob.field.y() >= stage.knob.dial.y() + 56
        assert not [part for part in (stage.heading, stage.sentence) if _cut(part)]


@pytest.mark.parametrize("screen", [(1280, 720), (1920, 1080)])
def test_maps_keep_their_part_of_the_height_however_large_and_long_the_words(stage, qtbot, screen):
    window = shown_at(stage, *screen)
    for _ in range(3):
        window.do("enlarge_text")
    long = f"{SENTENCE[:-1]} and {'then turn it to another one, ' * 30}again."
    title = window.document.design.title
    window.document.edit("", replace(window.document.design, notes=long, title=title * 30))
    side_by_side(stage, qtbot, 4, of="limbs")
    qtbot.waitUntil(lambda: window.workspaces.settled and stage.width() > 0.9 * screen[0])
    qtbot.waitUntil(lambda: stage.maps.height() >= 0.42 * stage.height())
    assert stage.sentence.text().endswith("…")
    assert stage.sentence.toolTip() == long
    window.document.edit("", replace(window.document.design, title=title))
    # What is a little too long is said in smaller letters, and what is short in large ones.
    small = stage.sentence.font().pixelSize()
    for said in (" ".join(11 * [SENTENCE[:28]]), SENTENCE):
        window.document.edit("", replace(window.document.design, notes=said))
        assert stage.sentence.text() == said
        assert not stage.sentence.toolTip()
        assert stage.sentence.font().pixelSize() > small
        small = stage.sentence.font().pixelSize()
    stage.layout().activate()
    assert not [part for part in (stage.heading, stage.sentence) if _cut(part)]


def test_the_largest_letters_fit_whichever_scene_was_before(stage, qtbot):
    window, letters = shown_at(stage, 1280, 720), []
    for _ in range(6):
        window.do("enlarge_text")
    for name in ("2D", "4A", "4B", "4A"):
        scene_on(stage, qtbot, name, "synthetic-1")
        qtbot.waitUntil(lambda: stage.caution.text() != "")
        qtbot.waitUntil(lambda: stage.height() == stage.parentWidget().height())
        assert stage.rect().contains(stage.knob.geometry())
        assert stage.strip.height() > (0.2 if name == "2D" else 0.27) * stage.height()
        letters.append(stage.sentence.font().pixelSize())
    assert letters[1] == letters[3]


def test_rows_of_traces_show_when_the_vibration_arrives_as_the_sentence_says(stage, qtbot):
    opened = scene_on(stage, qtbot, "2A", "synthetic-1")
    (later_ms,) = re.findall(r"(\d+) ms later", opened.design.notes)
    strip, (first, *_, last) = stage.strip, stage.strip.curves
    assert 1e3 * (last.arrival - first.arrival) == pytest.approx(float(later_ms), abs=0.5)
    assert last.names[-2] == f"57 +{later_ms} ms"
    assert "marked" in strip._words[1]
    # It moves after that.
    assert np.abs(last.y[last.x < last.arrival]).max() < 0.1 < np.abs(last.y).max()
    area, picture = strip._area(), strip.grab().toImage()
    low, high = strip.ends[0]
    x = area.left() + area.width() * (last.arrival - low) / (high - low)
    assert picture.pixelColor(int(x), round(area.bottom() - 3)).lightness() < 150


def test_a_muted_track_does_not_change_when_the_vibration_arrives(stage, qtbot):
    opened, document = scene_on(stage, qtbot, "2A", "synthetic-1"), stage.window().document
    (only,) = opened.design.clips
    later = opened.design.with_clip(only.id, onset_s=only.onset_s + 0.1)
    document.start_over(later.adding(ss.track(7, muted=True)), opened.view, None)
    qtbot.waitUntil(lambda: len(stage.compared[0].snapshot.design.inputs) == 2)
    qtbot.waitUntil(lambda: bool(stage.strip.curves) and not stage.is_stale)
    assert stage.strip.curves[0].arrival == pytest.approx(only.onset_s + 0.1)


def test_rows_of_noise_say_so_and_have_no_arrival(measured, stage, qtbot):
    scene_on(stage, qtbot, "2A", "measured-1")
    assert stage.strip.curves[-2].names[-2] == "52 +6 ms"
    # It moves by a quarter of its peak before its group delay has passed.
    stage.knob.edited.emit(50.0, None)
    qtbot.waitUntil(lambda: stage.strip.curves[4].arrival is None)
    assert "ms" not in stage.strip.curves[4].names[0]
    stage.knob.edited.emit(240.0, None)
    qtbot.waitUntil(lambda: stage.strip.curves[-1].names[-1] == "57 noise")
    arrivals = [curve.arrival for curve in stage.strip.curves]
    assert arrivals[-1] is None
    assert max(arrivals[:-1]) - arrivals[0] < 0.01
    stage.window().document.look(replace(stage.window().document.view, outputs=(57,)))
    side_by_side(stage, qtbot, 3, of="frequencies", frequencies_hz=(50.0, 400.0))
    names = [("50 Hz",), ("240 Hz noise",), ("400 Hz noise",)]
    qtbot.waitUntil(lambda: [curve.names for curve in stage.strip.curves] == names)
    told = re.compile(r"400 Hz: \d+ outputs near the noise$")
    qtbot.waitUntil(lambda: told.search(stage.caution.text()) is not None)
    stage.show_levels()
    qtbot.waitUntil(lambda: stage.caution.text().endswith("near the noise, hatched"))
    assert "\nHatched: mostly noise; most in 400 Hz, " in stage.caution.toolTip()
    # Outputs on the arm are not hatched on hands alone, nor is one without a place.
    smalls = [replace(cell.small, noisy=(57, 65)) for cell in stage.maps.content.cells]
    pairs = zip(stage.maps.content.cells, smalls, strict=True)
    cells = tuple(replace(cell, small=small) for cell, small in pairs)
    content = replace(stage.maps.content, cells=cells)
    assert [content.is_hatched(hand_only=each) for each in (True, False)] == [False, True]
    show(stage.window(), stage_settings(stage.view), of="frequencies", shown="mean")
    # Of their mean there is no number.
    assert re.search(r"\d|hatched|^$", stage.caution.text()) is None
    # Of noise the loudest part is shown, after all has arrived.
    scene_on(stage, qtbot, "2C", "synthetic-1")
    assert "marked" not in stage.strip._words[1]


def test_where_rows_have_no_room_all_curves_lie_over_each_other(stage, qtbot):
    scene_on(stage, qtbot, "2A", "synthetic-1")
    strip = stage.strip
    strip.resize(600, 5 * strip.fontMetrics().height())
    picture = strip.grab().toImage()
    at = [(x, y) for x in range(0, picture.width(), 2) for y in range(picture.height())]
    seen = {picture.pixelColor(x, y).name() for x, y in at}
    assert {current_theme().output_colour(k).name() for k in range(7)} <= seen
    names = strip.fontMetrics().horizontalAdvance("   ".join(strip._labels(strip.width())))
    assert names + strip.fontMetrics().horizontalAdvance("   000.0 ms") < strip.width()


@pytest.mark.parametrize("name", ["5D", "5E"])
def test_lines_are_fitted_to_the_dots_of_output_over_input(stage, qtbot, name):
    opened = scene_on(stage, qtbot, name, "synthetic-1")
    curve = stage.strip.curves[1]
    found = ss.evaluate(opened.design, "output_band_rms", view=opened.view)["output_band_rms"]
    in_band = found[1][opened.view.outputs[0] - 1, 0, np.abs(found[0] - 100.0).argmin()]
    np.testing.assert_allclose(10**curve.x, [0.75, 1.5, 3.0, 6.0])
    np.testing.assert_allclose(10**curve.dots, 10**curve.x * in_band / 6.0)
    np.testing.assert_allclose(curve.y, curve.dots)
    stage.knob.edited.emit(2.0, None)
    qtbot.waitUntil(lambda: stage.strip.curves[1].x.size == 5)


def test_maps_that_move_side_by_side_are_filmed_in_a_loop(stage, qtbot, tmp_path, monkeypatch):
    pytest.importorskip("imageio_ffmpeg")
    window, frames = stage.window(), []
    monkeypatch.setattr(
        maps_film, "video_file", lambda *_: nullcontext(lambda each: frames.append(each * 1.0))
    )
    assert not shown(window, "maps_animation").ready
    side_by_side(stage, qtbot, 2, of="frequencies", frequencies_hz=(50.0,))
    part, turns = shown(window, "maps_animation"), stage.moving.turns
    for name, value in (("width_px", 320), ("height_px", 180), ("colours", "dark")):
        part.form._edit(name, value, None)
    part.writer(tmp_path / "film.gif")(progress=silent, stop=never, largest_error=np.inf)
    # One loop takes a second: at twice 50 Hz, 100 Hz is shown at 2 Hz.
    assert f"{4.0:g} s of film" in part.form.remark.text
    assert [each.shape for each in frames] == 4 * 50 * [(180, 320, 3)]
    assert np.array_equal(frames[0], frames[50])
    assert not np.array_equal(frames[0], frames[25])
    assert frames[0].mean() < 128.0
    assert stage.moving.turns == turns
    window.exports.end()
    # Where waves would seem to go backwards it is not written.
    window.document.look(replace(window.document.view, slow_motion=2.0))
    assert not shown(window, "maps_animation").ready
    window.exports.end()


def test_a_film_is_of_the_maps_in_motion_unless_another_was_chosen(stage, qtbot):
    side_by_side(stage, qtbot, 2, of="frequencies", frequencies_hz=(50.0,))
    shown(stage.window(), "stimulus")
    page = stage.window().exports.page
    groups = page.findChild(QListWidget, "export_groups")
    groups.setCurrentRow(3)
    assert page.part.name == "maps_animation"
    page.part.show_export("animation")
    groups.setCurrentRow(0)
    page.show_design(stage.window().document.design)
    groups.setCurrentRow(3)
    assert page.part.name == "animation"
    stage.window().exports.end()


def test_a_film_of_frequencies_says_what_the_tones_are_and_when_it_is(stage, qtbot, monkeypatch):
    window, drawn = stage.window(), []
    second = ss.track(13, ss.waveforms.Tone(frequency_hz=300.0))
    window.document.edit("", replace(window.document.design, scaling="probe").adding(second))
    window.document.look(replace(window.document.view, slow_motion=100.0))
    side_by_side(stage, qtbot, 3, of="frequencies", frequencies_hz=(50.0, 400.0))
    film = window.pictures.picture_of(MOVING).visible
    assert "In the maps of 50, 400 Hz all tones have that frequency." in film.caption
    assert "Working design, 400 Hz: 2" in film.caption
    options = maps_film.MapsFilmOptions(width_px=1280, height_px=720)
    monkeypatch.setattr(maps_film, "paint_page", lambda by, of, *_: drawn.extend((by.font(), of)))
    maps_film.maps_picture(options=options, seen=film, stop=never)
    assert drawn[0].pixelSize() >= letters_px(1280, 720)
    # Two tones pass, and do not end with a period of the others.
    longest_ms = 1e3 * film.moving.longest_s
    assert drawn[1].about == f"{longest_ms / 4 - 5.0:.1f} of −5 to {longest_ms - 5.0:.0f} ms"
    window.do("undo")
    qtbot.waitUntil(lambda: stage.moving.longest_s == pytest.approx(0.02))
    film = window.pictures.picture_of(MOVING).visible
    maps_film.maps_picture(options=options, seen=film, stop=never)
    assert drawn[3].about == "5.0 of 20.0 ms of one period"


def test_a_film_of_unlike_tones_ends_where_all_of_them_begin_again(stage, qtbot):
    # The tone of the design has 200 Hz.
    side_by_side(stage, qtbot, 4, of="frequencies", frequencies_hz=(80.0, 180.0, 300.0))
    film = shown(stage.window(), "maps_animation")
    assert "without a seam" in film.form.remark.text
    turns, _ = maps_film.MapsFilm(moving=stage.moving, content=None, caption="").turns(30)
    stage.moving.turns = 0.0
    first = [stage.moving.values(k) for k in range(4)]
    stage.moving.turns = turns
    assert turns / 80.0 == pytest.approx(0.05)
    for k in range(4):
        np.testing.assert_allclose(stage.moving.values(k), first[k], atol=1e-9)
    stage.window().exports.end()
    # No common period is short enough.
    side_by_side(stage, qtbot, 3, of="frequencies", frequencies_hz=(80.0, 181.7))
    assert "jumps where it begins again" in shown(stage.window(), "maps_animation").form.remark.text
    stage.window().exports.end()


def test_the_warning_stays_on_one_line_above_several_maps(stage, qtbot):
    shown_at(stage, 1920, 1080)
    side_by_side(stage, qtbot, 4, of="limbs")
    stage.show_caution("⚠ Outside the measured band, 2 more", "")
    stage.layout().activate()
    line_px = stage.caution.fontMetrics().height()
    assert stage.caution.heightForWidth(stage.caution.width()) < 2 * line_px


def test_spectra_of_all_axes_show_what_the_figure_of_their_scene_shows(stage, qtbot):
    opened = scene_on(stage, qtbot, "1D", "synthetic-2")
    whole = ss.evaluate(opened.design, "moving_vector")["moving_vector"].signals
    power = np.square(np.abs(np.fft.rfft(whole[opened.view.outputs[0] - 1]))).sum(axis=0)
    shown_power = 10.0 ** (stage.strip.curves[0].y / 10.0)
    np.testing.assert_allclose(shown_power / shown_power.max(), power / power.max(), atol=1e-6)
    assert "acceleration along x, y and z together" in stage.strip._words[1]
    assert "acceleration" in stage.strip.accessibleName()
    assert [tick.label for tick in stage.strip.ticks] == ["100", "200", "300", "400", "500"]
    # Another layout of spectra has the axis of the view, which is named as well.
    stage.window().document.look(replace(opened.view, panels=opened.view.panels[1:]))
    qtbot.waitUntil(lambda: "acceleration normal to the skin," in stage.strip._words[1])
    assert not np.allclose(stage.strip.curves[0].y, 10.0 * np.log10(shown_power))
    # Where the figure has a plot for each axis, the stage has a map and a curve.
    scene_on(stage, qtbot, "2D", "synthetic-2")
    qtbot.waitUntil(lambda: [each.names[-1] for each in stage.strip.curves] == ["x", "y", "z"])


def test_clicks_on_the_stage_add_and_remove_outputs_in_one_scale(stage, qtbot):
    window = stage.window()
    opened = scene_on(stage, qtbot, "1D", "synthetic-4")

    def click(number, beside=0):
        at = QPointF(*stage.maps.points_of(0)[number - 1]).toPoint() - QPoint(beside, 0)
        QTest.mouseClick(stage.maps, Qt.MouseButton.LeftButton, pos=at)
        return window.document.view.outputs

    ends, outputs = stage.strip.ends, opened.view.outputs
    loudest = outputs[int(np.argmax([curve.y.max() for curve in stage.strip.curves]))]
    assert click(52) == (*outputs, 52)
    assert click(loudest) == (*(each for each in outputs if each != loudest), 52)
    assert stage.strip.ends == ends
    stage.fit()
    assert stage.strip.ends != ends
    # What is louder than the scale is fitted after a moment.
    click(loudest)
    stage._rest.timeout.emit()
    assert stage.strip.ends == ends
    # Of several maps one output is shown, which is the one that was clicked.
    side_by_side(stage, qtbot, 3, of="axes")
    assert click(52) == (52,)
    # It is the nearest one, however far it is.
    leftmost = int(np.nanargmin(stage.maps.points_of(0)[:, 0])) + 1
    assert click(leftmost, 20) == (leftmost,)


def test_all_that_a_motion_changes_is_painted_again(stage, qtbot, monkeypatch):
    complete(stage, qtbot, 1)
    stage.arm.click()
    pictures, areas = [stage.maps.grab().toImage()], []
    with monkeypatch.context() as within:
        within.setattr(stage.maps, "update", areas.append)
        tick(stage)
    pictures.append(stage.maps.grab().toImage())
    assert pictures[0] != pictures[1]
    for picture in pictures:
        painter = QPainter(picture)
        painter.fillRect(areas[0], Qt.GlobalColor.black)
        painter.end()
    assert pictures[0] == pictures[1]


def test_no_curve_of_an_axis_has_the_colour_of_a_ring(stage, qtbot):
    scene_on(stage, qtbot, "1C", "synthetic-4")
    complete(stage, qtbot, 3)
    picture, theme = stage.maps.grab().toImage(), current_theme()
    at = [(x, y) for x in range(picture.width()) for y in range(picture.height())]
    colours = {picture.pixelColor(x, y).rgb() for x, y in at}
    assert colours.isdisjoint({theme.output_colour(each.rank).rgb() for each in stage.strip.curves})
    assert QColor(theme.text).rgb() in colours


@pytest.mark.parametrize("name", ["1C", "2D"])
def test_curves_of_a_far_output_fill_the_plot_once_the_mouse_rests(stage, qtbot, name):
    opened = scene_on(stage, qtbot, name, "synthetic-4")
    document, ends = stage.window().document, stage.strip.ends
    document.apply(edits.select_outputs(opened.design, document.view, (58,)))
    assert stage.strip.ends == ends
    stage._rest.timeout.emit()
    values = [curve.y if name == "2D" else np.abs(curve.y) for curve in stage.strip.curves]
    assert stage.strip.ends[1][1] == np.max(values) < ends[1][1]


def test_of_what_is_known_in_part_no_part_is_called_the_loudest(stage, qtbot):
    document, tone = stage.window().document, ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.5)
    # Of so long a design the first 25 s are known.
    tracks = ss.track(7, tone, amplitude=0.1), ss.track(7, tone, amplitude=10.0, onset_s=40.0)
    document.edit("", replace(document.design, inputs=tracks))
    qtbot.waitUntil(lambda: stage.moving.longest_s > 1.0)
    (cell,) = stage.maps.content.cells
    assert "loudest" not in cell.scale.text_below
    assert stage.moving.span_text in cell.scale.text_below
    soft = replace(document.design, inputs=tracks[:1])
    found = np.abs(ss.evaluate(soft, "moving_z")["moving_z"].signals).max()
    assert cell.reaches[-1] == f"{found:.2g} m/s²"
    # The same axis is as large beside the others.
    assert side_by_side(stage, qtbot, 3, of="axes")[2].reaches == cell.reaches


def test_an_input_that_is_silent_is_marked_and_moves_no_arrival(stage, qtbot):
    document = stage.window().document
    tap = ss.track(7, ss.waveforms.Tap(), onset_s=0.2)
    view = replace(document.view, outputs=(29, 40, 57))
    document.look(with_settings(view, "traces", TracesSettings(layout="stacked")))
    document.edit("", replace(document.design, inputs=(tap,)))
    qtbot.waitUntil(lambda: stage.strip.in_rows and stage.strip.curves[0].arrival is not None)
    arrivals = [curve.arrival for curve in stage.strip.curves]
    muted = ss.track(18, ss.waveforms.Tap(), muted=True)
    both = replace(document.design, inputs=(tap, muted))
    document.edit("", both)
    qtbot.waitUntil(lambda: stage.maps.content.cells[0].design is document.design)
    assert [curve.arrival for curve in stage.strip.curves] == arrivals
    # It is marked no longer where it is taken away, which changes no results either.
    document.undo_stack.undo()
    qtbot.waitUntil(lambda: len(stage.maps.content.cells[0].design.inputs) == 1)
