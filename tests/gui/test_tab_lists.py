"""The list of the panels in one place: a button where tabs do not fit, the right button, a key."""

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu, QToolButton

from tests.gui.dock_bench import bar_with, bars, click_tab, in_sight, titles

MANY = ("compare", "history", "library", "actuator", "playback", "analysis")


@pytest.fixture
def open_window(make_window):
    """Each test has a window of its own."""
    return make_window


def open_list(window):
    QApplication.processEvents()
    return window.findChild(QMenu, "tab_menu")


def entries(menu):
    return [action.text() for action in menu.actions()]


def ticked(menu):
    return [action.text() for action in menu.actions() if action.isChecked()]


@pytest.fixture
def crowded(window, settle):
    """A window in which the row of the inspector has more tabs than fit."""
    for name in MANY:
        window.docks[name].bring_forward()
    settle()
    return window


def test_where_tabs_do_not_fit_a_button_lists_all_and_brings_one_to_the_front(crowded, settle):
    bar = bar_with(crowded, "Inspector")
    button = bar.findChild(QToolButton, "tab_list")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    menu = open_list(crowded)
    assert entries(menu) == titles(bar)
    assert len(entries(menu)) == 1 + len(MANY)
    assert ticked(menu) == ["Analysis"]
    menu.actions()[entries(menu).index("History")].trigger()
    menu.close()
    settle()
    assert "history" in in_sight(crowded)
    assert "analysis" not in in_sight(crowded)
    assert crowded.panel("history").isAncestorOf(crowded.focusWidget())
    assert button.isVisible()
    for name in MANY[1:]:
        crowded.docks[name].hide()
    settle()
    assert titles(bar_with(crowded, "Inspector")) == ["Inspector", "Compare"]
    assert not bar_with(crowded, "Inspector").findChild(QToolButton, "tab_list").isVisible()


def test_the_key_lists_the_tabs_where_the_keyboard_is(crowded, settle):
    crowded.tabifyDockWidget(crowded.docks["traces"], crowded.docks["spectra"])
    settle()
    click_tab(crowded, "Spectra")
    crowded.panel("spectra").setFocus()
    for name, front in (("spectra", "Spectra"), ("analysis", "Analysis")):
        crowded.docks[name].bring_forward()
        crowded.panel(name).setFocus()
        crowded.do("list_tabs")
        menu = open_list(crowded)
        assert ticked(menu) == [front]
        assert menu.activeAction().text() == front
        menu.close()
        QCoreApplication.sendPostedEvents(menu, QEvent.Type.DeferredDelete)


def test_without_tabs_the_key_says_what_brings_some(window, settle):
    messages = []
    window.dock_tabs.done.connect(messages.append)
    for dock in window.docks.values():
        if window.tabifiedDockWidgets(dock):
            dock.hide()
    settle()
    assert not [bar for bar in bars(window) if bar.isVisible() and bar.count() > 1]
    window.do("list_tabs")
    assert open_list(window) is None
    assert messages == ["No panel shares its place with another one; View > Panels brings more"]
