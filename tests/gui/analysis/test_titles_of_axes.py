"""Titles of axes are whole, however short the axis is."""

import numpy as np
import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QFont, QFontMetricsF, QImage, QPainter

from skinsource_gui.theme import LIGHT
from skinsource_gui.widgets.figure.axes import Axis, fitted_axes


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
    assert below.min() >= 1
    assert below.max() <= frame.right() + 4
    assert side.min() >= 1
    assert side.max() <= frame.bottom() + 24
    for ink, room in ((below, frame.right() + 4), (side, frame.bottom() + 20)):
        assert 0.8 * room < np.ptp(ink) < room
