"""Labels below a figure have room, wherever the last of them stands."""

import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QFontMetricsF
from PySide6.QtWidgets import QApplication

from skinsource_gui.theme import scaled
from skinsource_gui.widgets.figure import axes
from skinsource_gui.widgets.figure.axes import Axis, fitted_axes


@pytest.mark.parametrize("scale", [1.0, 1.75])
@pytest.mark.parametrize("width", [200, 240, 303, 480, 900])
@pytest.mark.parametrize("highest", [650.0, 2000.0, 2001.0, 24_000.0])
def test_no_label_of_x_reaches_beyond_the_room(qapp, width, highest, scale):
    metrics = QFontMetricsF(scaled(QApplication.font(), scale))
    x, y = Axis(shown=(0.0, highest), title="Hz"), Axis(shown=(-60.0, 20.0), title="dB")
    fitted = fitted_axes(QRectF(0, 0, width, 200), x, y, metrics)
    ends = [
        fitted.frame.left()
        + tick.value / highest * fitted.frame.width()
        + metrics.horizontalAdvance(tick.label) / 2
        for tick in x.ticks(fitted.frame.width(), axes._TICK_X_PX)
    ]
    assert max(ends) <= width
    assert fitted.frame.width() > 0.3 * width
