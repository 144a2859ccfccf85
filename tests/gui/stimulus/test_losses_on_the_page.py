"""A rate that does not hold a design: the page says so and writes only what is accepted."""

import json

import pytest
from PySide6.QtWidgets import QCheckBox

import skinsource as ss
from skinsource.design.view import View
from tests.gui.stimulus.conftest import opened
from tests.gui.stimulus.stimulus_bench import choose, export, label


@pytest.fixture
def desk(make_desk):
    tone = ss.waveforms.Tone(frequency_hz=500.0)
    return make_desk(ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone),)), View())


@pytest.fixture
def low(desk, qtbot):
    desk.exports.show("stimulus")
    page = opened(desk.exports, qtbot)
    page.form.field("other_rate").set_value(1000)
    choose(page, qtbot, "rate", "other")
    yield page
    desk.exports.end()


def test_a_lossy_rate_keeps_the_button_off_until_it_is_ticked(low, desk, qtbot, save_as):
    assert not low.ready
    assert "channel 1 (Digit II, pad) loses 5.8 dB of its energy" in label(low, "loses")
    assert label(low, "problem") == (
        "More than 1 dB is lost: choose 1300 Hz, the rate of the design, or lower the frequencies."
    )
    tick = low.findChild(QCheckBox, "stimulus_confirm")
    assert tick.isVisible()
    tick.click()
    assert low.ready
    path = save_as("lossy.wav")
    export(desk, low, qtbot)
    assert "loses 5.8 dB" in json.loads((path.parent / "lossy.wav.json").read_text())["loses"]
