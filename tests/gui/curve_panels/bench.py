"""What the panels of traces and of spectra have in common."""

from types import SimpleNamespace

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton

from skinsource_gui.plots.signal_view import SignalView
from skinsource_gui.state.preferences import start_design


def whose(limb):
    """What says whose curves they are."""
    loaded = SimpleNamespace(note="made from files of one's own")
    design = start_design(limb)
    return {
        "limb": limb,
        "limb_data": loaded,
        "scaling": "upstream",
        "actuation": None,
        "match_gain": 1.0,
        "inputs": design.inputs,
    }


def plot_of(panel):
    return panel.findChild(SignalView).plot


def header_of(panel):
    return plot_of(panel).stack.header.header


def click(panel, name):
    button = panel.findChild(QToolButton, name)
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    return button
