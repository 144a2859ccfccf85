"""What tests of maps side by side share."""

from dataclasses import replace

from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication

from skinsource.design.panel_settings import settings_of, with_settings
from skinsource_gui.panels.side_by_side.settings import SideBySideSettings


def choose(window, **changes):
    view = window.document.view
    settings = replace(settings_of(view, "side_by_side", SideBySideSettings), **changes)
    window.document.look(with_settings(view, "side_by_side", settings))


def shown(panel, qtbot, n):
    """The maps, once there are ``n`` of the present design."""

    def complete():
        cells = panel.maps.content.cells
        drawn = [cell for cell in cells if cell.small is not None]
        return len(drawn) == n and not panel.maps.content.stale

    qtbot.waitUntil(complete, timeout=60_000)
    return panel.maps.content.cells


def point_at(maps, index, output):
    at = QPointF(*maps.visible_maps.points_of(index)[output - 1])
    no = Qt.MouseButton.NoButton
    event = QMouseEvent(
        QEvent.Type.MouseMove,
        at,
        QPointF(maps.mapToGlobal(at.toPoint())),
        no,
        no,
        Qt.KeyboardModifier.NoModifier,
    )
    QApplication.sendEvent(maps, event)
    return at.toPoint()
