"""The panels of traces and of spectra, with results of their own."""

from types import SimpleNamespace

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton

from skinsource import View, magnitude_spectrum, peak_hold_spectrum
from skinsource.design.panel_settings import with_settings
from skinsource.engine.moments import Projection
from skinsource.signals.resampling import extremes_between
from skinsource_gui.panels.spectra.panel import SpectraSettings
from skinsource_gui.plots.signal_view import SignalView
from skinsource_gui.state.preferences import start_design

SIGNED = View(method="pca", outputs=(29, 52, 7))
LINEAR = with_settings(
    View(method="pca", outputs=(29, 52)), "spectra", SpectraSettings(log_magnitude=False)
)
SPECTRA = {
    "record": ("selected_spectra", magnitude_spectrum),
    "loudest": ("selected_peak_spectra", peak_hold_spectrum),
}


def of(view, limb):
    """Results that say whose curves they are."""
    return {
        "limb": limb,
        "limb_data": SimpleNamespace(note="made from files of one's own"),
        "scaling": "upstream",
        "actuation": None,
        "match_gain": 1.0,
        "inputs": start_design(limb).inputs,
        "outputs": view.outputs,
        "axes": view.axes,
        "method": view.method,
        "span": view.span,
        "record_samples": 650,
        "sample_rate_hz": 1300.0,
    }


def traces_for(view, *, n_times=651, amplitude=0.3, limb="synthetic-1", without_axis=()):
    time_s = np.arange(n_times) / 1300 - (0.052 if view.delay_removed else 0.0)
    rows = [amplitude / (1 + k) * np.sin(300 * time_s) for k in range(len(view.outputs))]
    traces = np.array(rows).reshape(len(view.outputs), n_times)
    if view.method == "mag":
        traces = np.abs(traces)
    return of(view, limb) | {
        "response_time_s": time_s,
        "selected_traces": traces,
        "axis_traces": traces[:, np.newaxis],
        "selected_extremes": extremes_between(traces),
        "selected_projection": Projection((0,), np.ones((len(traces), 1))),
        "delay_removed": view.delay_removed,
        "selected_without_main_axis": without_axis,
    }


def spectra_for(view, *, n_times=650, amplitude=0.5, limb="synthetic-1"):
    time_s = np.arange(n_times) / 1300
    rows = [amplitude / 10**k * np.sin(2 * np.pi * 100 * time_s) for k in range(len(view.outputs))]
    traces = np.array(rows).reshape(len(view.outputs), n_times)
    name, spectrum = SPECTRA[view.span]
    return of(view, limb) | {name: spectrum(traces, 1300.0), "response_samples": n_times}


def opener(qtbot, kind, usual, results_for):
    """What opens a panel on a view, and does what it wants of the view.

    A panel of traces gets new results then; one of spectra draws those that it has.
    """

    def make(view=usual, **how):
        panel = kind()
        qtbot.addWidget(panel)
        panel.views = []
        design = start_design("synthetic-1")

        def look(changed):
            panel.views.append(changed)
            panel.show_state(design, changed)
            if results_for is traces_for:
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


def plot_of(panel):
    return panel.findChild(SignalView).plot


def header_of(panel):
    return plot_of(panel).stack.header.header


def click(panel, name):
    button = panel.findChild(QToolButton, name)
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    return button
