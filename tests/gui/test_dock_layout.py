"""Where docks stand: between sessions, on other screens, and when a file is opened."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from skinsource.design.design_file import save_design
from skinsource.design.view import View
from skinsource.limbs.catalog import available_limbs
from skinsource_gui.shell.docks import Dock
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import start_design

# The screen of the tests is 800 x 800.
SIZE = (780, 660)


@pytest.fixture
def window(new_window):
    """A studio of each test's own."""
    return new_window


def sizes(window):
    QApplication.processEvents()
    return {name: dock.size() for name, dock in window.docks.items() if dock.isVisible()}


@pytest.fixture
def session(qtbot, preferences):
    """Open a window as the last session left it."""

    def begin():
        window = MainWindow(
            start_design("synthetic-1"), preferences=preferences, available_limbs=available_limbs()
        )
        qtbot.addWidget(window, before_close_func=lambda window: window.runner.close())
        window.show()
        qtbot.waitExposed(window)
        qtbot.waitUntil(lambda: not window.engine.busy)
        return window

    return begin


def test_opening_a_file_moves_no_splitter_and_shows_its_panels(window, settle, tmp_path):
    settle()
    path = tmp_path / "elsewhere.skinsource"
    window.resizeDocks([window.docks["skin"]], [620], Qt.Orientation.Horizontal)
    save_design(path, window.document.design, View(), layout=window.layout_of_docks.content())
    window.do("arrange_design")
    # Rows of switches above plots take the room they have a moment later.
    settle()
    settle()
    before = sizes(window)
    window.files.open(path)
    settle()
    assert sizes(window) == before
    window.docks["spectra"].hide()
    save_design(path, window.document.design, View(), layout=window.layout_of_docks.content())
    window.do("arrange_design")
    window.files.open(path)
    assert window.docks["spectra"].isHidden()
    # What a file says of the arrangement may be damaged, or of another studio.
    settle()
    before = sizes(window)
    window.layout_of_docks.show_panels(b"nonsense")
    settle()
    assert sizes(window) == before


def test_a_session_goes_on_where_it_was_left_on_the_same_screen(session, preferences):
    window = session()
    window.resize(*SIZE)
    window.docks["spectra"].hide()
    window.close()
    assert preferences.screen == "800 x 800 at 1"
    again = session()
    assert (again.width(), again.height()) == SIZE
    assert again.docks["spectra"].isHidden()


def test_sizes_of_another_screen_are_not_brought_back_but_hidden_panels_are(session, preferences):
    first = session()
    usual = first.size()
    first.resize(*SIZE)
    first.docks["spectra"].hide()
    first.close()
    preferences.screen = "1920 x 1080 at 2"
    again = session()
    assert again.size() == usual
    assert again.docks["spectra"].isHidden()
    assert again.docks["traces"].isVisible()


def test_a_panel_that_was_out_of_the_window_is_in_front_of_it_again(session, qtbot, monkeypatch):
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
    qtbot.waitUntil(lambda: shown[-1] == "inspector")
    # Of windows that are shown the last one is in front.
    assert "studio" in shown
    assert again.docks["inspector"].isFloating()
    assert again.docks["inspector"].isVisible()
