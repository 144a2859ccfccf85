"""The panel of the actuator in a window, and what it shows."""

from skinsource.design.design import Design, track
from skinsource.design.panel_settings import settings_of
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.actuator_demand import ActuatorSettings

TONE = track(7, Tone(frequency_hz=100.0, duration_s=0.3), amplitude=10.0)


def design_of(*inputs):
    return Design(limb="synthetic-1", scaling="probe", inputs=inputs)


def brought_forward(window, qtbot):
    window.docks["actuator"].bring_forward()
    panel = window.panel("actuator")
    qtbot.waitUntil(panel.isVisible)
    settle(window, qtbot)
    return panel


def settle(window, qtbot):
    window.catch_up()
    qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)


def figures(panel):
    return {figure.label: figure for figure in panel.figures.table.figures}


def number(panel, label):
    return float(figures(panel)[label].value.split()[0])


def settings(window):
    return settings_of(window.document.view, "actuator", ActuatorSettings)


def choose(panel, name, value, gesture=None):
    panel.choices.cell(name).edited.emit(name, value, gesture)
