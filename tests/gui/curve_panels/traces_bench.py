"""The panel of the traces, with results of its own."""

import numpy as np

from skinsource.design.view import View
from skinsource.engine.moments import Projection
from skinsource.signals.resampling import extremes_between
from skinsource_gui.panels.traces.panel import TracesPanel
from skinsource_gui.state.preferences import start_design
from tests.gui.curve_panels.bench import whose

SIGNED = View(method="pca", outputs=(29, 52, 7))


def results_for(view, *, n_times=651, amplitude=0.3, limb="synthetic-1", without_axis=()):
    time_s = np.arange(n_times) / 1300 - (0.052 if view.delay_removed else 0.0)
    rows = [amplitude / (1 + k) * np.sin(300 * time_s) for k in range(len(view.outputs))]
    traces = np.array(rows).reshape(len(view.outputs), n_times)
    if view.method == "mag":
        traces = np.abs(traces)
    return {
        "response_time_s": time_s,
        "selected_traces": traces,
        "axis_traces": traces[:, np.newaxis],
        "selected_extremes": extremes_between(traces),
        "selected_projection": Projection((0,), np.ones((len(traces), 1))),
        "outputs": view.outputs,
        "delay_removed": view.delay_removed,
        "axes": view.axes,
        "method": view.method,
        "span": view.span,
        "selected_without_main_axis": without_axis,
        **whose(limb),
    }


def opener(qtbot):
    """What opens a traces panel on a view; what it wants of the view is done."""

    def make(view=SIGNED, **how):
        panel = TracesPanel()
        qtbot.addWidget(panel)
        panel.views = []
        design = start_design("synthetic-1")

        def look(changed):
            panel.views.append(changed)
            panel.show_state(design, changed)
            panel.show_results(results_for(changed, **how))

        panel.view_changed.connect(look)
        panel.edited.connect(lambda edit, _: look(edit.view))
        panel.resize(420, 200)
        panel.show()
        qtbot.waitExposed(panel)
        panel.show_state(design, view)
        panel.show_results(results_for(view, **how))
        return panel

    return make
