"""Windows fit the screen that is there; those that stood on one that is gone come back."""

import pytest
from PySide6.QtCore import QMargins, QRect
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QWidget

from skinsource_gui.qt.windows import fit_by_guess, fitted
from skinsource_gui.shell.appearance import place_in_sight
from skinsource_gui.shell.presenting import NotesWindow
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


LEFT, RIGHT = QRect(0, 0, 1366, 768), QRect(1366, 0, 1920, 1080)


@pytest.mark.parametrize(
    ("frame", "rooms", "place"),
    [
        # Where it is seen, or most of it, it stays.
        (QRect(100, 50, 560, 420), [LEFT], QRect(100, 50, 560, 420)),
        (QRect(1500, 50, 560, 420), [LEFT, RIGHT], QRect(1500, 50, 560, 420)),
        (QRect(1100, 50, 500, 420), [LEFT], QRect(1100, 50, 500, 420)),
        # Where it stood is gone, or an edge of it is left.
        (QRect(1771, 214, 560, 420), [LEFT], QRect(806, 214, 560, 420)),
        (QRect(1312, 214, 560, 420), [LEFT], QRect(806, 214, 560, 420)),
        (QRect(-900, -900, 560, 420), [LEFT, RIGHT], QRect(0, 0, 560, 420)),
        # Of two that are left, the nearer one; no larger than that.
        (QRect(4000, 200, 560, 420), [LEFT, RIGHT], QRect(2726, 200, 560, 420)),
        (QRect(1366, 0, 1920, 1080), [LEFT], QRect(0, 0, 1366, 768)),
        (QRect(1366, 0, 1920, 1080), [], QRect(1366, 0, 1920, 1080)),
    ],
)
def test_a_window_is_moved_as_little_as_brings_it_into_sight(frame, rooms, place):
    assert place_in_sight(frame, rooms) == place


def test_notes_come_back_when_their_screen_is_gone(window, qtbot):
    window.do("show_notes")
    notes = window.findChild(NotesWindow)
    stood = window.frameGeometry()
    notes.move(5000, 300)
    assert not any(
        screen.geometry().intersects(notes.frameGeometry()) for screen in QGuiApplication.screens()
    )
    QGuiApplication.instance().screenRemoved.emit(window.screen())
    room = window.screen().availableGeometry()
    qtbot.waitUntil(lambda: room.contains(notes.frameGeometry()))
    assert window.frameGeometry() == stood
    notes.close()
