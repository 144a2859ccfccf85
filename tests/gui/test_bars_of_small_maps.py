"""Maps in rows have a bar of millimetres where they are printed."""

import re

import numpy as np
import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QImage, QPainter

import skinsource as ss
from skinsource.design.view import View
from skinsource_gui.plots.pictures import save_drawing
from skinsource_gui.plots.small_map import SmallMap, paint_small_bar
from skinsource_gui.qt.theme import LIGHT, on_paper
from tests.gui.pages_of_paper import Paper

DESIGN = ss.Design(
    limb="synthetic-1",
    inputs=(ss.track(7, ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.5)),),
)


@pytest.mark.parametrize(("name", "bars"), [("compare", 4), ("analysis/windowed", 1)])
def test_each_limb_has_a_bar_on_paper(open_window, settle, tmp_path, name, bars):
    window = open_window(DESIGN, View(panels=(("compare", (("of", "limbs"),)),)))
    settle()
    picture = window.pictures.picture_of(name)
    save_drawing(tmp_path / "a.pdf", picture.draw, 900, 600)
    assert len(re.findall(r"0 mm(?!\))", Paper(tmp_path / "a.pdf").text())) == bars


@pytest.mark.parametrize(("limb", "hand_mm"), [("synthetic-1", 175.0), ("synthetic-3", 185.0)])
def test_the_bar_is_as_long_as_it_says_and_on_paper_alone(qapp, limb, hand_mm):
    limb_map = ss.load_limb(limb).map
    area = QRectF(0, 0, 300, 900)

    def painted():
        image = QImage(300, 900, QImage.Format.Format_RGB32)
        image.fill(QColor(LIGHT.base))
        painter = QPainter(image)
        paint_small_bar(painter, area, SmallMap(limb_map=limb_map), limb, LIGHT)
        painter.end()
        return [
            x for x in range(300) if QColor(image.pixel(x, 897)).name() == QColor(LIGHT.text).name()
        ]

    assert painted() == []
    with on_paper():
        dark = painted()
    # The arm is as wide as the area.
    px_per_mm = 300 / np.ptp(limb_map.outline[:, 0]) * limb_map.hand_length_px / hand_mm
    lengths_mm = np.array([100, 50, 20, 10])
    assert np.abs(lengths_mm * px_per_mm - len(dark)).min() <= 1.5
    assert 20 < len(dark) <= 75
