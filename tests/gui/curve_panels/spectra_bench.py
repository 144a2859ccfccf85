"""The panel of the spectra, with results of its own."""

import numpy as np

from skinsource.design.panel_settings import with_settings
from skinsource.design.view import View
from skinsource.signals.spectra import magnitude_spectrum, peak_hold_spectrum
from skinsource_gui.panels.spectra.panel import SpectraPanel, SpectraSettings
from skinsource_gui.state.preferences import start_design
from tests.gui.curve_panels.bench import whose

LINEAR = with_settings(
    View(method="pca", outputs=(29, 52)), "spectra", SpectraSettings(log_magnitude=False)
)
SPECTRA = {
    "record": ("selected_spectra", magnitude_spectrum),
    "loudest": ("selected_peak_spectra", peak_hold_spectrum),
}


def results_for(view, *, n_times=650, amplitude=0.5, limb="synthetic-1", silence=0):
    time_s = np.arange(n_times) / 1300
    rows = [amplitude / 10**k * np.sin(2 * np.pi * 100 * time_s) for k in range(len(view.outputs))]
    traces = np.pad(np.array(rows).reshape(len(view.outputs), n_times), ((0, 0), (0, silence)))
    return {
        SPECTRA[view.span][0]: SPECTRA[view.span][1](traces, 1300.0),
        "span": view.span,
        "outputs": view.outputs,
        "axes": view.axes,
        "method": view.method,
        "sample_rate_hz": 1300.0,
        **whose(limb),
    }


def opener(qtbot):
    """What opens a spectra panel on a view; its wishes are done, without new results."""

    def make(view=LINEAR, **how):
        panel = SpectraPanel()
        qtbot.addWidget(panel)
        panel.views = []
        design = start_design("synthetic-1")

        def look(changed):
            panel.views.append(changed)
            panel.show_state(design, changed)

        panel.view_changed.connect(look)
        panel.resize(420, 200)
        panel.show()
        qtbot.waitExposed(panel)
        panel.show_state(design, view)
        panel.show_results(results_for(view, **how))
        return panel

    return make
