"""In the largest letters on a small screen map and hand are seen, and numbers are whole."""

import re
from itertools import pairwise

import pytest
from PySide6.QtCore import QRect

from skinsource_gui.panels.skin.map import ReadoutLines
from skinsource_gui.plots.pictures import save_drawing
from skinsource_gui.shell.appearance import LARGEST_TEXT


@pytest.fixture
def large(window, settle):
    window.appearance._scale_text(LARGEST_TEXT)
    yield window
    window.appearance.reset_text()
    window.appearance.fit_room(1.0)


def of(part, panel):
    return QRect(part.mapTo(panel, part.rect().topLeft()), part.size())


@pytest.mark.parametrize("arrangement", ["arrange_design", "arrange_presentation"])
def test_nothing_lies_on_the_map_or_on_the_ends_of_its_range(large, settle, arrangement):
    window = large
    window.do(arrangement)
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


def test_letters_of_the_usual_size_stay_as_they_are(window, settle):
    window.resize(1366, 768)
    settle()
    panel = window.panel("skin")
    assert panel.map.stage.letters == panel.map.font()
    assert panel.colour_bar.auto_button.isVisible()
    assert len(panel.readout.shown) == 2


def test_in_one_line_a_value_comes_first_and_a_hint_is_left_out(qtbot):
    lines = ReadoutLines()
    qtbot.addWidget(lines)
    lines.show_text("Output 23, III knuckle\n−12.3 dB re 1 m/s²")
    two = lines.sizeHint().height()
    lines.show_lines(1)
    assert lines.shown == ("−12.3 dB re 1 m/s² · Output 23, III knuckle",)
    assert 2 * lines.sizeHint().height() == two
    lines.show_text("2 outputs selected\nShift+click adds or removes one")
    assert lines.shown == ("2 outputs selected",)


def drawn_text(window, path):
    panel = window.panel("hand")
    save_drawing(path, panel.draw_picture, panel.width(), panel.height())
    return re.sub(r"<[^>]+>", "\n", path.read_text("utf-8"))


def test_legend_and_side_give_way_where_they_have_no_room(window, settle, tmp_path):
    window.resize(1366, 768)
    settle()
    text = drawn_text(window, tmp_path / "a.svg")
    assert "perpendicular" in text
    assert "palm side" in text
    try:
        window.appearance._scale_text(LARGEST_TEXT)
        settle()
        assert window.panel("hand").width() < 400
        text = drawn_text(window, tmp_path / "a.svg")
        assert "perpendicular" not in text
        assert "palm side" not in text
        assert "pad" in text
    finally:
        window.appearance.reset_text()


def test_the_bar_of_colours_is_as_narrow_as_before_once_letters_are_small_again(
    window, settle, qtbot
):
    bar = window.panel("skin").colour_bar
    usual = bar.width()
    window.appearance._scale_text(LARGEST_TEXT)
    settle()
    qtbot.waitUntil(lambda: bar.width() > usual)
    window.appearance.reset_text()
    window.appearance.fit_room(1.0)
    settle()
    qtbot.waitUntil(lambda: bar.width() == usual)
