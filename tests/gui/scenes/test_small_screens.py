"""The gallery is opened and left with its buttons on any screen, in letters of any size."""

import pytest
from PySide6.QtCore import QRect, QSize
from PySide6.QtWidgets import QDialogButtonBox, QScrollArea

from skinsource_gui.shell.appearance import LARGEST_TEXT

#: 800x600, and what is as high as 1920x1080 at scale 2, less the frame of a window.
SCREENS = (QSize(780, 560), QSize(780, 490))


@pytest.fixture
def page(window):
    page = window.scenes.show()
    yield page
    page.reject()


def assert_whole(page):
    inside = page.rect()
    for kind in (QDialogButtonBox.StandardButton.Open, QDialogButtonBox.StandardButton.Cancel):
        button = page.buttons.button(kind)
        assert inside.contains(QRect(button.mapTo(page, button.rect().topLeft()), button.size()))


def test_it_is_no_larger_than_the_screen(page):
    room = page.screen().availableGeometry()
    assert page.width() <= room.width() < 1120
    assert page.height() < room.height()


@pytest.mark.parametrize("screen", SCREENS)
@pytest.mark.parametrize("scale", [1.0, 1.6, LARGEST_TEXT])
def test_it_scrolls_inside_where_the_screen_is_small(window, settle, screen, scale):
    try:
        window.appearance._scale_text(scale)
        settle()
        page = window.scenes.show()
        page.resize(screen)
        settle()
        assert page.size() == screen
        assert_whole(page)
        # What is said of a scene is all there, in sight or scrolled to.
        area = page.findChild(QScrollArea, "scene_area")
        assert page.text.height() >= page.text.heightForWidth(page.text.width())
        hidden = area.widget().height() - area.viewport().height()
        assert area.verticalScrollBar().maximum() == max(hidden, 0)
        page.reject()
    finally:
        window.appearance.reset_text()


def test_with_enough_room_nothing_is_scrolled(page, settle):
    page.resize(780, 650)
    settle()
    area = page.findChild(QScrollArea, "scene_area")
    assert area.verticalScrollBar().maximum() == 0
    assert page.picture.height() > 300
