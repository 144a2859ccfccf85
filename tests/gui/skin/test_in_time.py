"""The skin map in time, in the studio."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

import skinsource as ss
from skinsource.base.conventions import PRE_TRIGGER_DELAY_S
from skinsource.design.design import View
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.time_rules import BLOCK_S
from skinsource_gui.panels.skin.content import signals_name
from skinsource_gui.panels.skin.settings import LEVELS, MAGNITUDE, RMS, SkinSettings, Z
from skinsource_gui.plots.colour_maps import DIVERGING
from tests.gui.shared_window import rest
from tests.gui.skin.bench import choose

TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)
SHORT = ss.Design(limb="synthetic-1", inputs=(ss.track(7, TONE),))
LONG = replace(SHORT, inputs=(ss.track(7, ss.waveforms.Noise(duration_s=40.0)),))


@pytest.fixture
def window(open_window):
    """A whole studio."""
    return open_window(SHORT, View())


@pytest.fixture
def look():
    """Change what the skin panel looks at, and wait for it."""

    def change(window, playhead_s=None, **settings):
        document = window.document
        view = (
            document.view if playhead_s is None else replace(document.view, playhead_s=playhead_s)
        )
        if settings:
            now = settings_of(view, "skin", SkinSettings)
            view = with_settings(view, "skin", replace(now, **settings))
        document.look(view)
        rest(window)
        return window.panel("skin").map.content

    return change


def computed(design, view, name):
    name = signals_name(name)
    return new_graph().evaluate({name}, sources(design, view))[name]


def test_the_map_shows_the_skin_where_the_playhead_is(window, look):
    content = look(window, playhead_s=0.0751, quantity=Z)
    moving = computed(SHORT, window.document.view, Z)
    assert content.values == pytest.approx(moving.acceleration(0.0751)[:, 0])
    assert content.colours == DIVERGING
    assert content.value_range[0] == -content.value_range[1]
    surface = new_graph().evaluate({"surface"}, sources(SHORT, window.document.view))["surface"]
    field = surface.interpolate(moving.acceleration(0.0751)[:, 0])
    assert content.field_values[surface.mask] == pytest.approx(field[surface.mask])
    content = look(window, quantity=MAGNITUDE)
    vector = computed(SHORT, window.document.view, MAGNITUDE)
    assert content.values == pytest.approx(ss.decibels(vector.magnitude(0.0751)))
    content = look(window, quantity=RMS, rms_window_s=0.05)
    energy = computed(SHORT, window.document.view, RMS)
    assert content.values == pytest.approx(ss.decibels(energy.rms(0.0751, 0.05)))
    # After the response there is silence.
    assert not look(window, quantity=Z, playhead_s=9.0).values.any()
    assert not window.panel("skin").is_stale
    levels = look(window, quantity=LEVELS)
    assert levels.values.max() < 0.0
    assert levels.quantity.name == LEVELS


def test_each_step_is_another_frame_and_evaluates_nothing(window, look, qtbot):
    look(window, quantity=Z)
    asked, levels_db = [], set()
    window.conductor.delivered.connect(asked.append)
    for k in range(40):
        content = look(window, playhead_s=0.06 + k / 1300 / 7)
        levels_db.add(float(content.values[28]))
    assert len(levels_db) == 40
    assert asked == []


def test_levels_and_hidden_maps_are_not_made_anew_at_each_step(window, look):
    content = look(window, playhead_s=0.07)
    assert look(window, playhead_s=0.08) is content
    look(window, quantity=Z)
    window.docks["skin"].hide()
    for time_s in (0.1, 0.11):
        look(window, playhead_s=time_s)
        assert window.panel("skin").content.quantity.time_s == 0.08
    window.docks["skin"].show()
    content = look(window)
    assert content.quantity.time_s == 0.11


def test_with_the_delay_removed_the_wave_comes_so_much_earlier(window, look):
    there = look(window, playhead_s=0.08, quantity=Z).values
    window.do("remove_delay")
    levels_db = look(window, playhead_s=0.08 - PRE_TRIGGER_DELAY_S).values
    assert levels_db == pytest.approx(there, abs=1e-9)
    scrub = window.panel("skin").scrub
    assert scrub.slider.maximum() / 1e4 == pytest.approx(
        (260 + 522 - 2) / 1300 - PRE_TRIGGER_DELAY_S, abs=1e-4
    )


def test_another_part_of_a_long_design_is_asked_for_once(open_window, look):
    window = open_window(LONG, View())
    look(window, playhead_s=1.0, quantity=Z)
    asked = []
    window.conductor.delivered.connect(asked.append)
    look(window, playhead_s=2.0)
    assert asked == []
    for time_s in (BLOCK_S + 1.0, BLOCK_S + 2.0, BLOCK_S + 3.0):
        content = look(window, playhead_s=time_s)
    assert len(asked) == 1
    assert not window.panel("skin").is_stale
    moving = computed(LONG, window.document.view, Z)
    assert content.values == pytest.approx(moving.acceleration(BLOCK_S + 3.0)[:, 0])
    # Far away nothing is known at first, and then all of it.
    content = look(window, playhead_s=38.0)
    moving = computed(LONG, window.document.view, Z)
    assert content.values == pytest.approx(moving.acceleration(38.0)[:, 0])


def test_the_map_says_when_and_whether_its_range_is_fixed(window, look):
    content = look(window, playhead_s=0.0751, quantity=Z)
    assert not content.fixed
    assert content.quantity.heading == "Skin acceleration along z, at 75.1 ms"
    bar = window.panel("skin").colour_bar
    assert bar.limit_field.isVisible()
    bar.range_chosen.emit((-0.2, 0.2))
    content = look(window)
    assert content.fixed
    assert content.value_range == (-0.2, 0.2)
    bar.range_chosen.emit(None)
    assert not look(window).fixed


def test_scrubbing_moves_the_one_playhead(window, look):
    look(window, quantity=Z)
    scrub = window.panel("skin").scrub
    scrub.slider.setValue(1234)
    assert window.document.view.playhead_s == pytest.approx(0.1234)
    assert scrub.time.text() == "123.4 ms"
    assert window.panel("skin").map.content.quantity.time_s == pytest.approx(0.1234)
    QTest.keyClick(scrub.slider, Qt.Key.Key_Right)
    assert window.document.view.playhead_s == pytest.approx(0.1244)
    # What is shown elsewhere is shown here.
    look(window, playhead_s=0.3)
    assert scrub.slider.value() == 3000


def test_what_is_chosen_in_the_measure_line_is_what_is_shown(window, look):
    panel = window.panel("skin")
    assert not panel.scrub.isVisible()
    choose(panel.measure.quantity, "Animation: sliding RMS")
    look(window)
    assert settings_of(window.document.view, "skin", SkinSettings).quantity == RMS
    assert panel.scrub.pace.isVisible()
    assert panel.measure.rms_window.isVisible()
    panel.scrub.pace.setCurrentIndex(panel.scrub.pace.findData("20"))
    panel.scrub.pace.activated.emit(panel.scrub.pace.currentIndex())
    assert window.document.view.slow_motion == 20.0
    # Space plays then, and opens no list.
    assert window.focusWidget() is panel.map
    assert window.document.undo_stack.count() == 0


def test_while_time_runs_the_wave_moves_in_place_of_its_level(window, look, qtbot):
    panel, view = window.panel("skin"), window.document.view
    levels = look(window)
    window.do("play")
    qtbot.waitUntil(lambda: panel.content.quantity.name == Z, timeout=10_000)
    assert panel.measure.quantity.accessibleDescription() == "Animation"
    # The map keeps its place, and a choice of colours is none of a quantity.
    assert not panel.scrub.isVisible()
    choose(panel.measure.unit, "Magma")
    assert settings_of(window.document.view, "skin", SkinSettings).quantity == LEVELS
    window.do("play")
    assert panel.content.quantity == levels.quantity
    assert panel.content.values == pytest.approx(levels.values)
    assert window.document.view.playhead_s == view.playhead_s
