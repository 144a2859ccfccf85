"""What part of the map is seen, and where everything lies."""

from dataclasses import replace

from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QPainterPath
from PySide6.QtWidgets import QApplication

from skinsource_gui.panels.skin.painting import bar_card
from skinsource_gui.qt.wheel import FREE, WHOLE


class Paints(QObject):
    """Counts how often a widget is painted."""

    def __init__(self, watched):
        super().__init__(watched)
        self.n = 0
        watched.installEventFilter(self)

    def eventFilter(self, watched, event):
        self.n += event.type() == QEvent.Type.Paint
        return False


def test_another_limb_is_seen_as_a_whole(window):
    view = window.panel.map
    view.stage.pan_zoom.zoom(4.0, QPointF(150, 200))
    assert view.stage.pan_zoom.fit == FREE
    before = view.stage.layout
    limb_map = view.content.limb_map
    view.show_content(replace(view.content, limb_map=replace(limb_map)))
    assert view.stage.pan_zoom.fit == WHOLE
    assert view.stage.layout.frame.scale < before.frame.scale


def test_where_there_is_no_limb_nothing_has_a_place(window):
    view = window.panel.map
    view.show_content(replace(view.content, limb_map=None))
    assert view.stage.layout is None
    assert view.stage.place_of(7) == QPointF()


def test_the_map_is_painted_anew_wherever_it_is_zoomed_to(window, qtbot):
    view = window.panel.map
    QApplication.processEvents()
    paints = Paints(view)
    view.stage.pan_zoom.zoom(2.0, QPointF(150, 200))
    qtbot.waitUntil(lambda: paints.n > 0, timeout=2000)


def test_the_bar_of_millimetres_stands_where_it_hides_no_skin(window):
    layout, size, line = window.panel.map.stage.layout, QSizeF(60.0, 20.0), 14.0
    room, skin = layout.room, QPainterPath()
    skin.setFillRule(Qt.FillRule.WindingFill)
    usual = bar_card(layout, size, line, skin)
    assert usual.right() < room.center().x() < room.right()
    assert usual.top() > room.center().y()
    # As of an arm that goes down to the left, then of one that fills all that is below.
    for hidden in (usual, QRectF(room.left(), room.center().y(), room.width(), room.height())):
        skin.addRect(hidden)
        place = bar_card(layout, size, line, skin)
        assert room.contains(place)
        assert not skin.intersects(place)
        assert not layout.palmar_card.intersects(place)
        assert not layout.triad_card.intersects(place)
    skin.addRect(room)
    assert bar_card(layout, size, line, skin) == usual
