"""What can be done with the mouse on hand, timeline, clip editor and plots."""

from PySide6.QtCore import QPoint, Qt

from skinsource_gui.panels.clip_editor.view import EditorView
from tests.gui.monkey.hands import ALT, CONTROL, MIDDLE, NONE, RIGHT, SHIFT

_HELD = (NONE, NONE, NONE, SHIFT, CONTROL, ALT)
_PLACES = range(1, 21)


def shown_panel(hands, name: str):
    """The panel of that name, brought into sight as its menu entry does."""
    panel = hands.window.panel(name)
    if not panel.isVisible():
        hands.window.docks[name].bring_forward()
    return panel


def on_hand(hands):
    diagram = shown_panel(hands, "hand").diagram
    here, there = (diagram.site_centre(int(hands.one_of(_PLACES))) for _ in range(2))
    held, way = hands.one_of(_HELD), hands.one_of(("click", "click", "drag", "menu"))
    if way == "click":
        hands.click(diagram, here, held)
    elif way == "drag":
        occupied = [diagram.site_centre(track.location) for track in hands.document.design.inputs]
        hands.drag(diagram, hands.one_of(occupied or [here]), there, held)
    else:
        hands.menu_of(diagram, here)


def on_lanes(hands):
    lanes = shown_panel(hands, "timeline").lanes
    ways = (*(_drag_clip, _drag_clip, _drag_clip), _on_ground, _on_ruler, _turn, _menu, _open)
    hands.one_of(ways)(hands, lanes)


def _on_clip(hands, lanes) -> QPoint:
    """A place on a clip, often near one of its ends or corners; anywhere if there is none."""
    boxes = lanes.content.boxes
    if not boxes:
        return hands.place_in(lanes.viewport())
    rect = hands.one_of(boxes).rect
    across = hands.one_of((0.02, 0.5, 0.98, hands.number(0.0, 1.0)))
    return QPoint(
        round(rect.left() + across * rect.width()),
        round(rect.top() + hands.one_of((0.1, 0.5, 0.9)) * rect.height()),
    )


def _drag_clip(hands, lanes):
    start, held = _on_clip(hands, lanes), hands.one_of(_HELD)
    way = QPoint(int(hands.number(-250, 250)), int(hands.one_of((0, 0, hands.number(-90, 90)))))
    if hands.chance(0.2):
        hands.click(lanes, start, held)
    hands.drag(lanes, start, start + way, held)


def _on_ground(hands, lanes):
    start, end = hands.place_in(lanes.viewport()), hands.place_in(lanes.viewport())
    if hands.chance(0.5):
        hands.drag(lanes, start, end, hands.one_of(_HELD))
    else:
        hands.double_click(lanes, start)


def _on_ruler(hands, lanes):
    start, end = (QPoint(hands.place_in(lanes).x(), int(hands.number(2, 20))) for _ in range(2))
    if hands.chance(0.2):
        hands.double_click(lanes, start)
    else:
        hands.drag(lanes, start, end, hands.one_of((NONE, SHIFT)))


def _turn(hands, lanes):
    at = hands.place_in(lanes.viewport())
    if hands.chance(0.2):
        hands.drag(lanes, at, hands.place_in(lanes.viewport()), button=MIDDLE)
    else:
        hands.wheel(lanes, at, hands.one_of((-3, -1, 1, 3)), hands.one_of((NONE, SHIFT, CONTROL)))


def _menu(hands, lanes):
    hands.menu_of(lanes, hands.one_of((_on_clip(hands, lanes), hands.place_in(lanes.viewport()))))


def _open(hands, lanes):
    hands.double_click(lanes, _on_clip(hands, lanes))


def on_heads(hands):
    heads = shown_panel(hands, "timeline").heads
    if not heads.heads:
        return
    row = int(hands.random.integers(len(heads.heads)))
    heads.scrollTo(heads.model().index(row))
    parts = heads.places(row)
    at = getattr(parts, hands.one_of(("swatch", "mute", "solo", "fader"))).center().toPoint()
    way = hands.one_of(("drag", "click", "wheel", "double", "menu"))
    if way == "drag":
        by = QPoint(int(hands.number(-60, 60)), int(hands.one_of((0, hands.number(-50, 50)))))
        hands.drag(heads, at, at + by, hands.one_of((NONE, CONTROL)))
    elif way == "wheel":
        hands.wheel(heads, at, hands.one_of((-2, 1)))
    elif way == "menu":
        hands.menu_of(heads, at)
    else:
        (hands.click if way == "click" else hands.double_click)(heads, at)


def in_editor(hands):
    view = shown_panel(hands, "clip_editor").findChild(EditorView)
    tools = (Qt.Key.Key_P, Qt.Key.Key_E, Qt.Key.Key_E, Qt.Key.Key_V)
    view.setFocus(Qt.FocusReason.MouseFocusReason)
    if hands.chance(0.4):
        hands.key(hands.one_of(tools))
    start = hands.place_in(view.viewport())
    if view.content is not None and hands.chance(0.5):
        # Where the level envelope lies.
        start = QPoint(start.x(), round(view.content.y(1.0)))
    if hands.chance(0.05):
        hands.window.do("limit_to_band")
    else:
        _anything(hands, view, start, (RIGHT,))


def on_plots(hands):
    name = hands.one_of(("traces", "spectra", "skin"))
    panel = shown_panel(hands, name)
    surface = panel.map if name == "skin" else panel.findChild(object, f"{name}-plot")
    _anything(hands, surface, hands.place_in(surface))


def _anything(hands, surface, start, other_buttons=()):
    """Do anything that a mouse can do on a surface."""
    end, held = hands.place_in(surface), hands.one_of(_HELD)
    way = hands.one_of(("drag", "drag", "click", "double", "wheel", "menu"))
    if way == "drag":
        buttons = hands.one_of(((), (), other_buttons))
        hands.drag(surface, start, end, held, *buttons)
    elif way == "click":
        hands.click(surface, start, held)
    elif way == "double":
        hands.double_click(surface, start)
    elif way == "wheel":
        hands.wheel(surface, start, hands.one_of((-3, 3)), held)
    else:
        hands.menu_of(surface, start)
