"""What stands above maps side by side is read whole; their scale says what lies beyond it."""

import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QFontMetricsF, QImage, QPainter

import skinsource as ss
from skinsource.design.comparing import Snapshot
from skinsource.design.design import Design
from skinsource_gui.panels.side_by_side.content import Cell, SideBySideContent, snapshot_names
from skinsource_gui.panels.side_by_side.view import bold, paint_heading, places_for
from skinsource_gui.plots.small_map import tick_text
from skinsource_gui.state.compared import Compared

ROOM = QRectF(0, 0, 320, 400)
LONG = tuple(f"Snapshot {k} on Synthetic {k} minus Edited on Synthetic 4" for k in (1, 2, 3))


def headed(*headings):
    return SideBySideContent(
        cells=tuple(Cell(headings=(heading,), limb="") for heading in headings)
    )


def test_long_headings_of_three_have_the_lines_they_need_and_short_ones_have_one(qapp):
    font = qapp.font()
    metrics = QFontMetricsF(bold(font))
    line = QFontMetricsF(font).height()
    short = places_for(ROOM, headed("Snapshot 1", "Snapshot 2", "Snapshot 3"), font)
    assert {place.heading.height() for place in short.cells} == {line}
    long = places_for(ROOM, headed(*LONG), font)
    for text, place in zip(LONG, long.cells, strict=True):
        needed = metrics.boundingRect(place.heading, 0x1084, text)  # centred, wrapped at words
        assert needed.height() <= place.heading.height() + 1
        assert needed.width() <= place.heading.width()
        assert place.value.top() == place.heading.bottom()
        assert place.map.top() >= place.value.bottom()


@pytest.mark.parametrize("name", ["1F", "1G", "2B", "2E"])
def test_maps_of_a_scene_are_headed_by_what_they_show_in_a_small_window(qapp, name):
    font, line = qapp.font(), QFontMetricsF(qapp.font()).height()
    labels = ss.scenes.scene(name).labels
    content = headed(*(f"{k} · {label}" for k, label in enumerate(labels, start=1)))
    places = places_for(QRectF(0, 0, 323, 300), content, font)
    assert {place.heading.height() for place in places.cells} == {line}


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
    ("value", "reached", "text"),
    [
        (-20.0, (-57.0, 3.0), "≤ −20"),
        (20.0, (-57.0, 3.0), "+20"),
        (20.0, (-1.0, 20.5), "≥ +20"),
        (0.0, (-57.0, 60.0), "0"),
        (-20.0, None, "−20"),
    ],
)
def test_the_ends_of_a_scale_say_what_else_has_their_colour(value, reached, text):
    assert tick_text(value, (-20.0, 20.0), reached, signed=True) == text


def test_snapshots_of_a_scene_are_told_by_what_their_titles_do_not_share():
    def stored(number, title):
        design = Design(limb="synthetic-1", title=title)
        return Compared(snapshot=Snapshot(number=number, design=design))

    tones = [stored(1, "Fig. 2B: Far · 50 Hz"), stored(2, "Fig. 2B: Far · 100 Hz")]
    first, second = snapshot_names(tones, "xyz")
    assert first == (
        "Snapshot 1 · Fig. 2B: Far · 50 Hz",
        "Snapshot 1 · 50 Hz",
        "1 · 50 Hz",
        "Snapshot 1",
        "1",
    )
    assert second[1] == "Snapshot 2 · 100 Hz"
    # What is the same throughout is said; nothing is taken from titles that share nothing.
    assert snapshot_names([tones[0], tones[0]], "xyz")[0][1] == "Snapshot 1 · 50 Hz"
    assert snapshot_names([tones[0], stored(2, "Other")], "xyz")[1] == (
        "Snapshot 2 · Other",
        "Snapshot 2",
        "2",
    )
    assert snapshot_names([stored(1, "")], "xyz") == [("Snapshot 1", "1")]
