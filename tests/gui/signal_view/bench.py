"""The plot of traces and spectra, without a panel."""

import numpy as np
from PySide6.QtCore import QPointF

from skinsource_gui.plots.curves import Curves, output_names
from skinsource_gui.plots.ranges import XAxis
from tests.gui import wheel

TIME = XAxis(titles=("Time (ms) and much more to say about it", "Time (ms)"), unit="ms", factor=1e3)


FREQUENCY = XAxis(titles=("Frequency (Hz)",), unit="Hz", extent=(10.0, 650.0), log=True)


def waves(n_curves=2, n_points=651, amplitude=0.3):
    x = np.arange(n_points) / 1300
    y = [amplitude / (1 + k) * np.sin(2 * np.pi * 20 * x + k) for k in range(n_curves)]
    return Curves(
        x=x, y=np.array(y), names=output_names(tuple(range(1, n_curves + 1)), "synthetic-1")
    )


def turn_wheel(signals, x, modifiers, turned=120, *, aside=False):
    by = (turned, 0) if aside else (0, turned)
    wheel.turn_wheel(signals.plot.viewport(), QPointF(x, 60), by, modifiers)


def left_and_width(signals):
    """Left edge and width of the part where curves are, px."""
    area = signals.plot.places.area
    return area.left(), area.width()


def drawn(signals):
    """Items of the curves that are drawn, by rank."""
    rows = signals.plot.stack.rows
    return [curve for row in rows for curve in row.curves[: row.n_curves]]


def header_of(signals):
    """What is said above the curves."""
    return signals.plot.stack.header.header
