import pytest
from PySide6.QtCore import QMargins, QRect
from PySide6.QtWidgets import QWidget

from skinsource_gui.qt.screen_fit import fit_by_guess, fitted
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import start_design

WIDEST = QMargins(8, 31, 8, 8)
FRAMES = [QMargins(1, 24, 1, 5), WIDEST, QMargins(0, 37, 0, 0)]
#: Screens in logical pixels: 1366x768, 1080p at scale 1, 1.5 and 2.
SCREENS = [QRect(0, 0, 1366, 768), QRect(0, 0, 1920, 1080), QRect(0, 0, 1280, 720)]
SMALLEST = QRect(0, 0, 960, 540)


@pytest.mark.parametrize("frame", FRAMES)
@pytest.mark.parametrize("screen", [*SCREENS, SMALLEST])
@pytest.mark.parametrize("place", [QRect(0, 0, 1600, 940), QRect(900, 500, 700, 400)])
def test_window_and_frame_lie_on_the_screen(frame, screen, place):
    inside = fitted(place, screen, frame)
    assert screen.contains(inside.marginsAdded(frame))
    room = screen.marginsRemoved(frame)
    assert inside.size() == place.size().boundedTo(room.size())


def test_a_window_too_large_for_its_screen_is_fitted_onto_it_before_it_is_shown(qtbot):
    window = QWidget()
    qtbot.addWidget(window)
    window.resize(5000, 4000)
    fit_by_guess(window)
    room = window.screen().availableGeometry()
    assert room.contains(window.geometry())
    # There is room left for a frame, the widest part of which is above.
    assert window.geometry().top() > room.top()
    assert window.geometry().height() < room.height()


@pytest.mark.parametrize("arrangement", ["design", "analysis", "presentation"])
def test_the_studio_is_small_enough_for_1080p_at_scale_2(window, settle, arrangement):
    window.do(f"arrange_{arrangement}")
    room = SMALLEST.marginsRemoved(WIDEST).size()
    window.resize(room)
    settle()
    assert window.size() == room
    # Its status bar is seen, too.
    assert window.statusBar().geometry().bottom() < room.height()


def test_a_window_that_was_on_the_stage_starts_there(preferences):
    preferences.arrangement = "presentation"
    window = MainWindow(
        start_design("synthetic-1"), preferences=preferences, available_limbs=("synthetic-1",)
    )
    assert window.docks["stage"].isHidden() is False
    window.close_unasked()
