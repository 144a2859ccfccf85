"""Which output is which, and which band: told in the picture, whole and apart."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QFont, QFontMetricsF, QImage, QPainter

from skinsource_gui.panels.analysis.linearity_diagram import (
    Curve,
    places_of_labels,
    x_with_room_for_labels,
)
from skinsource_gui.plots.figure import Axis, fitted_axes, legend_texts
from skinsource_gui.plots.pictures import save_drawing
from skinsource_gui.qt.theme import LIGHT
from tests.gui.analysis.test_linearity_panel import OUTPUTS, STRENGTHS, show
from tests.gui.test_pictures_out import texts_of

__all__ = ["show"]

X = Axis(shown=(0.5, 8.0), title="Strength (m/s²)", log=True)
Y = Axis(shown=(1e-3, 1.0), title="In the band (m/s²)", log=True)
CURVES = tuple(
    Curve(
        x=np.array([0.75, 6.0]),
        y=np.array([0.1, 0.8]) / 1.3**k,
        rank=k % 2,
        width_px=1.0,
        label=f"{50 * 2 ** (k // 2)} Hz",
    )
    for k in range(8)
)


@pytest.fixture
def painter(qapp):
    del qapp
    image = QImage(400, 300, QImage.Format.Format_RGB32)
    painter = QPainter(image)
    yield painter
    painter.end()


@pytest.mark.parametrize("size", [(160, 90), (230, 130), (500, 400)])
@pytest.mark.parametrize("letters_px", [11, 14])
@pytest.mark.parametrize("height", [1.0, 0.008], ids=["high", "at the bottom"])
def test_labels_of_bands_are_whole_inside_the_plot_and_apart(painter, size, letters_px, height):
    curves = tuple(replace(curve, y=height * curve.y) for curve in CURVES)
    font = QFont(painter.font())
    font.setPixelSize(letters_px)
    metrics, room = QFontMetricsF(font), QRectF(0, 0, *size)
    axes = fitted_axes(room, X, Y, metrics)
    axes = fitted_axes(room, x_with_room_for_labels(axes, curves, metrics), Y, metrics)
    letters, places = places_of_labels(axes, curves, font)
    line = QFontMetricsF(letters).height()
    if size[1] > 200:
        assert len(places) == len(curves)
    for place, curve in places:
        assert QFontMetricsF(letters).horizontalAdvance(curve.label) <= place.width()
        assert place.right() <= axes.frame.right()
        assert axes.frame.top() - 0.1 * line <= place.top()
        assert place.bottom() <= axes.frame.bottom() + 0.1 * line
    assert np.diff([place.top() for place, _ in places]).min() >= 0.85 * line
    # They stand in the order of their curves.
    ends = [curve.y[-1] for _, curve in places]
    assert ends == sorted(ends, reverse=True)


def test_a_legend_has_all_outputs_or_counts_those_without_room(painter):
    assert legend_texts((20,), 400.0, painter) == ["Output", "20"]
    assert legend_texts((20, 26), 400.0, painter) == ["Outputs", "20", "26"]
    few = legend_texts(tuple(range(1, 60)), 300.0, painter)
    assert few[-1] == f"+{59 - len(few) + 2}"


def test_the_picture_says_which_output_has_which_colour(show, tmp_path):
    window, panel = show(STRENGTHS)
    assert panel.picture.outputs == OUTPUTS
    path = tmp_path / "a.svg"
    save_drawing(path, window.pictures.picture_of("analysis/linearity").draw, 900, 500)
    texts = texts_of(path)
    for word in ("Outputs", *map(str, OUTPUTS)):
        assert word in texts
    drawing = path.read_text("utf-8").lower()
    for rank in range(len(OUTPUTS)):
        assert LIGHT.output_colour(rank).name() in drawing
