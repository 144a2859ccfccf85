"""The part of a recording that is taken, on a strip of 800 px for 8 s."""

import pytest

from skinsource_gui.pages.importing.form import DraggedPart


@pytest.fixture
def part():
    """From 2 to 4 s."""
    made = DraggedPart(5.0, lambda: 800)
    made.show(8.0, 2.0, 2.0)
    return made


def dragged(part, *places_px):
    """Where it goes, s."""
    part.hold(places_px[0])
    for x_px in places_px[1:]:
        part.drag(x_px)
    part.release()
    return part.start_s, part.end_s


def test_a_press_beside_it_brings_its_middle_there(part):
    assert part.hold(600.0)
    assert (part.start_s, part.end_s) == (5.0, 7.0)


def test_it_keeps_its_length_and_stays_in_the_recording(part):
    assert dragged(part, 300.0, 350.0) == (2.5, 4.5)
    assert dragged(part, 350.0, 900.0) == (6.0, 8.0)
    assert dragged(part, 700.0, -50.0) == (0.0, 2.0)


def test_an_end_stays_on_its_side_and_no_part_is_longer_than_the_longest(part):
    assert dragged(part, 402.0, 350.0) == (2.0, 3.5)
    assert dragged(part, 350.0, 100.0) == (2.0, 2.01)
    assert dragged(part, 201.0, 800.0) == (2.0, 7.0)
    assert dragged(part, 201.0, 0.0) == (2.0, 7.0)


def test_where_all_is_taken_a_drag_chooses_a_part_and_a_press_alone_does_not(part):
    part.show(4.0, 0.0, 4.0)
    assert not part.hold(400.0)
    assert not part.drag(401.0)
    assert dragged(part, 400.0, 300.0) == (1.5, 2.0)


def test_all_is_as_much_as_may_be_taken(part):
    part.take_all()
    assert (part.start_s, part.end_s) == (0.0, 5.0)
    part.show(3.0, 1.0, 1.0)
    part.take_all()
    assert (part.start_s, part.end_s) == (0.0, 3.0)
