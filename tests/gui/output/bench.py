"""The panel of the output in a window, and what it shows."""

import skinsource as ss
from skinsource.design.design import Design, track
from skinsource.design.waveforms.tones import Tone
from tests.gui.shared_window import rest

TONE = track(7, Tone(frequency_hz=100.0, duration_s=0.3), amplitude=10.0)
COIL = ss.ActuatorAt(
    actuator=ss.actuators.profile("example-voice-coil").title,
    model=ss.actuators.load("example-voice-coil"),
)
INVERSE, POLE_PAIR, NO_EQUALISER = "RegularisedInverse", "PolePairReplacement", "NoneType"
#: Chosen, and not predicted through.
CHOSEN = ss.Actuation(actuators=(COIL,), equaliser=ss.equalising.RegularisedInverse(), on=False)


def design_of(*inputs, actuation=CHOSEN):
    return Design(limb="synthetic-1", inputs=inputs, actuation=actuation)


def brought_forward(window, qtbot):
    window.docks["output"].bring_forward()
    panel = window.panel("output")
    qtbot.waitUntil(panel.isVisible)
    settle(window)
    return panel


def settle(window):
    window.catch_up()
    rest(window)


def figures(panel):
    return {figure.label: figure for figure in panel.figures.table.figures}


def number(panel, label):
    return float(figures(panel)[label].value.split()[0])


def choose(panel, name, value, gesture=None):
    panel.choices.cell(name).edited.emit(name, value, gesture)
    settle(panel.window())
