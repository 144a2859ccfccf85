"""Panels that show a scene stay in front of those that an arrangement has by itself."""

from PySide6.QtWidgets import QApplication

from skinsource.studies.scenes.catalog import all_scenes
from tests.gui.presenting.test_presented_scenes import in_front


def test_after_a_show_the_panels_of_the_scene_that_is_open_are_in_front(make_window, qtbot, design):
    window = make_window(design)
    # So low that other panels stand behind each other than on the whole screen.
    window.resize(1366, 600)
    names = [scene.name for scene in all_scenes()]
    window.scenes.open("1G")
    assert "side_by_side" in in_front(window)
    window.do("present")
    for _ in range(names.index("2H") - names.index("1G")):
        window.do("next_scene")
    window.do("present")
    qtbot.waitUntil(lambda: "windowed" in in_front(window))
    qtbot.waitUntil(lambda: window.height() == 600)
    settle()
    assert "windowed" in in_front(window)
    assert "timeline" in in_front(window)


def test_words_of_another_size_leave_the_panels_of_a_scene_in_front(make_window, design):
    window = make_window(design)
    window.resize(1366, 768)
    window.scenes.open("1G")
    folds = []
    window.arrangements.chosen.connect(folds.append)
    for _ in range(6):
        window.do("enlarge_text")
        settle()
        assert "side_by_side" in in_front(window)
    # Panels that have no room beside each other any more were put behind each other.
    assert folds


def settle():
    """Docks have their room."""
    for _ in range(20):
        QApplication.processEvents()
