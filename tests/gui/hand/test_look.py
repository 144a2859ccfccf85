"""The hand panel, driven by real mouse and key events."""

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF
from PySide6.QtGui import QColor, QFontMetricsF, QHelpEvent, QImage, QPainter
from PySide6.QtWidgets import QApplication, QToolTip

from skinsource.design.design import track
from skinsource_gui.panels.hand import layout
from skinsource_gui.panels.hand.layout import Marker, contrast, paint_occupied, readable_on
from skinsource_gui.qt.theme import DARK, LIGHT, Theme
from tests.gui.hand.bench import KEY

# Showing


def test_an_input_has_its_own_colour_on_the_hand_in_both_themes(studio, use_theme):
    studio.show(track(location=20), track(location=16), selected=1)
    for theme in (LIGHT, DARK):
        use_theme(theme)
        image = studio.diagram.grab().toImage()
        for index, site in enumerate((20, 16)):
            point = studio.diagram.site_centre(site) + QPoint(0, 8)
            assert image.pixelColor(point).name() == theme.inputs[index]


def test_a_silent_input_is_hollow(studio):
    studio.show(track(location=20, muted=True))
    image = studio.diagram.grab().toImage()
    point = studio.diagram.site_centre(20)
    assert image.pixelColor(point + QPoint(0, 7)).name() != LIGHT.inputs[0]


def test_sites_of_both_contacts_differ_in_shape(studio):
    hand = studio.diagram.stage.layout
    assert [site for site in range(1, 21) if hand.push(site) is not None] == [1, 2, 3, 4, 5]


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=lambda theme: theme.name)
def test_numbers_are_readable_on_every_input_colour(theme: Theme):
    for number in range(len(theme.inputs)):
        colour = theme.input_colour(number)
        assert contrast(readable_on(colour), colour) >= 4.5


def test_which_hand_it_is_stands_whole_in_letters_of_any_size(studio):
    rooms = []

    class Noting(QPainter):
        def drawText(self, *args):
            if isinstance(args[0], QRectF) and "palm side" in str(args[-1]):
                rooms.append((args[0], args[-1], QFontMetricsF(self.font())))
            super().drawText(*args)

    image = QImage(900, 700, QImage.Format.Format_RGB32)
    picture = studio.diagram.stage._picture
    for points in (9.0, 27.0):
        painter = Noting(image)
        font = painter.font()
        font.setPointSizeF(points)
        painter.setFont(font)
        picture.resize(image.size(), QFontMetricsF(font))
        picture._paint_side(painter)
        painter.end()
    assert len(rooms) == 2
    for room, text, metrics in rooms:
        assert room.width() >= max(map(metrics.horizontalAdvance, text.split("\n")))
        assert room.left() > 0.0


def test_the_tooltip_names_place_contact_and_inputs(studio):
    studio.show(track(location=2, muted=True), selected=0)
    point = studio.diagram.site_centre(2)
    event = QHelpEvent(QEvent.Type.ToolTip, point, studio.diagram.mapToGlobal(point))
    QApplication.sendEvent(studio.diagram, event)
    text = QToolTip.text()
    for expected in ("2 ·", "Digit II, tip", "in-axis", "Tone, muted, selected"):
        assert expected in text
    QToolTip.hideText()


def test_the_cursor_is_announced(studio):
    studio.show(track(location=7))
    studio.keys(KEY.Key_7)
    text = studio.diagram.accessibleDescription()
    assert text.startswith("Place 7 · Digit II, pad. perpendicular")
    assert "Input 1: Tone" in text
    assert studio.diagram.accessibleName()


def test_a_selection_that_the_design_has_lost_is_not_shown(studio):
    studio.show(track(location=7), selected=4)
    assert studio.diagram.state.selected is None


def test_the_panel_needs_nothing_computed(studio):
    assert studio.panel.needs == frozenset()


@pytest.mark.parametrize("size", [(260, 330), (260, 900), (900, 330), (700, 1200)])
def test_all_sites_stay_inside_at_every_size(studio, size):
    studio.panel.resize(*size)
    radius = round(studio.diagram.stage.layout.radius_px(20))
    for site in range(1, 21):
        area = studio.diagram.stage.layout.marker_area(site).toAlignedRect()
        assert studio.diagram.rect().contains(area.adjusted(-radius // 4, 0, radius // 4, 0))


@pytest.mark.parametrize("count", [2, 9, 21, 100])
def test_the_count_of_inputs_at_a_site_is_never_cut_off(qtbot, count):
    image = QImage(160, 80, QImage.Format.Format_RGB32)
    image.fill(QColor("red"))
    painter = QPainter(image)
    place = Marker(site=9, centre=QPointF(60, 30), radius_px=11.0, push=None)
    paint_occupied(painter, place, LIGHT, [QColor("red")] * count, silent=False)
    painter.end()
    # Digits are written in the colour of the ground, on a badge in the colour of words, which
    # must be left and right of every one of them.
    middle = round(30 + 0.95 * 11.0)
    row = [image.pixelColor(x, middle).lightness() for x in range(160)]
    dark = [x for x in range(40, 160) if row[x] < 60]
    line = "".join("#" if row[x] < 60 else "." for x in range(dark[0], dark[-1] + 1))
    font_px = 9
    assert len(line) >= 0.55 * font_px * len(f"×{count}")
    assert line.startswith("##")
    assert line.endswith("##")


def test_in_large_words_only_places_in_use_and_the_one_pointed_at_have_numbers(studio, monkeypatch):
    numbers = []
    paint = layout._paint_number

    def note(painter, place, colour, *, bold):
        numbers.append(place.site)
        paint(painter, place, colour, bold=bold)

    def shown():
        numbers.clear()
        studio.diagram.grab()
        return set(numbers)

    monkeypatch.setattr(layout, "_paint_number", note)
    studio.panel.resize(500, 500)
    studio.show(track(location=7), track(location=12, muted=True), selected=0)
    assert shown() == set(range(1, 21))
    font = studio.diagram.font()
    font.setPointSizeF(1.25 * font.pointSizeF())
    studio.diagram.setFont(font)
    assert shown() == {7, 12}
    studio.diagram.stage.change(hovered=18)
    assert shown() == {7, 12, 18}
    studio.diagram.stage.change(hovered=None, cursor=3)
    assert shown() == {3, 7, 12}
    # While an input is moved all places offer themselves.
    studio.diagram.stage.change(cursor=None, moving=0, ghost=QPointF(10, 10), target=15)
    assert shown() == set(range(1, 21))
