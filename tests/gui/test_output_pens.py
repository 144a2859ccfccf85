"""Lines of outputs can be told apart, also where there are more of them than colours."""

import numpy as np
import pytest
from PySide6.QtCore import QPointF
from PySide6.QtGui import QColor, QImage, QPainter

from skinsource_gui.panels.skin.painting import paint_ring
from skinsource_gui.plots.curves import CurvePoints, SignalCurve
from skinsource_gui.qt.theme import THEMES


def inked(picture, theme, rank):
    """Which pixels are rather like the colour of an output than like the ground."""
    ink, is_ink = theme.output_colour(rank), np.zeros((picture.height(), picture.width()), bool)
    ground = QColor(theme.base)
    for y in range(picture.height()):
        for x in range(picture.width()):
            here = picture.pixelColor(x, y)
            is_ink[y, x] = distance(here, ink) < distance(here, ground)
    return is_ink


def distance(colour, other):
    return sum(abs(a - b) for a, b in zip(colour.getRgb(), other.getRgb(), strict=True))


def drawn(theme, width, height, paint):
    picture = QImage(width, height, QImage.Format.Format_RGB32)
    picture.fill(QColor(theme.base))
    painter = QPainter(picture)
    paint(painter)
    painter.end()
    return picture


@pytest.mark.parametrize("theme", THEMES.values(), ids=THEMES)
def test_thirty_two_outputs_differ_in_colour_or_strokes(theme):
    pens = [theme.output_pen(rank, 0.0) for rank in range(32)]
    assert len({(pen.color().name(), tuple(pen.dashPattern())) for pen in pens}) == 32
    # The first of them have whole lines.
    assert all(not pens[rank].dashPattern() for rank in range(8))


@pytest.mark.parametrize("rank", [0, 8, 24])
def test_curves_and_rings_of_one_colour_have_strokes_of_their_own(qapp, rank):
    theme = THEMES["light"]

    def curve(painter):
        item = SignalCurve()
        item.set_look(theme.output_pen(rank, 0.0), stale=False)
        item.show_points(CurvePoints(x=np.array([0.0, 120.0]), y=np.full(2, 5.25), smooth=False))
        item.paint(painter, None, None)

    def ring(painter):
        pen = theme.output_pen(rank, 2.2)
        paint_ring(painter, QPointF(15, 15), 10.0, pen, QColor(theme.base))

    line = inked(drawn(theme, 100, 10, curve), theme, rank)[5]
    share = {0: (1.0, 1.0), 8: (0.55, 0.7), 16: (0.4, 0.6), 24: (0.6, 0.8)}[rank]
    assert share[0] <= line.mean() <= share[1]
    whole = inked(drawn(theme, 30, 30, lambda painter: ring(painter)), theme, rank).sum()
    assert (whole > 120) == (rank == 0)
