"""What can be done with the mouse on hand, timeline, clip editor and plots."""

from PySide6.QtCore import QPoint, QPointF, Qt

from skinsource_gui.panels.clip_editor.view import EditorView
from tests.gui.monkey.hands import ALT, CONTROL, MIDDLE, NONE, RIGHT, SHIFT

_HELD = (NONE, NONE, NONE, SHIFT, CONTROL, ALT)


def shown_panel(hands, name: str):
    """The panel of that name, brought into sight as its menu entry does."""
    panel = hands.window.panel(name)
    if not panel.isVisible():
        hands.window.docks[name].bring_forward()
    return panel


def on_hand(hands):
    diagram = shown_panel(hands, "hand").diagram
    sites = [diagram.site_centre(place) for place in range(1, 21)]
    occupied = [diagram.site_centre(track.location) for track in hands.document.design.inputs]
    start = hands.one_of(occupied if occupied and hands.chance(0.5) else sites)
    _anything(hands, diagram, start, end=hands.one_of(sites))


def on_lanes(hands):
    lanes = shown_panel(hands, "timeline").lanes
    start = hands.place_in(lanes.viewport())
    where = hands.one_of(("clip", "clip", "clip", "ruler", "ground"))
    if where == "ruler":
        start.setY(int(hands.number(2, 20)))
    elif where == "clip" and lanes.content.boxes:
        # Often near one of its ends or corners.
        rect = hands.one_of(lanes.content.boxes).rect
        across = hands.one_of((0.02, 0.5, 0.98, hands.number(0.0, 1.0)))
        down = hands.one_of((0.1, 0.5, 0.9))
        start = (rect.topLeft() + QPointF(across * rect.width(), down * rect.height())).toPoint()
        if hands.chance(0.2):
            hands.click(lanes, start, hands.one_of(_HELD))
    _anything(hands, lanes, start, (MIDDLE,))


def on_heads(hands):
    heads = shown_panel(hands, "timeline").heads
    if not heads.heads:
        return
    row = int(hands.random.integers(len(heads.heads)))
    heads.scrollTo(heads.model().index(row))
    part = getattr(heads.places(row), hands.one_of(("swatch", "mute", "solo", "fader")))
    _anything(hands, heads, part.center().toPoint())


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


def _anything(hands, surface, start, other_buttons=(), end=None):
    """Do anything that a mouse can do on a surface."""
    end, held = end or hands.place_in(surface), hands.one_of(_HELD)
    way = hands.one_of(("drag", "drag", "drag", "click", "click", "double", "wheel", "menu"))
    if way == "drag":
        buttons = hands.one_of(((), (), (), other_buttons))
        hands.drag(surface, start, end, held, *buttons)
    elif way == "click":
        hands.click(surface, start, held)
    elif way == "double":
        hands.double_click(surface, start)
    elif way == "wheel":
        hands.wheel(surface, start, hands.one_of((-3, 3)), held)
    else:
        hands.menu_of(surface, start)
