"""Letters of the picture of all panels become smaller with it, and that is said before."""

import re
from dataclasses import replace
from math import hypot

import pytest
from PySide6.QtWidgets import QPushButton

from skinsource_gui.plots.pictures import (
    ALL_VISIBLE,
    Picture,
    PictureDialog,
    PictureOptions,
    layout_of,
    letters_remark,
    save_drawing,
)
from skinsource_gui.state.preferences import start_design


def smallest_px(path):
    """Of all letters of a drawing, the height of the smallest, as they are on the page."""
    sizes, scale = [], 1.0
    drawing = path.read_text("utf-8")
    pattern = re.compile(r'<g [^>]*matrix\(([^,]+),([^,]+),|<text [^>]*font-size="([\d.]+)"')
    for match in pattern.finditer(drawing):
        if match[1]:
            scale = hypot(float(match[1]), float(match[2]))
        else:
            sizes.append(scale * float(match[3]))
    return min(sizes)


@pytest.mark.parametrize("layout", ["column", "two_columns"])
def test_letters_that_cannot_be_read_in_print_are_said_before_the_picture_of_all_panels_is_saved(
    open_window, qtbot, tmp_path, layout
):
    window = open_window(start_design("synthetic-1"))
    picture = window.pictures.picture_of(ALL_VISIBLE)
    width, height = layout_of(layout).size_px(picture.size_px)
    path = tmp_path / "a.svg"
    save_drawing(path, picture.draw, width, height)
    form = PictureDialog(
        PictureOptions(width_px=picture.size_px[0], height_px=picture.size_px[1]),
        remark=letters_remark(picture),
    )
    qtbot.addWidget(form)
    form._edit("layout", layout, None)
    told_pt = float(re.search(r"The smallest letters are ([\d.]+) pt", form.remark_label.text())[1])
    assert told_pt == pytest.approx(smallest_px(path) * 0.75, rel=0.2)
    needed_px = int(re.search(r"a width of (\d+) px", form.remark_label.text())[1])
    form._edit("width_px", float(needed_px), None)
    form._edit("height_px", float(round(needed_px * height / width)), None)
    assert form.remark_label.text() == ""
    save = next(button for button in form.findChildren(QPushButton) if button.text() == "Save as…")
    assert save.isEnabled()


def test_a_picture_that_lays_itself_out_keeps_its_letters():
    picture = Picture(draw=print, size_px=(1366, 768), letters_px=lambda w, h: 1.0)
    assert letters_remark(replace(picture, letters_px=None)) is None
