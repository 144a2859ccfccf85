"""Words on a page are found by those who search it."""

import re

import pytest
from PySide6.QtGui import QFont

import skinsource as ss
from skinsource_gui.plots.pictures import save_drawing, searchable
from skinsource_gui.qt.theme import LIGHT, apply_theme, tabular
from tests.gui.pages_of_paper import Paper


@pytest.fixture
def page(qapp, tmp_path):
    sheet = qapp.styleSheet()
    apply_theme(qapp, LIGHT)

    def draw(painter, width, height):
        painter.setFont(qapp.font())
        painter.drawText(10, 30, "Made from files that differ")
        painter.setFont(tabular(QFont(qapp.font().family())))
        painter.drawText(10, 50, " in five fields")

    save_drawing(tmp_path / "a.pdf", draw, 400, 60)
    qapp.setStyleSheet(sheet)
    return tmp_path / "a.pdf"


def test_words_stand_on_a_page_letter_by_letter_with_blanks_between_them(page):
    assert Paper(page).text() == "Made from files that differ in five fields"


def test_what_fonts_say_is_mended_in_an_update_that_readers_find(page):
    written = page.read_bytes()
    first, second = (int(offset) for offset in re.findall(rb"startxref\s+(\d+)", written))
    assert written[second:].startswith(b"xref")
    assert written[first:].startswith(b"xref")
    assert b"/Prev %d" % first in written[second:]
    listed = re.findall(rb"(\d+) 1\n(\d{10}) 00000 n \n", written[second:])
    assert listed
    for number, place in listed:
        assert written[int(place) :].startswith(number + b" 0 obj")


def test_a_page_that_is_not_as_expected_stays_as_it_is():
    assert searchable(b"%PDF-1.4 of somebody else") == b"%PDF-1.4 of somebody else"


def test_the_picture_of_a_panel_can_be_searched(make_window, tmp_path):
    tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)
    window = make_window(ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone),)))
    picture = window.pictures.picture_of("skin")
    save_drawing(tmp_path / "a.pdf", picture.draw, 600, 900)
    text = Paper(tmp_path / "a.pdf").text()
    # Lines of the caption are put one by one, and end where there is no room.
    assert "scaling: probe" in text
    assert "Limb: Synthetic 1 (175 mm)" in text
