import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from skinsource.signals.map_range import map_range_db
from skinsource_gui.panels.skin.settings import tick_levels
from skinsource_gui.plots.small_map import COLOURS
from tests.gui.skin.bench import (
    CONTROL,
    LEFT,
    PLAIN,
    drag,
)


def test_the_automatic_range_holds_the_loudest_output(window):
    assert window.panel.colour_bar.range_db == (-60.0, -10.0)
    assert window.panel.colour_bar.auto_button.isChecked()


def test_the_automatic_range_depends_on_the_present_levels_only(window):
    for loudest, top in (
        (-11.0, -10),
        (-5.0, -5),
        (-4.9, 0),
        (-8.1, -5),
        (-200.0, 0),
        (-17.9, -15),
        (-190.0, -150),
        (333.0, 200),
    ):
        assert map_range_db(np.array([-200.0, loudest])) == (top - 50.0, top)
    before = window.panel.colour_bar.range_db
    for by in (7.0, 0.0):
        window.deliver(output_levels_db=window.results["output_levels_db"] + by)
    assert window.panel.colour_bar.range_db == before


def test_a_handle_is_dragged(window):
    bar = window.panel.colour_bar
    drag(bar.strip.high, QPoint(10, 6), QPoint(10, 46))
    low, high = window.settings.map_range_db
    assert low == -60.0
    assert -20.0 < high < -10.0
    assert bar.range_db == (low, high)
    assert not bar.auto_button.isChecked()


def test_a_handle_pulled_past_the_other_stops_before_it(window):
    bar = window.panel.colour_bar
    drag(bar.strip.low, QPoint(10, 6), QPoint(10, -900))
    assert window.settings.map_range_db == (-11.0, -10.0)


def test_a_double_click_brings_the_automatic_range_back(window):
    window.show(map_range_db=(-30.0, -20.0))
    QTest.mouseDClick(window.panel.colour_bar.strip, LEFT, PLAIN, QPoint(17, 200))
    assert window.settings.map_range_db is None
    assert window.panel.colour_bar.range_db == (-60.0, -10.0)


def test_keys_move_a_handle_or_the_whole_range(window):
    strip = window.panel.colour_bar.strip
    QTest.keyClick(strip.high, Qt.Key.Key_Up)
    assert window.settings.map_range_db == (-60.0, -9.0)
    QTest.keyClick(strip.low, Qt.Key.Key_Down, CONTROL)
    assert window.settings.map_range_db == (-60.1, -9.0)
    QTest.keyClick(strip, Qt.Key.Key_PageUp)
    assert window.settings.map_range_db == pytest.approx((-50.1, 1.0))


@pytest.mark.parametrize(
    ("name", "typed", "range_db"),
    [
        ("high_field", "-100", (-150.0, -100.0)),
        ("high_field", "-59.5", (-109.5, -59.5)),
        ("high_field", "-59", (-60.0, -59.0)),
        ("high_field", "-190", (-200.0, -190.0)),
        ("low_field", "30", (30.0, 80.0)),
        ("low_field", "190", (190.0, 200.0)),
    ],
)
def test_a_typed_end_pushes_the_other_one_before_it(window, name, typed, range_db):
    bar = window.panel.colour_bar
    field = getattr(bar, name)
    QTest.keyClicks(field, typed)
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert window.settings.map_range_db == range_db
    assert (bar.low_field.value_si, bar.high_field.value_si) == range_db


def test_an_end_that_leaves_no_room_for_the_other_is_refused_with_a_sentence(window):
    field = window.panel.colour_bar.high_field
    QTest.keyClicks(field, "-200")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert field.problem == (
        "Level of the highest colour: −200 dB is too low. Allowed: −199 to 200 dB."
    )
    assert window.views == []


def test_ticks_are_round_and_apart():
    assert tick_levels(-66.0, 6.0, room_px=200.0, spacing_px=24.0) == [
        -60,
        -50,
        -40,
        -30,
        -20,
        -10,
        0,
    ]
    assert tick_levels(-1.0, 0.0, room_px=200.0, spacing_px=24.0) == [-1.0, -0.5, 0.0]


def test_the_right_button_on_the_colour_bar_offers_the_colours(window):
    strip = window.panel.colour_bar.strip
    at = strip.rect().center()
    reason = QContextMenuEvent.Reason.Mouse
    QApplication.sendEvent(strip, QContextMenuEvent(reason, at, strip.mapToGlobal(at)))
    [menu] = strip.findChildren(QMenu, "colours_menu")
    offered = {action.text(): action for action in menu.actions()}
    assert list(offered) == [title for _, title in COLOURS.options]
    assert [text for text, action in offered.items() if action.isChecked()] == ["Viridis"]
    offered["Magma"].trigger()
    assert window.settings.colours == "magma"
    menu.close()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    assert not strip.findChildren(QMenu, "colours_menu")


def test_the_scale_goes_beyond_the_range_and_stays_while_it_is_dragged(window):
    bar = window.panel.colour_bar
    strip, at = bar.strip, QPoint(17, bar.strip.height() // 2)
    assert strip._axis_db == (-66.0, -4.0)
    window.show(map_range_db=(-60.0, 40.0))
    assert strip._axis_db == (-72.0, 52.0)
    window.show(map_range_db=(-60.0, -10.0))
    QTest.mousePress(strip, LEFT, PLAIN, at)
    QTest.mouseMove(strip, at - QPoint(0, 30))
    up_db = bar.range_db[1] + 10.0
    assert up_db > 0.0
    assert strip._axis_db == (-66.0, -4.0)
    # It is pulled from where it was, and back to it.
    QTest.mouseMove(strip, at + QPoint(0, 30))
    assert bar.range_db[1] == pytest.approx(-10.0 - up_db, abs=0.11)
    QTest.mouseMove(strip, at)
    assert bar.range_db == (-60.0, -10.0)
    QTest.mouseMove(strip, at - QPoint(0, 30))
    QTest.mouseRelease(strip, LEFT, PLAIN, at - QPoint(0, 30))
    assert strip._axis_db == pytest.approx((-66.0 + up_db, -4.0 + up_db))
    views = len(window.views)
    QTest.mouseMove(strip, at)
    assert len(window.views) == views
