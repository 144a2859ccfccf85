"""Docks that share a place: one in front, the others as tabs; keys, clicks and menus for them."""

import random

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QHoverEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from skinsource_gui.shell.workspaces import WORKSPACES
from tests.gui.dock_bench import bar_with, bars, click_tab, in_sight, titles
from tests.gui.menus import close_menus, lines_at


def with_keyboard(window):
    """The name of the panel that has the keyboard."""
    focused = QApplication.focusWidget()
    return next((panel.name for panel in window.panels if panel.isAncestorOf(focused)), None)


def test_nothing_is_computed_for_a_panel_behind_another_one(window, settle):
    requests = []
    window.conductor.delivered.connect(lambda outcome: requests.append(outcome.request.wanted))
    window.tabifyDockWidget(window.docks["traces"], window.docks["spectra"])
    settle()
    click_tab(window, "Traces")
    others = (panel.needs for panel in window.panels if panel.name != "spectra")
    own = window.panel("spectra").needs.difference(*others)
    assert own
    window.document.edit("a", window.document.design.with_input(0, amplitude=2.0))
    settle()
    assert "selected_traces" in requests[-1]
    assert not requests[-1] & own
    drawn = []
    window.panel("traces").show_results = drawn.append
    click_tab(window, "Spectra")
    settle()
    assert requests[-1] >= own
    window.document.edit("b", window.document.design.with_input(0, amplitude=3.0))
    settle()
    assert "selected_traces" not in requests[-1]
    drawn.clear()
    click_tab(window, "Traces")
    settle()
    assert len(drawn) == 1


def test_whatever_is_done_to_docks_just_those_in_front_are_shown(window, settle):
    chance = random.Random(1)  # noqa: S311
    docks = list(window.docks.values())[:12]
    saved = [window.saveState()]

    def act():
        dock, other = chance.sample(docks, 2)
        way = chance.choice(list(Qt.Orientation))
        workspace = chance.choice(WORKSPACES).name
        chance.choice(
            [
                lambda: window.tabifyDockWidget(dock, other),
                lambda: window.splitDockWidget(dock, other, way),
                lambda: dock.setFloating(not dock.isFloating()),
                dock.hide,
                dock.show,
                dock.raise_,
                dock.bring_forward,
                lambda: window.do(f"arrange_{workspace}"),
                lambda: window.do("reset_workspace"),
                lambda: saved.append(window.saveState()),
                lambda: window.restoreState(chance.choice(saved)),
                lambda: window.workspaces.put(chance.choice(saved).data()),
            ]
        )()

    for _ in range(40):
        act()
        shared_bars = [bar for bar in bars(window) if bar.count() > 1]
        for dock in docks:
            front = window.childAt(dock.geometry().center())
            visible = dock.isFloating() or front is dock or dock.isAncestorOf(front)
            assert dock.panel.isVisible() == (dock.isVisible() and visible), dock.objectName()
        assert all(bar.focusPolicy() == Qt.FocusPolicy.NoFocus for bar in shared_bars)
    settle()


def test_ctrl_tab_shows_what_shares_the_place_of_the_keyboard_and_takes_it_along(active, settle):
    active.docks["analysis"].bring_forward()
    active.docks["compare"].bring_forward()
    settle()
    active.panel("compare").setFocus()
    visited = []
    for _ in range(3):
        active.do("next_tab")
        settle()
        visited.append(with_keyboard(active))
        assert visited[-1] in in_sight(active)
    names = [active.panel(name).title for name in visited]
    row = titles(bar_with(active, "Analysis"))
    start = row.index("Compare") + 1
    assert names == row[start:] + row[:start]
    active.do("previous_tab")
    assert visited[-2] in in_sight(active)


def test_a_click_on_a_tab_takes_the_keyboard_to_the_panel_it_shows_wherever_it_was(active):
    active.docks["compare"].bring_forward()
    QApplication.processEvents()
    active.panel("compare").setFocus()
    click_tab(active, "Timeline")
    assert with_keyboard(active) == "timeline"
    active.panel("hand").setFocus()
    click_tab(active, "Compare")
    assert with_keyboard(active) == "compare"


def test_the_right_button_floats_and_closes_the_panel_of_a_tab(active, settle):
    active.docks["compare"].bring_forward()
    settle()
    bar = bar_with(active, "Compare")
    at = bar.tabRect(titles(bar).index("Compare")).center()
    bar.customContextMenuRequested.emit(at)
    QApplication.processEvents()
    menu = active.findChild(QMenu, "tab_menu")
    assert [action.text() for action in menu.actions()] == ["Float Compare", "Close Compare"]
    menu.actions()[1].trigger()
    menu.close()
    assert active.docks["compare"].isHidden()


def test_keys_for_tabs_say_when_no_panels_share_a_place(window):
    window.do("next_tab")
    assert window.statusBar().currentMessage().startswith("No panel shares its place")


