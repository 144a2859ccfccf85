"""Hand and map mirror each other: inputs are marked on both and pointed at in both."""

from PySide6.QtCore import QPointF
from PySide6.QtTest import QTest

from skinsource_gui.panels.skin.painting import marks_at


def test_inputs_are_marked_on_the_map_where_they_are_behind(make_window, design):
    window = make_window(design)
    skin = window.panel("skin")
    content, layout = skin.map.content, skin.map.stage.layout
    assert [mark.location for mark in content.inputs] == [7, 13]
    place = layout.frame.to_screen(content.limb_map.input_positions[[12]])[0]
    [mark_at_place] = marks_at(content.inputs, content.limb_map, layout, QPointF(*place))
    assert mark_at_place.location == 13
    assert marks_at(content.inputs, content.limb_map, layout, QPointF(1.0, 1.0)) == ()


def test_hand_and_map_point_at_the_same_input(make_window, design):
    window = make_window(design)
    hand, skin = window.panel("hand"), window.panel("skin")
    first, second = window.document.design.ids
    hand.diagram.stage.change(hovered=13)
    assert skin.map.content.pointed_at == second
    hand.diagram.stage.change(hovered=20)
    assert skin.map.content.pointed_at is None
    content, layout = skin.map.content, skin.map.stage.layout
    [x, y] = layout.frame.to_screen(content.limb_map.input_positions[[6]])[0]
    QTest.mouseMove(skin.map, QPointF(float(x), float(y)).toPoint())
    assert hand.diagram.state.target == 7
    skin.map.inputs_chosen.emit((second,))
    assert window.document.view.selected_inputs == (second,)
    assert first in window.document.design.ids
