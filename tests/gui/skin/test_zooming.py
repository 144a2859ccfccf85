from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from skinsource_gui.panels.skin import layout
from skinsource_gui.panels.skin import picture as map_picture
from skinsource_gui.panels.skin.layout import HAND
from skinsource_gui.panels.skin.panel import SkinPanel
from skinsource_gui.plots.outputs import output_at
from skinsource_gui.qt.theme import LIGHT
from skinsource_gui.qt.wheel import FREE, PAUSE_S, WHOLE, ScrollGesture
from tests.gui.menus import close_menus, lines_at
from tests.gui.skin.bench import CONTROL, LEFT, MIDDLE, PLAIN, Window, drag, pixel, place, wheel

# Zooming


@pytest.mark.parametrize("modifiers", [PLAIN, CONTROL])
def test_the_wheel_zooms_around_the_pointer_with_control_or_without(window, modifiers):
    view, at = window.panel.map, QPoint(150, 100)
    before = view.stage.layout.frame
    wheel(view, at, 3, modifiers)
    after = view.stage.layout.frame
    assert after.scale > 1.5 * before.scale
    assert after.to_drawing(QPointF(at)) == pytest.approx(before.to_drawing(QPointF(at)))


def test_the_wheel_scrolls_the_dock_where_nothing_is_left_to_zoom_out(window):
    view, at = window.panel.map, QPoint(150, 100)
    now_s = [100.0]
    view.stage.pan_zoom.scrolling_on = ScrollGesture(view, lambda: now_s[0])
    assert wheel(view, at, 2, PLAIN)
    assert wheel(view, at, -9, PLAIN)
    assert view.stage.pan_zoom.fit == WHOLE
    assert wheel(view, at, -1, PLAIN)  # the same turn of the wheel
    now_s[0] += PAUSE_S
    assert not wheel(view, at, -1, PLAIN)
    assert wheel(view, at, 1, PLAIN)


def test_a_drag_with_the_middle_button_pans(window):
    view = window.panel.map
    view.stage.pan_zoom.zoom(4.0, QPointF(150, 200))
    before = place(window, 25)
    drag(view, QPoint(100, 100), QPoint(130, 160), button=MIDDLE)
    assert place(window, 25) - before == QPoint(30, 60)
    assert window.views == []


def test_where_there_is_no_arm_its_button_says_so(window, results):
    arm, whole = window.panel.measure.arm, results["limb_map"]
    window.deliver(limb_map=replace(whole, hand_length_px=2.0 * np.ptp(whole.outline[:, 1])))
    assert (arm.isEnabled(), "no arm" in arm.toolTip()) == (False, True)
    window.deliver()
    assert (arm.isEnabled(), "no arm" in arm.toolTip()) == (True, False)


@pytest.mark.parametrize("way", ["Z", "Z on a word", "button", "double click"])
def test_there_are_ways_between_the_hand_and_the_hand_with_its_arm(window, way):
    view, arm = window.panel.map, window.panel.measure.arm
    room, at = QRectF(view.rect()), place(window, 52)
    QTest.mouseMove(view, at)
    for fit in (HAND, WHOLE, HAND):
        if way == "Z":
            QTest.keyClick(view, Qt.Key.Key_Z)
        elif way == "Z on a word":
            QTest.keyClick(window.panel.measure.quantity, Qt.Key.Key_Z)
        elif way == "button":
            QTest.mouseClick(arm, LEFT)
        else:
            QTest.mouseDClick(view, LEFT, PLAIN, QPoint(3, 3))
        assert view.stage.pan_zoom.fit == fit
        assert arm.isChecked() == (fit == WHOLE)
        seen = [room.contains(view.stage.place_of(number)) for number in range(1, 73)]
        assert all(seen[:42])
        assert all(seen) == (fit == WHOLE)
        below = output_at(view.stage.layout.points, QPointF(at))
        assert way == "double click" or view.picker.hovered == below != 52 * (fit == HAND)
    view.stage.pan_zoom.zoom(2.0, QPointF(0, 0))
    assert view.stage.pan_zoom.fit == FREE
    QTest.keyClick(view, Qt.Key.Key_0)
    assert view.stage.pan_zoom.fit == WHOLE


def test_the_hand_is_seen_first(qtbot, window):
    panel = SkinPanel()
    qtbot.addWidget(panel)
    again = Window(panel, window.results)
    again.show()
    again.deliver()
    assert panel.map.stage.pan_zoom.fit == HAND


