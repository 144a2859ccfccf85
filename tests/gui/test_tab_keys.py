"""Tabs of panels by keys, clicks and menu."""

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication, QMenu, QStyleOptionDockWidget

from tests.gui.dock_bench import bar_with, bars, click_tab, in_sight, titles


@pytest.fixture
def active(window, qtbot):
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    return window


def test_bars_of_tabs_say_what_they_are_and_are_no_stop_for_the_keyboard(active):
    active.tabifyDockWidget(active.docks["hand"], active.docks["skin"])
    active.docks["library"].bring_forward()
    shared_bars = [bar for bar in bars(active) if bar.count() > 1]
    assert len(shared_bars) == 2
    assert {bar.accessibleName() for bar in shared_bars} == {"Panels in one place"}
    assert {bar.focusPolicy() for bar in shared_bars} == {Qt.FocusPolicy.NoFocus}


def test_ctrl_tab_shows_what_shares_the_place_of_the_keyboard_and_takes_it_along(active, settle):
    active.docks["library"].bring_forward()
    active.docks["history"].bring_forward()
    settle()
    active.panel("history").setFocus()
    visited = []
    for _ in range(3):
        active.do("next_tab")
        settle()
        focused = QApplication.focusWidget()
        visited.append(next(p.name for p in active.panels if p.isAncestorOf(focused)))
        assert visited[-1] in in_sight(active)
    names = [active.panel(name).title for name in visited]
    row = titles(bar_with(active, "Library"))
    start = row.index("History") + 1
    assert names == row[start:] + row[:start]
    active.do("previous_tab")
    assert visited[-2] in in_sight(active)


def test_ctrl_tab_from_elsewhere_goes_to_the_panels_that_share_a_place(active, settle):
    active.docks["library"].bring_forward()
    settle()
    active.panel("hand").setFocus()
    active.do("next_tab")
    assert "inspector" in in_sight(active)
    assert active.panel("inspector").isAncestorOf(QApplication.focusWidget())


def test_ctrl_tab_says_when_no_panels_share_a_place(window):
    window.do("next_tab")
    assert window.statusBar().currentMessage().startswith("No panel shares its place")


def test_a_click_on_a_tab_takes_the_keyboard_to_the_panel_it_shows_wherever_it_was(active):
    active.docks["library"].bring_forward()
    QApplication.processEvents()
    active.panel("library").setFocus()
    assert active.panel("library").isAncestorOf(QApplication.focusWidget())
    click_tab(active, "Inspector")
    assert active.panel("inspector").isAncestorOf(QApplication.focusWidget())
    active.panel("hand").setFocus()
    click_tab(active, "Library")
    assert active.panel("library").isAncestorOf(QApplication.focusWidget())


def test_the_panels_menu_ticks_what_is_there_and_brings_what_is_behind(window, settle):
    menu = next(menu for menu in window.findChildren(QMenu) if menu.title() == "Panels")
    entry = {action.text(): action for action in menu.actions()}
    assert {text for text, action in entry.items() if action.isChecked()} == {
        window.panel(name).title for name in in_sight(window)
    }
    entry["Library"].trigger()
    settle()
    assert entry["Library"].isChecked()
    assert "inspector" not in in_sight(window)
    assert entry["Inspector"].isChecked()
    entry["Inspector"].trigger()
    settle()
    assert "inspector" in in_sight(window)
    assert entry["Inspector"].isChecked()
    assert entry["Library"].isChecked()
    entry["Inspector"].trigger()
    settle()
    assert window.docks["inspector"].isHidden()
    assert not entry["Inspector"].isChecked()
    assert "library" in in_sight(window)


def test_a_tab_is_as_high_as_its_words(window):
    window.docks["library"].bring_forward()
    bar = bar_with(window, "Library")
    assert bar.height() >= bar.fontMetrics().height() + 8
    assert bar.tabRect(0).contains(QPoint(4, 4))


def test_no_name_of_a_tab_is_cut_however_many_share_a_place(window, settle):
    for name in ("compare", "history", "library", "playback", "actuator"):
        window.docks[name].bring_forward()
    settle()
    bar = bar_with(window, "Library")
    assert bar.elideMode() == Qt.TextElideMode.ElideNone
    for k in range(bar.count()):
        assert bar.tabRect(k).width() >= bar.fontMetrics().horizontalAdvance(bar.tabText(k))
    # The one in front lies within the bar, left of the arrows to the others.
    assert bar.tabRect(bar.currentIndex()).left() >= 0
    assert bar.tabRect(bar.currentIndex()).right() <= bar.width()


def title_of(dock):
    option = QStyleOptionDockWidget()
    dock.initStyleOption(option)
    return option.title


def test_what_a_tab_says_is_not_said_again_below_it(window, settle):
    dock = window.docks["inspector"]
    assert title_of(dock) == "Inspector"
    window.docks["library"].bring_forward()
    settle()
    assert (title_of(dock), title_of(window.docks["library"])) == ("", "")
    assert title_of(window.docks["hand"]) == "Hand"
    window.docks["library"].hide()
    settle()
    assert title_of(dock) == "Inspector"
    window.docks["library"].show()
    window.docks["library"].setFloating(True)
    settle()
    assert title_of(window.docks["library"]) == "Library"
