"""The plot of traces and spectra, without a panel."""

import pytest

from skinsource_gui.widgets.plot.signal_plot import SignalPlot
from tests.gui.signal_plot.bench import TIME


@pytest.fixture
def plot(qtbot):
    widget = SignalPlot("plot", "Plot")
    qtbot.addWidget(widget)
    widget.resize(420, 172)
    widget.set_view(TIME, None, stacked=False)
    widget.show()
    qtbot.waitExposed(widget)
    return widget
