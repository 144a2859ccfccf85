"""Workspaces: what stands where at first, and what a user makes of it."""

import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource import View, save_design
from skinsource_gui.plots.axis import Axis
from skinsource_gui.plots.plot import Plot
from skinsource_gui.qt.labels import FittingLabel
from skinsource_gui.shell.docks import Dock
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.shell.workspaces import WORKSPACES, shared
from tests.gui.dock_bench import in_sight
from tests.gui.shared_window import rest
from tests.gui.test_panels_fit import cut_texts

COMPOSE, ANALYSE, PRESENT, LAB = (f"arrange_{workspace.name}" for workspace in WORKSPACES)
SMALL, LARGE = (1366, 688), (1920, 1000)


@pytest.fixture
def window(open_window):
    window = open_window()
    yield window
    window.appearance.reset_text()


@pytest.fixture
def settle(window, qtbot):
    """Wait until results are shown and docks stand."""

    def wait():
        for _ in range(2):
            rest(window)
            qtbot.waitUntil(lambda: window.workspaces.settled)

    return wait


@pytest.fixture
def session(make_window, preferences, monkeypatch):
    """Open a window as the last session left it."""
    do = MainWindow.do
    monkeypatch.setattr(MainWindow, "do", lambda self, name: self.isVisible() and do(self, name))
    return make_window


def place(window, name):
    dock = window.docks[name]
    return QRect(dock.mapTo(window, QPoint()), dock.size())


def sizes(window):
    return {name: window.docks[name].size() for name in in_sight(window)}


