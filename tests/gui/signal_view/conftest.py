"""The plot of traces and spectra, without a panel."""

import pytest

from skinsource_gui.plots.signal_view import SignalView
from tests.gui.signal_view.bench import TIME


@pytest.fixture
def signals(qtbot):
    widget = SignalView("plot", "Plot")
    qtbot.addWidget(widget)
    widget.resize(420, 200)
    widget.plot.set_view(TIME, None, stacked=False)
    widget.show()
    qtbot.waitExposed(widget)
    return widget
