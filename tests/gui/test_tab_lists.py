"""The list of the panels in one place: a button where tabs do not fit, the right button, a key."""

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QPoint, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu, QToolButton

from tests.gui.dock_bench import bar_with, bars, click_tab, in_sight, titles

MANY = ("compare", "history", "library", "actuator", "playback", "statistics", "spectrogram")


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
    assert ticked(menu) == ["Spectrogram"]
    menu.actions()[entries(menu).index("History")].trigger()
    menu.close()
    settle()
    assert "history" in in_sight(crowded)
    assert "spectrogram" not in in_sight(crowded)
    assert crowded.panel("history").isAncestorOf(crowded.focusWidget())
    assert button.isVisible()
    for name in MANY[1:]:
        crowded.docks[name].hide()
    settle()
    assert titles(bar_with(crowded, "Inspector")) == ["Inspector", "Compare"]
    assert not bar_with(crowded, "Inspector").findChild(QToolButton, "tab_list").isVisible()


def test_button_and_arrows_stand_beside_each_other_and_cover_no_tab_in_front(crowded, settle):
    for title in ("Inspector", "Playback", "Spectrogram"):
        crowded.docks[title.lower()].bring_forward()
        settle()
        bar = bar_with(crowded, title)
        ends = [
            bar.findChild(QToolButton, name).geometry()
            for name in ("ScrollLeftButton", "ScrollRightButton", "tab_list")
        ]
        # Qt lets the last pixel of a tab lie below the arrow.
        front = bar.tabRect(bar.currentIndex()).adjusted(0, 0, -1, 0)
        assert all(bar.rect().contains(arrow) for arrow in ends)
        assert not any(arrow.intersects(front) for arrow in ends)
        assert [arrow.left() for arrow in ends[1:]] == [arrow.right() + 1 for arrow in ends[:2]]


def test_where_all_tabs_fit_there_is_no_button_and_the_right_button_lists_them(window, settle):
    window.docks["traces"].hide()
    window.tabifyDockWidget(window.docks["spectra"], window.docks["statistics"])
    window.docks["statistics"].show()
    settle()
    bar = bar_with(window, "Spectra")
    assert not bar.findChild(QToolButton, "tab_list").isVisible()
    event = QContextMenuEvent(
        QContextMenuEvent.Reason.Mouse, QPoint(4, 4), bar.mapToGlobal(QPoint(4, 4))
    )
    QApplication.sendEvent(bar, event)
    menu = open_list(window)
    assert entries(menu) == ["Spectra", "Statistics"]
    menu.close()


def test_the_key_lists_the_tabs_where_the_keyboard_is(crowded, settle):
    crowded.tabifyDockWidget(crowded.docks["traces"], crowded.docks["spectra"])
    settle()
    click_tab(crowded, "Spectra")
    crowded.panel("spectra").setFocus()
    for name, front in (("spectra", "Spectra"), ("spectrogram", "Spectrogram")):
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