def test_the_panels_menu_ticks_what_is_there_and_brings_what_is_behind(active, settle):
    window = active
    menu = next(menu for menu in window.findChildren(QMenu) if menu.title() == "Panels")
    entry = {action.text(): action for action in menu.actions()}
    assert {text for text, action in entry.items() if action.isChecked()} == {
        window.panel(name).title for name in in_sight(window)
    }
    entry["Compare"].trigger()
    settle()
    assert with_keyboard(window) == "compare"
    assert entry["Compare"].isChecked()
    assert "timeline" not in in_sight(window)
    assert entry["Timeline"].isChecked()
    entry["Timeline"].trigger()
    settle()
    assert "timeline" in in_sight(window)
    assert entry["Compare"].isChecked()
    entry["Timeline"].trigger()
    settle()
    assert window.docks["timeline"].isHidden()
    assert not entry["Timeline"].isChecked()
    assert "compare" in in_sight(window)


def test_the_key_of_the_clip_editor_shows_it_and_goes_back(active, qtbot):
    before, lanes = in_sight(active), active.panel("timeline").lanes
    size = lanes.size()
    active.panel("timeline").setFocus()
    active.do("show_clip_editor")
    assert in_sight(active) == before - {"timeline"} | {"clip_editor"}
    assert with_keyboard(active) == "clip_editor"
    active.do("show_clip_editor")
    assert in_sight(active) == before
    assert with_keyboard(active) == "timeline"
    # No tab stays, which would take some of its height.
    qtbot.waitUntil(lambda: lanes.size() == size)


def test_a_panel_that_goes_leaves_the_keyboard_to_another_one(active, qtbot):
    active.panel("hand").setFocus()
    active.docks["hand"].hide()
    qtbot.waitUntil(lambda: with_keyboard(active) == "timeline")
    # To the one that comes in front of it.
    active.docks["compare"].bring_forward()
    active.panel("compare").setFocus()
    active.docks["timeline"].raise_()
    qtbot.waitUntil(lambda: with_keyboard(active) == "timeline")


def test_a_dock_has_a_title_only_while_it_floats(window, settle):
    for dock in window.docks.values():
        assert dock.titleBarWidget() is not None
        assert dock.titleBarWidget().height() <= 1 or not dock.isVisible()
    timeline = window.docks["timeline"]
    top = timeline.mapTo(window, timeline.widget().geometry().topLeft())
    assert top == timeline.mapTo(window, QPoint())
    timeline.setFloating(True)
    QApplication.processEvents()
    assert timeline.titleBarWidget() is None
    timeline.setFloating(False)
    QApplication.processEvents()
    assert timeline.titleBarWidget() is not None


def test_the_right_button_and_keys_float_and_close_a_panel(active, qtbot):
    dock = active.docks["hand"]
    entries = lines_at(dock, "dock_menu", active.panel("hand"), QPoint(2, 2))
    assert set(entries) == {"Float Hand", "Close Hand"}
    entries["Float Hand"].trigger()
    close_menus(dock, "dock_menu")
    assert dock.isFloating()
    dock.activateWindow()
    dock.panel.setFocus()
    qtbot.waitUntil(lambda: dock.isAncestorOf(QApplication.focusWidget()))
    active.do("float_panel")
    assert not dock.isFloating()
    active.activateWindow()
    qtbot.waitUntil(active.isActiveWindow)
    active.panel("inspector").setFocus()
    active.do("close_panel")
    assert active.docks["inspector"].isHidden()


@pytest.mark.parametrize(("height", "behind"), [(968, set()), (736, {"timeline"})])
def test_the_library_folds_out_of_the_lower_edge_and_is_a_tab_in_a_low_window(
    window, settle, height, behind
):
    window.resize(1366, height)
    settle()
    before, library, skin = in_sight(window), window.docks["library"], window.docks["skin"]
    room = skin.size()
    library.bring_forward()
    settle()
    assert in_sight(window) == before - behind | {"library"}
    assert (library.width() < window.width()) is bool(behind)
    assert 0.2 * window.height() <= library.height() <= 0.4 * window.height()
    # As a tab it takes no room from others.
    assert (skin.size() == room) is bool(behind)


@pytest.mark.parametrize("workspace", [workspace.name for workspace in WORKSPACES[1:]])
def test_a_key_after_the_edge_below_the_mouse_has_gone_with_its_docks_does_no_harm(
    window, settle, workspace
):
    content = window.workspaces.content()
    for change in (
        lambda: window.do(f"arrange_{workspace}"),
        lambda: window.workspaces.put(content),
    ):
        window.do("arrange_design")
        settle()
        hover_edge(window)
        change()
        # Otherwise Qt would end the studio at the key.
        assert window.cursor().shape() == Qt.CursorShape.ArrowCursor
        QTest.keyClick(window, Qt.Key.Key_F9)


def hover_edge(window):
    """Let the mouse rest between two docks that stand side by side."""
    for x in range(window.width()):
        here = QPointF(x, window.docks["hand"].geometry().center().y())
        moved = QHoverEvent(QEvent.Type.HoverMove, here, window.mapToGlobal(here), here)
        QApplication.sendEvent(window, moved)
        if window.cursor().shape() == Qt.CursorShape.SplitHCursor:
            return
    pytest.fail("no edge was found")


def test_a_second_analysis_opens_beside_the_first(window, settle):
    window.resize(1366, 688)
    settle()
    for name in ("analysis", "analysis_2"):
        window.docks[name].bring_forward()
    settle()
    first, second = window.docks["analysis"], window.docks["analysis_2"]
    assert {"analysis", "analysis_2", "inspector"} <= in_sight(window)
    assert second.width() == pytest.approx(first.width(), abs=8)
    assert second.widget().widget().width() <= second.widget().viewport().width()
