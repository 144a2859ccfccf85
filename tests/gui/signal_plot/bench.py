"""The plot of traces and spectra, without a panel."""

import numpy as np
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication

from skinsource_gui.widgets.plot.curves import Curves, output_names
from skinsource_gui.widgets.plot.plot_axis import (
    XAxis,
)

TIME = XAxis(titles=("Time (ms) and much more to say about it", "Time (ms)"), unit="ms", factor=1e3)


FREQUENCY = XAxis(titles=("Frequency (Hz)",), unit="Hz", extent=(10.0, 650.0), log=True)


def waves(n_curves=2, n_points=651, amplitude=0.3):
    x = np.arange(n_points) / 1300
    y = [amplitude / (1 + k) * np.sin(2 * np.pi * 20 * x + k) for k in range(n_curves)]
    return Curves(x=x, y=np.array(y), names=output_names(tuple(range(1, n_curves + 1))))


def turn_wheel(canvas, x, modifiers, turned=120):
    at = QPointF(x, 60)
    event = QWheelEvent(
        at,
        canvas.mapToGlobal(at),
        QPoint(),
        QPoint(0, turned),
        Qt.MouseButton.NoButton,
        modifiers,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(canvas, event)
