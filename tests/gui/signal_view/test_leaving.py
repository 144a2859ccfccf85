"""A view of signals that goes leaves nothing behind."""

import gc
import weakref

import pyqtgraph
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QApplication

from skinsource_gui.plots.signal_view import SignalView
from tests.gui.signal_view.bench import TIME, waves


def test_a_closed_view_leaves_no_plot_no_scene_and_no_view_box(qapp):
    boxes, widgets = set(pyqtgraph.ViewBox.AllViews), set(QApplication.allWidgets())
    view = SignalView("plot", "Plot")
    view.show()
    view.set_view(TIME, None, stacked=True)
    view.show_curves(waves(5), synthetic=True)
    view.plot.crosshair.put(10)
    QApplication.processEvents()
    assert len(set(pyqtgraph.ViewBox.AllViews) - boxes) == 5
    gone = [weakref.ref(part) for part in (view, view.plot, view.plot.scene())]
    view.close()
    view.deleteLater()
    del view
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    gc.collect()
    assert [part() for part in gone] == [None, None, None]
    assert set(pyqtgraph.ViewBox.AllViews) <= boxes
    assert set(QApplication.allWidgets()) <= widgets