def drag_line(window, by_px):
    """Drag the line between the skin and what stands right of it."""
    at = place(window, "skin").topRight() + QPoint(3, 100)
    QTest.mousePress(window, Qt.MouseButton.LeftButton, pos=at)
    for step in (by_px // 2, by_px):
        QTest.mouseMove(window, at + QPoint(step, 0))
        QApplication.processEvents()
    QTest.mouseRelease(
        window, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, at + QPoint(by_px, 0)
    )
    QApplication.processEvents()


def numbers(plot):
    """How many numbers are written at each axis."""
    axes = [item for item in plot.scene().items() if isinstance(item, Axis) and item.isVisible()]
    return [len(axis.labels()) for axis in axes]


def test_in_compose_the_skin_is_a_column_of_the_full_height_beside_the_rest(window, settle):
    for size in (SMALL, LARGE):
        window.resize(*size)
        settle()
        skin, hand, inspector, traces, spectra, timeline = (
            place(window, name)
            for name in ("skin", "hand", "inspector", "traces", "spectra", "timeline")
        )
        assert skin.width() == pytest.approx(0.31 * size[0], rel=0.02)
        assert skin.top() == hand.top() == inspector.top() == traces.top()
        assert skin.bottom() == pytest.approx(timeline.bottom(), abs=2)
        assert skin.right() < hand.left() < inspector.left() < traces.left() == spectra.left()
        assert traces.bottom() < spectra.top() < spectra.bottom() < timeline.top()
        assert hand.left() == pytest.approx(timeline.left(), abs=2)
        assert traces.right() == pytest.approx(timeline.right(), abs=2)


@pytest.mark.parametrize(("size", "scale"), [(SMALL, 1.0), (SMALL, 3.0), (LARGE, 1.5)])
def test_nothing_is_cut_or_scrolls_sideways(window, settle, size, scale):
    window.resize(*size)
    window.preferences.text_scale = scale
    window.appearance.apply()
    for workspace in (COMPOSE, ANALYSE, PRESENT, LAB):
        window.do(workspace)
        settle()
        assert (window.width(), window.height()) == size
        areas = {name: window.docks[name].widget() for name in in_sight(window)}
        wide = [n for n, area in areas.items() if area.widget().width() > area.viewport().width()]
        cut = [text for name in areas for text in cut_texts(window.panel(name), FittingLabel)]
        assert (workspace, wide, cut) == (workspace, [], [])
        for name in ("traces", "spectra"):
            window.docks[name].bring_forward()
            settle()
            (plot,) = window.panel(name).findChildren(Plot)
            assert min(numbers(plot)) >= 2, (workspace, name)


def test_hidden_panels_come_up_as_tabs_and_squeeze_none(window, settle):
    for workspace in WORKSPACES:
        window.do(f"arrange_{workspace.name}")
        settle()
        first = sizes(window)
        assert set(first) == set(workspace.split.panels())
        shown = {name for name, dock in window.docks.items() if not dock.isHidden()}
        assert shown.difference(first) == ({"analysis"} if workspace.name == "analysis" else set())
        for name in {"timeline", "clip_editor", "compare", "analysis"}.difference(first):
            dock = window.docks[name]
            dock.bring_forward()
            QApplication.processEvents()
            assert dock.in_sight
            host = workspace.hosts.get(name, workspace.host)
            assert window.docks[host] in window.tabifiedDockWidgets(dock)
        for name in first:
            window.docks[name].bring_forward()
        settle()
        now = sizes(window)
        assert {name: now[name].width() for name in first} == {
            name: size.width() for name, size in first.items()
        }


@pytest.mark.parametrize(
    ("whole", "shares", "least", "expected"),
    [
        (100, [50, 50], [10, 10], [50, 50]),
        (100, [10, 90], [30, 10], [30, 70]),
        (100, [10, 30, 60], [30, 30, 10], [30, 30, 40]),
    ],
)
def test_each_part_gets_its_share_but_no_less_than_it_needs(whole, shares, least, expected):
    assert shared(whole, shares, least) == expected


def test_each_workspace_is_remembered_until_it_is_reset(window, settle):
    settle()
    first, wide = in_sight(window), place(window, "skin").width()
    drag_line(window, 60)
    assert place(window, "skin").width() == pytest.approx(wide + 60, abs=5)
    window.docks["spectra"].hide()
    window.docks["compare"].bring_forward()
    own = in_sight(window)
    window.do(ANALYSE)
    settle()
    assert window.actions_by_name[ANALYSE].isChecked()
    assert "spectra" in in_sight(window)
    window.docks["traces"].hide()
    window.do(COMPOSE)
    assert in_sight(window) == own
    assert place(window, "skin").width() == pytest.approx(wide + 60, abs=5)
    window.do(COMPOSE)
    assert in_sight(window) == own
    window.do("reset_workspace")
    settle()
    assert in_sight(window) == first
    assert place(window, "skin").width() == pytest.approx(wide, abs=2)
    window.do(ANALYSE)
    assert "traces" not in in_sight(window)


def test_a_session_goes_on_where_the_last_one_ended(session, preferences):
    window = session()
    # The first window fills the screen.
    assert not window.workspaces.is_placed
    window.resize(780, 660)
    QApplication.processEvents()
    window.docks["inspector"].hide()
    own = in_sight(window)
    window.do(ANALYSE)
    QApplication.processEvents()
    window.docks["spectra"].hide()
    window.close()
    assert preferences.screen == "800 x 800 at 1"
    again = session()
    assert again.workspaces.is_placed
    # The tab behind what was hidden comes up.
    assert in_sight(again) == {"skin", "traces", "analysis"}
    again.do(COMPOSE)
    assert in_sight(again) == own
    again.close()
    # On another screen the same panels are hidden, and sizes do not count.
    preferences.screen = "1920 x 1080 at 2"
    elsewhere = session()
    assert not elsewhere.workspaces.is_placed
    assert "inspector" not in in_sight(elsewhere)


def test_what_folds_out_below_keeps_its_height_in_a_session_of_another_size(
    session, preferences, qtbot
):
    window = session()
    window.resize(*LARGE)
    qtbot.waitUntil(lambda: window.workspaces.settled)
    window.docks["library"].bring_forward()
    window.close()
    preferences.screen = "1440 x 900 at 1"
    again = session()
    for size in ((1440, 860), (1500, 860)):
        again.resize(*size)
        height = again.panel("library").sizeHint().height()
        qtbot.waitUntil(lambda: again.workspaces.settled)
        qtbot.waitUntil(lambda height=height: again.docks["library"].height() == height)
        assert place(again, "library").width() == size[0]
        assert "library" in in_sight(again)


def test_a_panel_that_floated_is_in_front_of_the_window_again(session, qtbot, monkeypatch):
    window = session()
    window.docks["inspector"].setFloating(True)
    window.close_unasked()
    shown = []
    show_of = {kind: kind.showEvent for kind in (Dock, MainWindow)}

    def note(shown_window, event):
        # Qt asks the desktop for the window after this.
        shown.append(shown_window.objectName())
        show_of[type(shown_window)](shown_window, event)

    for kind in show_of:
        monkeypatch.setattr(kind, "showEvent", note)
    again = session()
    # Of windows that are shown the last one is in front.
    qtbot.waitUntil(lambda: shown[-1] == "inspector")
    assert "studio" in shown
    assert again.docks["inspector"].isFloating()
    assert again.docks["inspector"].isVisible()


def test_a_file_leaves_the_arrangement_as_it_is(window, settle, tmp_path):
    path = tmp_path / "elsewhere.skinsource"
    settle()
    before = sizes(window)
    window.docks["library"].bring_forward()
    window.docks["spectra"].hide()
    save_design(path, window.document.design, View(), layout=window.workspaces.content())
    window.do("reset_workspace")
    settle()
    window.files.open(path)
    settle()
    assert sizes(window) == before
    # The layout of a copy of unsaved work may be damaged, or of another studio.
    window.workspaces.put(b"nonsense")
    assert sizes(window) == before


def test_an_arrangement_too_large_for_the_screen_gives_its_panels_the_room_there_is(window, settle):
    window.resize(*LARGE)
    settle()
    drag_line(window, 60)
    window.docks["hand"].hide()
    window.docks["compare"].bring_forward()
    own, layout = in_sight(window), window.workspaces.content()
    window.resize(*SMALL)
    window.do("reset_workspace")
    settle()
    first = sizes(window)
    window.workspaces.put(layout)
    settle()
    assert in_sight(window) == own
    assert all(sizes(window)[name].width() >= first[name].width() for name in own & set(first))


def test_what_became_of_an_arrangement_too_large_for_the_screen_is_remembered(window, settle):
    window.resize(*LARGE)
    settle()
    drag_line(window, 60)
    layout = window.workspaces.content()
    window.resize(*SMALL)
    window.do("reset_workspace")
    settle()
    window.workspaces.put(layout)
    settle()
    fitted = window.workspaces.content()
    window.workspaces.close()
    assert window.preferences.own_arrangements["design"] == fitted != layout


def test_a_scene_opens_on_the_stage_and_the_own_arrangement_comes_back(window, settle):
    window.docks["hand"].hide()
    own = in_sight(window)
    window.scenes.open("1C")
    settle()
    assert window.actions_by_name[PRESENT].isChecked()
    assert in_sight(window) == {"stage"}
    window.do(COMPOSE)
    assert in_sight(window) == own


def present(window, settle, qtbot):
    size = window.size()
    window.do("present")
    settle()
    window.do("present")
    window.showNormal()
    window.resize(size)
    qtbot.waitUntil(lambda: window.size() == size)
    settle()


def test_a_line_that_was_dragged_stays_where_it_is_after_presenting(window, settle, qtbot):
    settle()
    drag_line(window, 60)
    wide = place(window, "skin").width()
    present(window, settle, qtbot)
    assert place(window, "skin").width() == pytest.approx(wide, abs=3)


def test_panels_that_nobody_moved_make_room_for_larger_letters(window, settle, qtbot):
    present(window, settle, qtbot)
    assert {"traces", "spectra", "hand"} <= in_sight(window)
    window.preferences.text_scale = 3.0
    window.appearance.apply()
    settle()
    assert {"hand", "skin", "timeline"} <= in_sight(window)
    assert not {"traces", "spectra", "inspector"} & in_sight(window)


def test_panels_that_a_user_moved_stay_where_they_are(window, settle, qtbot):
    settle()
    window.docks["hand"].hide()
    present(window, settle, qtbot)
    window.preferences.text_scale = 3.0
    window.appearance.apply()
    settle()
    assert in_sight(window) == {"skin", "inspector", "traces", "spectra", "timeline"}


@pytest.mark.parametrize(("name", "panel"), [(ANALYSE, "skin"), (PRESENT, "stage")])
def test_another_workspace_leaves_the_keyboard_with_the_panels(window, active, settle, name, panel):
    window.panel("skin").setFocus()
    window.do(name)
    settle()
    assert window.panel(panel).isAncestorOf(QApplication.focusWidget())
    window.do(COMPOSE)
    window.panel("hand" if name == ANALYSE else "timeline").setFocus()
    window.do(name)
    settle()
    focused = QApplication.focusWidget()
    assert any(window.panel(panel).isAncestorOf(focused) for panel in in_sight(window))