def test_nothing_of_the_outline_is_cut_off_or_covered_at_any_size(window):
    outline = window.results["limb_map"].outline
    for size in ((250, 300), (300, 330), (300, 900), (420, 640), (1200, 500)):
        window.panel.resize(*size)
        layout = window.panel.map.stage.layout
        x, y = layout.frame.to_screen(outline).T
        assert layout.room.contains(QRectF(QPointF(x.min(), y.min()), QPointF(x.max(), y.max())))
        card = layout.palmar_card
        inside = (x > card.left()) & (x < card.right()) & (y > card.top()) & (y < card.bottom())
        assert not inside.any(), size


@pytest.mark.parametrize("zoom", [1.5, 25.0])
@pytest.mark.parametrize("way", [(1, 0), (0, -1), (1, 1), (-1, -1)])
def test_the_map_cannot_be_panned_out_of_sight(window, zoom, way):
    view = window.panel.map
    view.stage.pan_zoom.zoom(zoom, QPointF(10, 10))
    for _ in range(200):
        view.stage.pan_zoom.pan(90.0 * way[0], 90.0 * way[1])
    picture = view.grab().toImage()
    ground = QColor(LIGHT.base).getRgb()[:3]
    places = [QPoint(x, y) for x in range(0, view.width(), 8) for y in range(0, view.height(), 8)]
    card = view.stage.layout.palmar_card
    drawn = [at for at in places if not card.contains(at) and pixel(picture, at) != ground]
    assert len(drawn) > 0.03 * len(places)


def test_the_right_button_offers_fits_and_pictures(window):
    view, requested = window.panel.map, []
    window.panel.action_requested.connect(requested.append)
    actions = lines_at(view, "skin_menu", view, QPoint(30, 30))
    assert list(actions) == [
        "Fit hand",
        "Fit hand and arm",
        "Colours",
        "Copy picture",
        "Copy numbers",
        "Save picture as…",
        "Export data…",
    ]
    actions["Fit hand"].trigger()
    assert view.stage.pan_zoom.fit == HAND
    actions["Fit hand and arm"].trigger()
    assert view.stage.pan_zoom.fit == WHOLE
    actions["Save picture as…"].trigger()
    actions["Export data…"].trigger()
    assert requested == ["export_picture", "export_levels"]
    actions["Copy picture"].trigger()
    assert QApplication.clipboard().image() == window.panel.picture(1200, 1800)
    actions["Copy numbers"].trigger()
    rows = QApplication.clipboard().text().splitlines()
    assert float(rows[29].split("\t")[2]) == window.panel.content.values[28]
    close_menus(view, "skin_menu")
    assert not window.panel.map.findChildren(QMenu, "skin_menu")


@pytest.mark.parametrize("size", [(600, 900), (900, 600)])
def test_a_picture_shows_what_is_seen(window, size, monkeypatch):
    view = window.panel.map
    frames = []
    laid_out = layout.map_layout
    monkeypatch.setattr(
        map_picture,
        "map_layout",
        lambda limb_map, frame, room, metrics: (
            frames.append((frame, room)) or laid_out(limb_map, frame, room, metrics)
        ),
    )
    whole = window.panel.picture(*size)
    view.stage.pan_zoom.show(HAND)
    hand = window.panel.picture(*size)
    view.stage.pan_zoom.zoom(4.0, QPointF(150, 150))
    near = window.panel.picture(*size)
    assert whole != hand != near
    scales = [frame.scale for frame, _ in frames]
    assert scales == sorted(scales)
    # The same place in the middle, and all that was seen.
    frame, room = frames[-1]
    visible_area = QRectF(view.rect())
    on_screen = view.stage.layout.frame
    assert frame.to_drawing(room.center()) == pytest.approx(
        on_screen.to_drawing(visible_area.center())
    )
    for corner in (visible_area.topLeft(), visible_area.bottomRight()):
        at = frame.to_screen(np.array([on_screen.to_drawing(corner)]))[0]
        assert room.adjusted(-1, -1, 1, 1).contains(QPointF(*at))
    # Nothing of the magnified map lies on the words above it.
    view.stage.pan_zoom.zoom(6.0, QPointF(150, 150))
    much = window.panel.picture(*size)
    above = round(room.top()) - 2
    head = QRect(0, 0, size[0], above)
    assert much.copy(head) == near.copy(head)
