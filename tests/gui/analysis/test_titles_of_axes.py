"""Titles of axes are whole, however short the axis is."""

from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QFont, QFontMetricsF, QImage, QPainter

from skinsource_gui.plots.figure import Axis, fitted_axes
from skinsource_gui.qt.theme import LIGHT, scaled


@pytest.fixture
def draw(qapp):
    """Draw axes with a title of 20 letters on each; where the frame is, and what has ink."""

    def drawn(width, height, title="Acceleration (m/s²)."):
        image = QImage(width, height, QImage.Format.Format_Grayscale8)
        image.fill(255)
        painter = QPainter(image)
        painter.setFont(QFont("Sans", 12))
        metrics = QFontMetricsF(painter.font())
        x = Axis(shown=(0.0, 1.0), title=title)
        axes = fitted_axes(QRectF(0, 0, width, height), x, x, metrics)
        axes.paint(painter, LIGHT)
        painter.end()
        pixels = np.frombuffer(image.constBits(), np.uint8).reshape(height, -1)[:, :width]
        line = int(metrics.height())
        ink = pixels < 160
        below = np.flatnonzero(ink[int(axes.frame.bottom()) + line + 3 :, :].any(axis=0))
        side = np.flatnonzero(ink[: int(axes.frame.bottom()) + line, : line - 2].any(axis=1))
        return axes.frame, below, side, metrics.horizontalAdvance(title)

    return drawn


def test_titles_stand_in_the_middle_of_long_axes(draw):
    frame, below, side, wide = draw(600, 500)
    assert below.mean() == pytest.approx(frame.center().x(), abs=6)
    assert side.mean() == pytest.approx(frame.center().y(), abs=6)
    for ink in (below, side):
        assert np.ptp(ink) == pytest.approx(wide, rel=0.1)


def test_a_title_that_is_longer_than_its_axis_stands_beside_the_labels_too(draw):
    *_, wide = draw(600, 500)
    frame, below, side, _ = draw(int(wide) + 16, int(wide) + 40)
    assert wide > frame.width()
    assert wide > frame.height()
    for ink in (below, side):
        assert np.ptp(ink) == pytest.approx(wide, rel=0.1)


def test_where_even_that_is_too_short_a_title_is_written_smaller(draw):
    *_, wide = draw(600, 500)
    size = int(0.7 * wide)
    frame, below, side, _ = draw(size, size)
    assert below.max() <= frame.right() + 8
    assert side.min() >= 1
    assert side.max() <= frame.bottom() + 24
    for ink, room in ((below, frame.right() + 8), (side, frame.bottom() + 20)):
        assert 0.8 * room < np.ptp(ink) <= room


def numbers_below(width, scale):
    """Numbers below an axis, each with where it begins and ends, from left to right."""
    written = []

    class Noting(QPainter):
        def drawText(self, *what):
            # Those beside the axis of y begin at the edge.
            if what[0].left() > 0:
                written.append((what[0].left(), what[0].right(), what[2]))

    image = QImage(width, 200, QImage.Format.Format_Grayscale8)
    painter = Noting(image)
    painter.setFont(scaled(QFont("Sans", 10), scale))
    time = Axis(shown=(1.01, 1.035), title="", factor=1e3)
    level = Axis(shown=(0.0, 1.0), title="")
    room = QRectF(0, 0, width, 200)
    fitted_axes(room, time, level, QFontMetricsF(painter.font())).paint(painter, LIGHT)
    painter.end()
    return [number for number in written if number[2]]


@pytest.mark.parametrize(("width", "scale"), [(240, 1.0), (240, 2.0), (240, 3.0), (600, 3.0)])
def test_no_number_of_an_axis_is_cut_or_lies_on_another(qapp, width, scale):
    numbers = numbers_below(width, scale)
    assert numbers
    metrics = QFontMetricsF(scaled(QFont("Sans", 10), scale))
    for (_, end, _), (begin, _, _) in pairwise(numbers):
        assert end < begin
    for begin, end, label in numbers:
        assert end - begin >= metrics.horizontalAdvance(label) - 0.01
