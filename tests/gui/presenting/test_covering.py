"""What is guessed is covered wherever it is drawn, and revealed by the same key."""

import pytest
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QColor, QHelpEvent
from PySide6.QtWidgets import QApplication, QWidget

from skinsource_gui.qt.overlays import COVERED, Cover

MAPS = {
    "windowed": ("window_strip",),
    "side_by_side": ("maps_side_by_side", "side_by_side_words"),
    "compare": ("difference_map", "matching_words"),
}


@pytest.fixture
def studio(make_window, design):
    return make_window(design)


def parts(panel):
    return {part.objectName(): part for part in panel.guessed}


def colours(part):
    image = part.grab().toImage()
    steps = range(0, image.height(), 3), range(0, image.width(), 3)
    return {image.pixelColor(x, y).name() for y in steps[0] for x in steps[1]}


def wait(studio, qtbot):
    qtbot.waitUntil(lambda: not studio.engine.busy, timeout=30_000)


@pytest.mark.parametrize("name", MAPS)
def test_all_that_draws_maps_is_covered_together_and_revealed(studio, qtbot, name):
    studio.docks[name].bring_forward()
    panel = studio.panel(name)
    wait(studio, qtbot)
    assert set(MAPS[name]) <= parts(panel).keys()
    assert not panel.findChildren(Cover)
    studio.do("cover_map")
    assert studio.panel("skin").map.content.message == COVERED
    for part in panel.guessed:
        (cover,) = part.findChildren(Cover)
        assert cover.geometry() == part.rect()
    studio.do("cover_map")
    assert studio.panel("skin").map.content.message != COVERED
    assert not any(cover.isVisible() for cover in panel.findChildren(Cover))


def test_nothing_is_seen_through_a_cover_however_large_it_gets(studio, qtbot):
    studio.docks["windowed"].bring_forward()
    wait(studio, qtbot)
    strip = studio.panel("windowed").strip
    qtbot.waitUntil(lambda: strip.content is not None, timeout=30_000)
    assert len(colours(strip)) > 50
    studio.do("cover_map")
    strip.resize(strip.width() + 60, strip.height() + 40)
    # Words alone, in greys between two colours.
    ground = strip.palette().window().color()
    assert all(QColor(colour).hsvSaturation() < 80 for colour in colours(strip))
    assert ground.name() in colours(strip)


def test_a_panel_that_is_first_seen_while_maps_are_covered_is_covered(studio, qtbot):
    assert "windowed" not in studio.panels
    studio.do("cover_map")
    studio.docks["windowed"].bring_forward()
    panel = studio.panel("windowed")
    wait(studio, qtbot)
    assert panel.strip.findChildren(Cover)
    studio.do("cover_map")
    assert not any(cover.isVisible() for cover in panel.findChildren(Cover))


def test_a_click_on_a_cover_reaches_nothing(studio, qtbot):
    studio.docks["windowed"].bring_forward()
    strip = studio.panel("windowed").strip
    qtbot.waitUntil(lambda: strip.content is not None, timeout=30_000)
    studio.do("cover_map")
    (cover,) = strip.findChildren(Cover)
    at_s = studio.document.view.playhead_s
    at: QPoint = strip.places.cells[2].center().toPoint()
    qtbot.mouseClick(cover, Qt.MouseButton.LeftButton, pos=at)
    assert studio.document.view.playhead_s == at_s


def test_traces_stay_in_sight_while_maps_are_covered(studio):
    studio.docks["traces"].bring_forward()
    studio.do("cover_map")
    assert not studio.panel("traces").findChildren(Cover)


def test_nothing_stays_covered_once_presenting_ends(studio, qtbot):
    studio.docks["windowed"].bring_forward()
    wait(studio, qtbot)
    studio.do("present")
    studio.do("cover_map")
    studio.do("present")
    assert not any(cover.isVisible() for cover in studio.panel("windowed").findChildren(Cover))


def test_no_tooltip_of_what_is_below_tells_it(qtbot):
    events = []

    class Telling(QWidget):
        def event(self, event):
            if event.type() == QEvent.Type.ToolTip:
                events.append(event)
            return super().event(event)

    part = Telling()
    qtbot.addWidget(part)
    part.show()
    cover = Cover(part)
    at = QPoint(5, 5)
    for over, n_events in ((cover, 0), (part, 1)):
        QApplication.sendEvent(over, QHelpEvent(QEvent.Type.ToolTip, at, over.mapToGlobal(at)))
        assert len(events) == n_events
