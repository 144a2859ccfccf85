"""The hand panel, driven by real mouse and key events."""

from PySide6.QtCore import QPoint

from skinsource.design.design import track
from tests.gui.hand.bench import KEY, short

# Dragging


def test_a_drag_moves_the_input_live_in_one_gesture(studio):
    studio.show(track(location=7), track(location=18), selected=0)
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(16))
    assert studio.sites == [7, 16]
    assert studio.diagram.state.moving == 1
    studio.drag_to(studio.diagram.site_centre(13))
    assert studio.sites == [7, 13]
    studio.release(studio.diagram.site_centre(13))
    assert studio.diagram.state.moving is None
    assert studio.view.selected_input == 2
    assert [label for label, _, _ in studio.edits] == [
        f"Move input to 16 ({short(16)})",
        f"Move input to 13 ({short(13)})",
    ]
    gestures = {gesture for _, _, gesture in studio.edits}
    assert len(gestures) == 1
    assert None not in gestures


def test_two_drags_are_two_gestures(studio):
    studio.show(track(location=18), selected=0)
    for start, end in ((18, 13), (13, 8)):
        studio.press(start)
        studio.drag_to(studio.diagram.site_centre(end))
        studio.release(studio.diagram.site_centre(end))
    assert studio.sites == [8]
    assert studio.edits[0][2] != studio.edits[-1][2]


def test_escape_during_a_drag_restores_the_design(studio):
    studio.show(track(location=18), selected=0)
    before = studio.design
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(13))
    studio.keys(KEY.Key_Escape)
    assert studio.design == before
    studio.drag_to(studio.diagram.site_centre(8))
    studio.release(studio.diagram.site_centre(8))
    assert studio.design == before
    assert len({gesture for _, _, gesture in studio.edits}) == 1


def test_dropping_away_from_every_site_restores_the_design(studio):
    studio.show(track(location=18), selected=0)
    before = studio.design
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(13))
    assert studio.design != before
    studio.drag_to(QPoint(4, 300))
    studio.release(QPoint(4, 300))
    assert studio.design == before
    assert studio.diagram.state.ghost is None


def test_hiding_the_panel_during_a_drag_restores_the_design(studio):
    studio.show(track(location=18), selected=0)
    before = studio.design
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(13))
    studio.panel.hide()
    assert studio.design == before


def test_a_drag_ends_when_its_input_is_taken_away(studio):
    studio.show(track(location=18), selected=0)
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(13))
    studio.show()
    edits = len(studio.edits)
    studio.drag_to(studio.diagram.site_centre(8))
    studio.release(studio.diagram.site_centre(8))
    assert len(studio.edits) == edits
    assert studio.diagram.state.moving is None


def test_a_drag_whose_release_never_came_is_over_at_the_next_press(studio):
    studio.show(track(location=7), track(location=18), selected=1)
    studio.press(18)
    studio.drag_to(studio.diagram.site_centre(16))
    studio.click(3)
    assert studio.diagram.state.moving is None
    studio.show(track(location=7), selected=0)
    assert not studio.diagram.grab().isNull()


def test_a_shaky_click_is_no_drag(studio):
    studio.show(track(location=18), selected=0)
    point = studio.diagram.site_centre(18)
    studio.press(18)
    studio.drag_to(point + QPoint(2, 2))
    studio.release(point + QPoint(2, 2))
    assert studio.edits == []
