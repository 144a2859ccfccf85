"""The picture of the map that is saved: its size, its heading, its colours, its formats."""

import re

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QSizeF
from PySide6.QtGui import QColor, QImage, QPainter
from PySide6.QtSvg import QSvgRenderer

from skinsource_gui.panels.skin import picture as map_picture
from skinsource_gui.panels.skin.painting import MapContent
from skinsource_gui.panels.skin.picture import Heading, heading_of, paint_picture
from skinsource_gui.plots.pictures import save_drawing
from skinsource_gui.qt.theme import DARK, LIGHT
from tests.gui.skin.bench import (
    pixel,
)


@pytest.mark.parametrize("size", [(320, 240), (600, 800), (2000, 1200)])
def test_pictures_have_the_size_asked_for(window, size):
    picture = window.panel.picture(*size)
    assert isinstance(picture, QImage)
    assert (picture.width(), picture.height()) == size


@pytest.mark.parametrize("size", [(320, 240), (400, 900), (1200, 1800), (2400, 600)])
@pytest.mark.parametrize("text", ["short", "a much longer heading " * 6])
def test_no_heading_is_cut(qtbot, size, text):
    """With and without a margin that words could reach into, the same pixels are inked."""
    width, height = size
    content, heading = MapContent(), Heading(title=text, details=text)
    inked = []
    for margin in (0, 400):
        image = QImage(width + 2 * margin, height, QImage.Format.Format_RGB32)
        image.fill(QColor(LIGHT.base))
        painter = QPainter(image)
        painter.translate(margin, 0)
        paint_picture(painter, QSizeF(width, height), content, heading, LIGHT, "sans")
        painter.end()
        pixels = np.frombuffer(image.constBits(), np.uint32).reshape(height, -1) & 0xFFFFFF
        inked.append(pixels != 0xFFFFFF)
    assert inked[0].any()
    assert inked[0].sum() == inked[1].sum()
    edge = inked[0][:, [0, 1, -2, -1]]
    assert not edge.any()


def test_pictures_say_what_is_shown_over_what_and_of_whom(window):
    heading = heading_of(window.design, window.view)
    assert heading.title == "Skin acceleration, RMS over the whole record"
    assert heading.details == "Synthetic 1 (175 mm) · x, y, z, principal axis"


def test_pictures_say_what_strokes_mean_where_there_are_some(window, monkeypatch):
    headings = []
    monkeypatch.setattr(
        map_picture,
        "_paint_heading",
        lambda painter, inner, heading, *rest: headings.append(heading) or 0.0,
    )
    for noisy in ((), (3, 4)):
        window.panel.show_noisy(noisy)
        window.panel.picture(300, 400)
    assert ["hatched" in cell.details for cell in headings] == [False, True]
    assert headings[1].details.endswith("hatched: less than 6 dB above the noise")


def test_pictures_are_light_unless_another_theme_is_asked_for(window, use_theme):
    use_theme(DARK)
    assert pixel(window.panel.picture(300, 400), QPoint(2, 2)) == (255, 255, 255)
    dark = pixel(window.panel.picture(300, 400, DARK), QPoint(2, 2))
    assert dark == QColor(DARK.base).getRgb()[:3]


def test_pictures_of_lines_look_like_those_of_pixels(window, tmp_path):
    for name in ("map.png", "map.svg", "map.pdf"):
        save_drawing(tmp_path / name, window.panel.draw_picture, 600, 900)
    expected = QImage(str(tmp_path / "map.png"))
    assert (expected.width(), expected.height()) == (600, 900)
    drawn = QImage(600, 900, QImage.Format.Format_RGB32)
    painter = QPainter(drawn)
    renderer = QSvgRenderer(str(tmp_path / "map.svg"))
    assert renderer.isValid()
    renderer.render(painter)
    painter.end()
    difference = np.abs(
        np.frombuffer(drawn.constBits(), np.uint8).astype(int)
        - np.frombuffer(expected.convertToFormat(drawn.format()).constBits(), np.uint8)
    )
    assert difference.mean() < 6
    svg = (tmp_path / "map.svg").read_text("utf-8")
    assert "<path" in svg
    assert "whole record" in svg
    pdf = (tmp_path / "map.pdf").read_bytes()
    assert pdf.startswith(b"%PDF-")
    # 600 x 900 px at 96 to the inch, in points.
    box = re.search(rb"/MediaBox \[([\d. ]+)\]", pdf)
    assert [float(side) for side in box[1].split()] == pytest.approx([0, 0, 450, 675], abs=1)


@pytest.mark.parametrize(("size", "least_px"), [((1280, 720), 20), ((336, 504), 9)])
def test_words_on_a_slide_are_read_from_afar(window, tmp_path, size, least_px):
    save_drawing(tmp_path / "a.svg", window.panel.draw_picture, *size)
    drawing = (tmp_path / "a.svg").read_text("utf-8")
    sizes = [float(size) for size in re.findall(r'<text[^>]*font-size="([\d.]+)"', drawing)]
    assert max(sizes) >= least_px
    assert min(sizes) >= 0.7 * least_px
