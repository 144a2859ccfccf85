"""What a drag is given up to."""

from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource_gui.panels.clip_editor.panel import DragStart


def test_the_way_back_leads_to_what_the_first_edit_of_the_drag_was_made_of():
    first, later, view = Design(limb="synthetic-1"), Design(limb="synthetic-2"), View()
    start = DragStart()
    assert start.undo(7) is None
    for design in (first, later):
        start.note(7, design, view)
    start.note(None, later, view)
    back = start.undo(7)
    assert (back.design, back.view, back.label) == (first, view, "")
    assert start.undo(8) is None
    start.note(8, later, view)
    assert start.undo(8).design is later
    assert start.undo(7) is None
