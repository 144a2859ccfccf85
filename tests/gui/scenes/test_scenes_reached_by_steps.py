"""A scene is arranged the same, whichever way it is reached."""

import gc

import pytest
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QApplication

import skinsource as ss
from skinsource.limbs.catalog import available_limbs
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import Preferences, start_design

NAMES = ss.scenes.names()


def in_front(window):
    QApplication.processEvents()
    return {name for name, dock in window.docks.items() if dock.in_sight}


def stepped_through(window, n_back):
    """Panels in front at each scene, which are the same on the way back."""
    panels_in_front = {}
    for name in NAMES:
        window.do("next_scene")
        assert f"Fig. {name}:" in window.document.design.title
        panels_in_front[name] = in_front(window)
    for name in NAMES[-2 : -2 - n_back : -1]:
        window.do("previous_scene")
        assert in_front(window) == panels_in_front[name], name
    return panels_in_front


@pytest.fixture
def opened_alone(qtbot, tmp_path):
    """Panels in front of a scene in a window that showed no other one; then, presented."""
    known = {}

    def alone(name):
        preferences = Preferences(tmp_path / f"{name}.ini")
        limbs = available_limbs()
        window = MainWindow(start_design(limbs[0]), preferences=preferences, available_limbs=limbs)
        window.resize(1366, 728)
        window.show()
        qtbot.waitExposed(window)
        window.scenes.open(name)
        plain = in_front(window)
        window.do("present")
        presented = in_front(window)
        window.close_unasked()
        window.deleteLater()
        return plain, presented

    def opened_once(name):
        scene = ss.scenes.scene(name)
        # What is arranged alike need not be opened twice.
        key = scene.arrangement, scene.panels
        if key not in known:
            known[key] = alone(name)
            # Windows that are only closed add up: letters of another size go through all widgets.
            QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
            gc.collect()
        return known[key]

    return opened_once


def test_each_scene_shows_the_same_panels_stepped_to_and_opened_alone(make_window, opened_alone):
    # First, while there is no other window.
    alone = {name: opened_alone(name) for name in NAMES}
    window = make_window()
    plain = stepped_through(window, len(NAMES) - 1)
    window.do("new_design")
    window.do("present")
    presented = stepped_through(window, 5)
    window.do("present")
    assert alone == {name: (plain[name], presented[name]) for name in NAMES}
