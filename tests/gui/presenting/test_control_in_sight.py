"""What a scene is about can be turned and read in front of people, in letters of any size."""

import pytest
from PySide6.QtCore import QRect
from PySide6.QtGui import QRegion
from PySide6.QtWidgets import QAbstractButton, QApplication

from skinsource.studies.scenes.catalog import all_scenes
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.panels.compare.view import MapsView
from skinsource_gui.plots.axis import PlotViewBox
from skinsource_gui.plots.figure import Figure
from skinsource_gui.plots.plot import Plot


@pytest.fixture
def presented(open_window, qtbot, design):
    """A studio that presents on a screen of some size, in letters of some size."""
    windows = []

    def make(screen, scale):
        window = open_window(design)
        windows.append(window)
        window.appearance._scale_text(scale)
        window.do("present")
        window.showNormal()
        window.resize(*screen)
        return window

    yield make
    for window in windows:
        window.appearance.reset_text()
        window.appearance.fit_room(1.0)


def settle(window, qtbot):
    for _ in range(4):
        QApplication.processEvents()
        qtbot.waitUntil(lambda: window.workspaces.settled)


def turned(window):
    """The controls of the panel that can be seen."""
    cells = window.panel("frequency_and_amplitude").findChildren(FieldCell)
    return [cell for cell in cells if cell.isVisible()]


def is_whole(window, widget):
    """Whether all of a widget is within the window, and within what its dock does not scroll."""
    view = window.docks["frequency_and_amplitude"].widget().viewport()
    place = QRect(widget.mapTo(window, widget.rect().topLeft()), widget.size())
    shown = QRect(view.mapTo(window, view.rect().topLeft()), view.size())
    return window.rect().contains(place) and shown.contains(place)


def assert_control_is_whole(window, scene):
    assert scene.name in window.document.design.title
    (cell,) = turned(window)
    for part in (cell.label, cell.field):
        assert is_whole(window, part), (scene.name, part.objectName())
    area = window.docks["frequency_and_amplitude"].widget()
    assert area.verticalScrollBar().maximum() == 0, scene.name


def pictures(panel):
    """What is drawn in a panel, without numbers and titles of axes: widgets, and where in them."""
    for plot in panel.findChildren(Plot):
        boxes = [item for item in plot.scene().items() if isinstance(item, PlotViewBox)]
        areas = [plot.mapFromScene(box.sceneBoundingRect()).boundingRect() for box in boxes]
        yield plot, QRegion.boundingRect(sum((QRegion(area) for area in areas), QRegion()))
    for figure in panel.findChildren(Figure):
        yield figure, figure.rect()
    for maps in panel.findChildren(MapsView):
        for place in maps.places.cells:
            yield maps, place.map.toRect()


def in_sight(dock, widget, area):
    """What of a part of a widget its dock shows."""
    view = dock.widget().viewport()
    return QRect(widget.mapTo(view, area.topLeft()), area.size()) & view.rect()


def test_pictures_and_switches_of_each_scene_are_seen_in_the_largest_letters(presented, qtbot):
    window = presented((1366, 768), 3.0)
    for scene in all_scenes():
        window.do("next_scene")
        settle(window, qtbot)
        qtbot.waitUntil(lambda: not window.engine.busy, timeout=60_000)
        settle(window, qtbot)
        assert_control_is_whole(window, scene)
        docks = [dock for dock in window.docks.values() if dock.isVisible() and dock.in_sight]
        assert {"skin", "frequency_and_amplitude"} < {dock.objectName() for dock in docks}
        for dock in docks:
            at, tops = (scene.name, dock.objectName()), [dock.panel.height()]
            for widget, area in pictures(dock.panel):
                if widget.isVisible():
                    assert in_sight(dock, widget, area).height() >= 80, at
                    tops.append(widget.mapTo(dock.panel, area.topLeft()).y())
            for button in dock.panel.findChildren(QAbstractButton):
                above = button.mapTo(dock.panel, button.rect().topLeft()).y() < min(tops)
                if button.isVisible() and button.text() and above:
                    shown = in_sight(dock, button, button.rect())
                    assert shown.width() == button.width(), (*at, button.text())
                    assert button.fontMetrics().horizontalAdvance(button.text()) < button.width(), (
                        at
                    )
                    # Cards of snapshots go on below.
                    assert shown.height() == button.height() or len(tops) == 1, (*at, button.text())
