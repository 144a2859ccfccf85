"""What stands above maps side by side is read whole; their scale says what lies beyond it."""

import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QFontMetricsF, QImage, QPainter

from skinsource_gui.panels.side_by_side.content import Cell, Content
from skinsource_gui.panels.side_by_side.headings import bold, paint_heading, places_for
from skinsource_gui.widgets.map.scale_ticks import tick_text

ROOM = QRectF(0, 0, 320, 400)
LONG = tuple(f"Snapshot {k} on Synthetic {k} minus Edited on Synthetic 4" for k in (1, 2, 3))


def headed(*headings):
    return Content(cells=tuple(Cell(headings=(one,), limb="") for one in headings))


def test_long_headings_of_three_have_the_lines_they_need_and_short_ones_have_one(qapp):
    font = qapp.font()
    metrics = QFontMetricsF(bold(font))
    line = QFontMetricsF(font).height()
    short = places_for(ROOM, headed("Snapshot 1", "Snapshot 2", "Snapshot 3"), font)
    assert {place.heading.height() for place in short.cells} == {line}
    long = places_for(ROOM, headed(*LONG), font)
    for words, place in zip(LONG, long.cells, strict=True):
        taken = metrics.boundingRect(place.heading, 0x1084, words)  # centred, wrapped at words
        assert taken.height() <= place.heading.height() + 1
        assert taken.width() <= place.heading.width()
        assert place.value.top() == place.heading.bottom()
        assert place.map.top() >= place.value.bottom()


def test_what_has_no_room_at_all_ends_with_dots_within_its_room(qapp):
    image = QImage(60, 80, QImage.Format.Format_RGB32)
    image.fill(0xFFFFFFFF)
    painter = QPainter(image)
    paint_heading(painter, ("W" * 90,), QRectF(0, 0, 60, 2 * painter.fontMetrics().height()))
    height = 2 * painter.fontMetrics().height()
    painter.end()
    inked = [y for y in range(80) if any(image.pixel(x, y) & 0xFF < 128 for x in range(60))]
    assert inked
    assert max(inked) <= height + 1


@pytest.mark.parametrize(
    ("value", "reached", "words"),
    [
        (-20.0, (-57.0, 3.0), "≤ −20"),
        (20.0, (-57.0, 3.0), "+20"),
        (20.0, (-1.0, 20.5), "≥ +20"),
        (0.0, (-57.0, 60.0), "0"),
        (-20.0, None, "−20"),
    ],
)
def test_the_ends_of_a_scale_say_what_else_has_their_colour(value, reached, words):
    assert tick_text(value, (-20.0, 20.0), reached, signed=True) == words
