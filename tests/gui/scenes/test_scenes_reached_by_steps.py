"""A scene is arranged the same, whichever way it is reached."""

import pytest
from PySide6.QtWidgets import QApplication

import skinsource as ss

NAMES = ss.scenes.names()


def in_front(window):
    QApplication.processEvents()
    return {name for name, dock in window.docks.items() if dock.in_sight}


def stepped_through(window):
    """Panels in front at each scene, which are the same on the way back."""
    found = {}
    for name in NAMES:
        window.do("next_scene")
        assert f"Fig. {name}:" in window.document.design.title
        found[name] = in_front(window)
    for name in reversed(NAMES[:-1]):
        window.do("previous_scene")
        assert in_front(window) == found[name], name
    return found


@pytest.fixture
def opened_alone(make_window):
    """Panels in front of a scene in a window that showed no other one; then, presented."""
    known = {}

    def found(name):
        scene = ss.scenes.scene(name)
        # What is arranged alike need not be opened twice: windows add up.
        key = scene.arrangement, scene.panels
        if key not in known:
            window = make_window()
            window.scenes.open(name)
            plain = in_front(window)
            window.do("present")
            known[key] = plain, in_front(window)
            window.close()
        return known[key]

    return found


def test_each_scene_shows_the_same_panels_stepped_to_and_opened_alone(make_window, opened_alone):
    window = make_window()
    plain = stepped_through(window)
    window.do("new_design")
    window.do("present")
    presented = stepped_through(window)
    window.do("present")
    assert {name: opened_alone(name) for name in NAMES} == {
        name: (plain[name], presented[name]) for name in NAMES
    }


def test_what_was_in_sight_before_scenes_were_stepped_through_comes_back(make_window):
    window = make_window()
    window.docks["history"].bring_forward()
    own = in_front(window)
    for _ in range(3):
        window.do("next_scene")
    assert in_front(window) != own
    window.do("new_design")
    assert in_front(window) == own
