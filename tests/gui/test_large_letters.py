"""In the largest letters on a small screen map and hand are seen, and numbers are whole."""

from itertools import pairwise

import pytest
from PySide6.QtCore import QRect

from skinsource_gui.shell.appearance import LARGEST_TEXT


@pytest.fixture
def large(window, settle):
    window.appearance._scale_text(LARGEST_TEXT)
    yield window
    window.appearance.reset_text()
    window.appearance.fit_room(1.0)


def of(part, panel):
    return QRect(part.mapTo(panel, part.rect().topLeft()), part.size())


def test_nothing_lies_on_the_map_or_on_the_ends_of_its_range(large, settle):
    window = large
    window.resize(1366, 768)
    settle()
    assert window.appearance.text_scale == LARGEST_TEXT
    panel = window.panel("skin")
    layout, bar = panel.map.stage.layout, panel.colour_bar
    # All of the limb is in sight, beside the cards.
    limb = layout.frame.transform().mapRect(panel.map.content.field.rect)
    for output in range(1, 61):
        point = panel.map.stage.place_of(output)
        assert layout.room.contains(point)
        assert not layout.palmar_card.contains(point)
    assert limb.height() > 0.5 * panel.map.height()
    assert layout.room.contains(layout.palmar_card)
    fields = [bar.high_field, bar.strip, bar.low_field]
    shown = [*fields, *([bar.auto_button] if bar.auto_button.isVisible() else [])]
    places = [of(widget, bar) for widget in shown]
    for above, below in pairwise(places):
        assert above.bottom() < below.top()
    assert places[-1].bottom() <= bar.height()
    for field in (bar.high_field, bar.low_field):
        assert field.height() >= field.fontMetrics().height()
