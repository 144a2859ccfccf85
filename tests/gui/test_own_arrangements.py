"""What the user made of an arrangement: neither a key nor a clip that is opened takes it away."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from skinsource.limbs.catalog import available_limbs
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import start_design


@pytest.fixture
def open_window(make_window):
    """Each test has a window of its own."""
    return make_window


def in_sight(window):
    QApplication.processEvents()
    QApplication.processEvents()
    return {panel.name for panel in window.panels if panel.isVisible()}


def width(window, name):
    QApplication.processEvents()
    return window.docks[name].width()


@pytest.fixture
def messages(window):
    answers = []
    window.layout_of_docks.done.connect(answers.append)
    return answers


@pytest.fixture
def active(window, qtbot):
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    return window


def test_opening_a_clip_leaves_all_other_panels_but_one_in_sight(active):
    before = in_sight(active)
    active.do("show_clip_editor")
    assert in_sight(active) == before - {"timeline"} | {"clip_editor"}
    assert active.panel("clip_editor").isAncestorOf(QApplication.focusWidget())


def test_the_same_key_goes_back_to_where_the_keyboard_was(active):
    before = in_sight(active)
    active.panel("timeline").setFocus()
    active.do("show_clip_editor")
    active.do("show_clip_editor")
    assert in_sight(active) == before
    assert active.panel("timeline").isAncestorOf(QApplication.focusWidget())


def test_the_key_of_another_arrangement_and_back_brings_ones_own(window, messages):
    window.docks["spectra"].hide()
    window.docks["history"].bring_forward()
    window.resizeDocks([window.docks["skin"]], [480], Qt.Orientation.Horizontal)
    own, wide = in_sight(window), width(window, "skin")
    window.do("arrange_analysis")
    assert "spectra" in in_sight(window)
    window.do("arrange_design")
    assert in_sight(window) == own
    assert width(window, "skin") == pytest.approx(wide, abs=3)
    assert messages == ["Panels as you had them; Alt+1 again shows them as at first"]


def test_the_key_of_the_present_arrangement_goes_to_and_fro(window, messages):
    first = in_sight(window)
    window.docks["traces"].hide()
    own = in_sight(window)
    for expected in (first, own, first, own):
        window.do("arrange_design")
        assert in_sight(window) == expected
    assert len(messages) == 4
    assert messages[0] == "Panels as at first; Alt+1 again brings yours back"


def test_ones_own_outlives_the_session(qtbot, preferences):
    def begin():
        window = MainWindow(
            start_design("synthetic-1"), preferences=preferences, available_limbs=available_limbs()
        )
        qtbot.addWidget(window, before_close_func=lambda window: window.runner.close())
        window.show()
        qtbot.waitUntil(lambda: not window.engine.busy)
        return window

    window = begin()
    window.docks["traces"].hide()
    own = in_sight(window)
    window.do("arrange_analysis")
    QApplication.processEvents()
    window.close()
    again = begin()
    assert "traces" in in_sight(again)
    again.do("arrange_design")
    assert in_sight(again) == own
    again.close()
