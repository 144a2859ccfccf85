"""Tabs of panels by keys, clicks and menu."""

import pytest
from PySide6.QtWidgets import QApplication, QMenu

from tests.gui.dock_bench import bar_with, click_tab, in_sight, titles


@pytest.fixture
def open_window(make_window):
    """Each test has a window of its own."""
    return make_window


@pytest.fixture
def active(window, qtbot):
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    return window


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
