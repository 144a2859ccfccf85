"""Designs for limbs that are not here, or have other places: they open, and say what is missing."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.design.design import Design, track
from skinsource.design.design_file import open_design, save_design
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.state.compared import SILENT

STRANGE = Design(limb="foot-1", inputs=(track(location=25, waveform=Tone(frequency_hz=2000.0)),))


@pytest.fixture
def opened(window, tmp_path, qtbot):
    def open_(design, view=None):
        path = tmp_path / "strange.skinsource"
        save_design(path, design, view)
        window.files.open(path)
        qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)
        return path

    return open_


def message(window):
    return window.panel("skin").map.content.message


def test_a_design_for_a_limb_that_is_not_here_opens_and_is_kept(window, opened, qtbot):
    path = opened(STRANGE)
    assert window.document.design == STRANGE
    qtbot.waitUntil(lambda: "limb 'foot-1' is not available here" in message(window))
    assert window.panel("skin").map.content.coloured_values is None
    limb = window.findChild(ChoiceField, "limb")
    assert limb.shown_text == "foot-1 (not available)"
    assert "(read-only)" in window.windowTitle()
    window.document.edit("Mute", STRANGE.with_input(0, muted=True))
    assert window.document.design == STRANGE
    assert "read-only" in window.notice.text
    assert "'foot-1' of this design is not here" in window.notice.text
    assert window.files.save()
    assert open_design(path).design == STRANGE


def test_another_limb_can_be_chosen_instead(window, opened, qtbot):
    opened(replace(STRANGE, inputs=(track(location=7),)))
    window.findChild(ChoiceField, "limb").choose("synthetic-2")
    qtbot.waitUntil(lambda: message(window) == "" and not window.engine.busy, timeout=30_000)
    assert window.document.design.limb == "synthetic-2"
    assert np.isfinite(window.panel("skin").map.content.values).all()


def test_outputs_that_the_limb_does_not_have_are_not_selected_on_it(window, opened, qtbot):
    opened(Design(limb="synthetic-1", inputs=(track(location=7),)), View(outputs=(29, 80)))
    qtbot.waitUntil(lambda: window.document.view.outputs == (29,), timeout=30_000)
    qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)
    assert message(window) == ""


def test_what_the_limb_does_not_have_is_said_in_one_sentence(window, opened, qtbot):
    design, outputs = Design(limb="synthetic-1", inputs=(track(location=25),)), (29,)
    text = "places 1 to 20, and there is an input at place 25"
    opened(design, View(outputs=outputs))
    qtbot.waitUntil(lambda: text in window.notice.text, timeout=30_000)
    assert message(window) == SILENT
    assert window.document.design == design
    assert window.document.view.outputs == outputs
    for panel in window.panels:
        assert not panel.grab().isNull()


GONE = Design(limb="lab-9", inputs=(track(6),))


def rested(window, qtbot):
    qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)
    window.catch_up()


@pytest.fixture
def gone(user_data, window, qtbot):
    """A window that showed a limb, and now a design of one that is missing."""
    rested(window, qtbot)
    assert window.panel("skin").map.content.limb_map is not None
    window.document.start_over(GONE, View(outputs=(3,)), None)
    rested(window, qtbot)
    return window
