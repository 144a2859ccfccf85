"""Words on a page are found by those who search it."""

import re

import pytest
from PySide6.QtGui import QFont

from skinsource_gui.plots.pictures import save_drawing
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
