"""What is seen without scrolling in a window for a screen of 1366 x 768."""

import pytest
from PySide6.QtWidgets import QApplication, QScrollArea

from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Tap
from skinsource.design.waveforms.tones import Tone

TONE = Tone(frequency_hz=100.0, duration_s=0.3)


@pytest.fixture
def window(open_window):
    inputs = (
        track(7, TONE, amplitude=400.0),
        track(3, Tap(), colour=1),
        track(2, TONE, colour=2),
    )
    return open_window(Design(limb="synthetic-1", inputs=inputs), View(selected_inputs=(1,)))


def bring(window, name):
    window.docks[name].bring_forward()
    QApplication.processEvents()
    window.catch_up()
    QApplication.processEvents()
    return window.panel(name)


def in_view(panel, widget):
    """Whether a widget lies within what its panel shows without scrolling."""
    area = panel.findChild(QScrollArea)
    place = widget.mapTo(area.viewport(), widget.rect().bottomLeft())
    return widget.isVisible() and 0 <= place.y() < area.viewport().height()


def test_what_passes_a_limit_of_the_actuator_is_seen_without_scrolling(window):
    panel = bring(window, "actuator")
    text = panel.figures.limits.text()
    assert text.startswith("Beyond its limit: ")
    passed = [figure.label.lower() for figure in panel.figures.table.figures if figure.exceeded]
    assert passed
    assert text.endswith(", ".join(passed))
    assert in_view(panel, panel.figures.limits)
    first_rows = panel.figures.table._rows[:5]
    assert all(in_view(panel, label) for row in first_rows for label in row[:2])
