"""Windows that stood on a screen that is gone come back."""

import pytest
from PySide6.QtCore import QRect
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication

from skinsource_gui.shell.appearance import place_in_sight
from skinsource_gui.shell.presenting import NotesWindow

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
    (notes,) = [
        widget for widget in QApplication.topLevelWidgets() if isinstance(widget, NotesWindow)
    ]
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
