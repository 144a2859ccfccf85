"""Labels below a figure have room, wherever the last of them stands."""

import numpy as np
import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QFontMetricsF, QImage, QPainter
from PySide6.QtWidgets import QApplication

from skinsource_gui.plots import figure
from skinsource_gui.plots.figure import Axes, Axis, fitted_axes
from skinsource_gui.qt.theme import LIGHT, scaled


@pytest.mark.parametrize("scale", [1.0, 1.75])
@pytest.mark.parametrize("width", [200, 240, 303, 480, 900])
@pytest.mark.parametrize(
    ("lowest", "highest"),
    [(0.0, 650.0), (0.0, 2000.0), (0.0, 2001.0), (0.0, 24_000.0), (10.0, 2000.0), (1.0, 110.0)],
)
def test_no_label_of_x_reaches_beyond_the_room(qapp, width, lowest, highest, scale):
    metrics = QFontMetricsF(scaled(QApplication.font(), scale))
    x = Axis(shown=(lowest, highest), title="Hz", log=lowest > 0.0)
    y = Axis(shown=(-60.0, 20.0), title="dB")
    fitted = fitted_axes(QRectF(0, 0, width, 200), x, y, metrics)
    ends = [
        fitted.frame.left()
        + float(x.part(np.array(tick.value))) * fitted.frame.width()
        + metrics.horizontalAdvance(tick.label) / 2
        for tick in x.ticks(fitted.frame.width(), figure._TICK_X_PX)
    ]
    assert max(ends) <= width
    assert fitted.frame.width() > 0.3 * width


@pytest.mark.parametrize("width", [120, 170, 400])
def test_the_title_of_x_is_whole_where_the_frame_is_narrower_than_it(qapp, width):
    metrics = QFontMetricsF(QApplication.font())
    x = Axis(shown=(0.0, 60.0), title="Strength (m/s²)")
    fitted = fitted_axes(QRectF(0, 0, width, 200), x, Axis(shown=(-1.0, 0.0), title="dB"), metrics)
    place = fitted.title_place(metrics)
    assert place.width() >= metrics.horizontalAdvance(x.title)
    assert (place.left() >= 0.0, place.right() <= width) == (True, True)
    if width == 120:
        assert fitted.frame.width() < place.width()
    if width == 400:
        assert place.center().x() == pytest.approx(fitted.frame.center().x(), abs=1.0)


def test_decades_are_labelled_where_grid_lines_are_dense(qapp):
    class Painter(QPainter):
        def drawText(self, *arguments):
            written.append(arguments[-1])

    written, image = [], QImage(500, 400, QImage.Format.Format_RGB32)
    x = Axis(shown=(0.05, 2e4), title="x", log=True)
    axes = Axes(frame=QRectF(40, 10, 440, 340), x=x, y=Axis(shown=(0.0, 1.0), title="y"))
    painter = Painter(image)
    axes.paint(painter, LIGHT)
    painter.end()
    assert [text for text in written if text in ("0.1", "1", "10", "100")][:4] == [
        "0.1",
        "1",
        "10",
        "100",
    ]
