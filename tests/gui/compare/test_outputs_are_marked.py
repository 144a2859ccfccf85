"""Selected outputs are marked on the map of how snapshots differ, by rings and numbers."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QFontMetricsF, QImage, QPainter

from skinsource_gui.plots.small_map import number_areas, paint_rings, small_frame
from skinsource_gui.qt.theme import LIGHT
from tests.gui.compare.compare_bench import two_places

OUTPUTS = (19, 21, 24, 32)


@pytest.fixture
def compared(window, panel, settle):
    window.do("store_snapshot_1")
    two_places(window)
    window.document.look(replace(window.document.view, outputs=OUTPUTS))
    settle()
    return panel.map


def test_the_difference_marks_the_outputs_that_are_selected(window, compared, settle):
    assert compared.difference.outputs == OUTPUTS
    marked = compared.grab().toImage()
    window.document.look(replace(window.document.view, outputs=(21,)))
    settle()
    assert compared.difference.outputs == (21,)
    assert compared.grab().toImage() != marked


def test_rings_have_the_colours_of_the_curves(compared):
    small, area = compared.difference.shown, QRectF(0, 0, 400, 600)
    image = QImage(400, 600, QImage.Format.Format_RGB32)
    image.fill(0xFFFFFF)
    painter = QPainter(image)
    paint_rings(painter, small, area, OUTPUTS, LIGHT)
    painter.end()
    colours = {image.pixelColor(x, y).name() for x in range(400) for y in range(600)}
    for rank in range(len(OUTPUTS)):
        assert LIGHT.output_colour(rank).name() in colours


@pytest.mark.parametrize("size", [(240, 90), (180, 200), (400, 600)])
def test_numbers_stand_beside_their_rings_and_on_nothing_else(compared, size):
    small, area = compared.difference.shown, QRectF(0, 0, *size)
    metrics = QFontMetricsF(compared.font())
    places = number_areas(small, area, OUTPUTS, metrics)
    assert {number for number, _ in places} == set(OUTPUTS)
    points = small_frame(small.limb_map, area).to_screen(small.limb_map.output_positions)
    for number, place in places:
        x, y = points[number - 1]
        assert abs(place.center().x() - x) + abs(place.center().y() - y) < 6 * metrics.height()
        others = [other_place for other, other_place in places if other != number]
        assert not any(place.intersects(other_place) for other_place in others)


def test_of_many_outputs_no_numbers_are_written(compared):
    small, metrics = compared.difference.shown, QFontMetricsF(compared.font())
    assert number_areas(small, QRectF(0, 0, 400, 600), tuple(range(1, 40)), metrics) == []
