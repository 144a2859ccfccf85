"""Panels that nobody moved have room for larger letters, after presenting and later too."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from skinsource.limbs.catalog import available_limbs
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import start_design

BELOW_THE_MAP = {"traces", "spectra", "timeline"}


@pytest.fixture
def session(qtbot, preferences):
    """Begin where the last session ended, which ends."""
    windows = []

    def begin():
        if windows:
            end()
        window = MainWindow(
            start_design("synthetic-1"), preferences=preferences, available_limbs=available_limbs()
        )
        windows.append(window)
        qtbot.addWidget(window, before_close_func=lambda window: window.runner.close())
        window.show()
        window.resize(1366, 768)
        qtbot.waitExposed(window)
        return window

    def end():
        window = windows.pop()
        window.appearance.reset_text()
        window.appearance.fit_room(1.0)
        window.close()

    yield begin
    end()


@pytest.fixture
def stands(qtbot):
    """Wait until it is known how docks stand."""

    def wait(window):
        settling = window.layout_of_docks.settling
        timers = settling._widened, settling._settled
        qtbot.waitUntil(lambda: not any(timer.isActive() for timer in timers))
        qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)

    return wait


@pytest.fixture
def studio(session, stands):
    window = session()
    window.do("arrange_design")
    stands(window)
    assert in_sight(window) >= BELOW_THE_MAP
    return window


def in_sight(window):
    return {name for name, dock in window.docks.items() if dock.isVisible() and dock.in_sight}


def enlarge(window, stands):
    window.appearance._scale_text(3.0)
    stands(window)


def end_presenting(window, stands, qtbot):
    window.do("present")
    window.showNormal()
    qtbot.waitUntil(lambda: window.width() == 1366)
    stands(window)


def present(window, stands, qtbot):
    window.do("present")
    stands(window)
    end_presenting(window, stands, qtbot)


def test_after_presenting_panels_become_tabs_with_larger_letters(studio, stands, qtbot):
    present(studio, stands, qtbot)
    assert in_sight(studio) >= BELOW_THE_MAP
    enlarge(studio, stands)
    assert {"hand", "skin", "inspector"} <= in_sight(studio)
    assert not {"traces", "spectra"} & in_sight(studio)


def test_what_somebody_moved_stays_so_after_presenting(studio, stands, qtbot):
    studio.docks["hand"].hide()
    present(studio, stands, qtbot)
    enlarge(studio, stands)
    assert in_sight(studio) >= {"skin", "inspector", *BELOW_THE_MAP}
    assert "hand" not in in_sight(studio)


def test_a_bar_that_grows_moves_no_panel_but_a_splitter_does(studio, stands):
    settling = studio.layout_of_docks.settling
    studio.statusBar().setMinimumHeight(studio.statusBar().height() + 30)
    QApplication.processEvents()
    assert settling.untouched
    skin = studio.docks["skin"]
    studio.resizeDocks([skin], [skin.width() + 60], Qt.Orientation.Horizontal)
    QApplication.processEvents()
    assert not settling.untouched
