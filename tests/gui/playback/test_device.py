"""Devices: which are used, what they are given; a long design takes a while before it plays."""

import threading
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtWidgets import QLabel, QToolButton

from skinsource.lab.playing import session
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.triggers import code_in

WAIT = {"timeout": 20_000}


def text_of(panel, name):
    return panel.findChild(QLabel, name).text()


def test_it_looks_for_devices_when_it_is_first_seen(sound, player, panel, qtbot):
    offered = [panel.fields.device.itemText(k) for k in range(panel.fields.device.count())]
    assert offered == [
        "System default", "Two (Made up, 2 outputs)", "Eight (Made up, 8 outputs)",
    ]  # fmt: skip
    qtbot.waitUntil(lambda: player.settings.rates_hz == (44_100, 48_000), **WAIT)
    rate = panel.fields.cells["sample_rate_hz"].field
    rates = [rate.itemText(k) for k in range(rate.count())]
    assert rates == ["44 100 Hz", "48 000 Hz"]


def test_device_rate_delay_and_stand_in_are_chosen_there(sound, player, panel, qtbot):
    panel.fields.device.choose("Eight\nMade up")
    cells = panel.fields.cells
    rate = cells["sample_rate_hz"].field
    # A device is asked for its rates in another thread.
    qtbot.waitUntil(lambda: rate.findData("44100") >= 0, timeout=20_000)
    cells["latency_s"].field.edited.emit(0.05, None)
    cells["stand_in"].field.click()
    cells["shift_hz"].field.edited.emit(250.0, None)
    assert player.settings.output == Output(
        device="Eight", host_api="Made up", latency_s=0.05, stand_in=True, shift_hz=250.0
    )
    assert "All frequencies sound 250 Hz higher" in text_of(panel, "output_words")
    rate.choose("44100")
    assert player.settings.output.sample_rate_hz == 44_100


def test_a_trigger_is_given_an_output_and_is_played_there(sound, player, panel, arm, studio, qtbot):
    cells = panel.fields.cells
    assert not cells["trigger_code"].isEnabled()
    panel.fields.device.choose("Eight\nMade up")
    cells["trigger_output"].field.edited.emit(3.0, None)
    assert cells["trigger_code"].isEnabled()
    cells["trigger_code"].field.edited.emit(37.0, None)
    assert player.settings.output.trigger_output == 3
    arm()
    studio.do("play_on_actuators")
    qtbot.waitUntil(lambda: player.now is not None, **WAIT)
    qtbot.waitUntil(lambda: not player.playing, **WAIT)
    assert code_in(sound.streams[-1].samples[2], 48_000)[0] == 37


def test_a_trigger_on_an_output_that_plays_a_place_is_said_until_it_has_another(
    sound, player, panel, qtbot
):
    field = panel.fields.cells["trigger_output"].field
    panel.fields.device.choose("Eight\nMade up")
    field.edited.emit(2.0, None)
    assert "Output 2 drives place 12, so it cannot be the trigger." in text_of(
        panel, "output_problem"
    )
    player.arm(True)
    qtbot.waitUntil(lambda: "Output 2 plays place 12" in text_of(panel, "output_problem"), **WAIT)
    field.edited.emit(3.0, None)
    assert not text_of(panel, "output_problem")


def test_each_place_has_an_output_and_two_of_them_change_places(sound, player, panel):
    first, second = panel.rows.rows
    assert [round(row.output.value_si) for row in panel.rows.rows] == [1, 2]
    first.output.edited.emit(2.0, None)
    assert player.settings.output.outputs == ((7, 2), (12, 1))
    assert [round(row.output.value_si) for row in panel.rows.rows] == [2, 1]
    second.output.edited.emit(5.0, None)
    assert player.settings.output.outputs == ((7, 2), (12, 5))


def test_a_tone_is_heard_on_the_output_of_its_place_alone(sound, player, panel, qtbot, arm):
    button = panel.findChild(QToolButton, "tone_of_12")
    assert not button.isEnabled()
    assert "Arm" in button.toolTip()
    arm()
    assert button.accessibleName() == "Test tone on output 2, place 12"
    assert "on output 2 alone" in button.toolTip()
    button.click()
    qtbot.waitUntil(lambda: bool(sound.streams), **WAIT)
    qtbot.waitUntil(lambda: not player.playing, **WAIT)
    samples = sound.streams[0].samples
    assert not samples[0].any()
    assert np.abs(samples[1]).max() == pytest.approx(0.1, rel=1e-3)


def test_a_device_that_is_connected_later_is_found(no_sound, player, panel, qtbot):
    assert text_of(panel, "output_problem")
    no_sound.outputs = {"New": 4}
    no_sound.default.device["output"] = 0
    # In sight also while the rest of the panel is folded.
    assert not panel.fields.details.isAncestorOf(panel.fields.rescan)
    assert panel.fields.rescan.isVisible()
    panel.fields.rescan.click()
    qtbot.waitUntil(lambda: not text_of(panel, "output_problem"), **WAIT)


def test_armed_the_peak_is_shown_and_the_buttons_play_and_stop(sound, player, panel, qtbot):
    assert not panel.play.isEnabled()
    panel.arm.click()
    qtbot.waitUntil(panel.play.isEnabled, **WAIT)
    # 0.9 of full scale, at the first gain.
    assert text_of(panel, "output_peak") == "Armed: peak \u221220.9 dBFS, on Two."
    panel.fields.gain.edited.emit(-30.0, None)
    assert "\u221230.9 dBFS" in text_of(panel, "output_peak")
    player.toggle_loop()
    panel.play.click()
    qtbot.waitUntil(lambda: player.now is not None, **WAIT)
    assert panel.stop.isEnabled()
    assert text_of(panel, "output_peak").startswith("Playing")
    stream = player.now.stream
    panel.stop.click()
    qtbot.waitUntil(lambda: not player.playing, **WAIT)
    assert stream.queue.ending.reason == "stopped"
    panel.arm.click()
    assert player.peak is None
    assert not panel.play.isEnabled()


def test_levels_delay_and_underruns_are_shown(sound, studio, player, panel, qtbot, listen):
    listen(loops=True)
    sound.streams[-1].underflows = 2
    design = studio.document.design
    studio.document.edit("Louder", design.with_input(1, amplitude=0.6))
    qtbot.waitUntil(lambda: "from an edit to the output" in text_of(panel, "output_words"), **WAIT)
    qtbot.waitUntil(lambda: "ran out of samples 2 times" in text_of(panel, "output_words"), **WAIT)
    qtbot.waitUntil(lambda: text_of(panel, "level_of_7") == "\u221220.9 dBFS", **WAIT)
    meter = panel.rows.rows[0].meter
    qtbot.waitUntil(lambda: -30 < meter.value() < -22, **WAIT)


def test_rows_follow_the_places_of_the_design(sound, studio, panel):
    design = studio.document.design
    studio.document.edit("Remove", design.without_input(0))
    assert [row.place for row in panel.rows.rows] == [12]
    studio.document.edit("Remove", replace(design, inputs=()))
    assert panel.rows.rows == []
    assert "No place is in use" in text_of(panel, "output_words")


@pytest.fixture
def armed(sound, arm):
    """Actuators that are armed before mixes take long."""
    arm()


@pytest.fixture
def made(monkeypatch):
    """Lets a mix be made once it is set, at the latest at the end of the test."""
    ready, mix = threading.Event(), session.Mixer.mix

    def slowly(self, *given, **more):
        assert ready.wait(20)
        return mix(self, *given, **more)

    monkeypatch.setattr(session.Mixer, "mix", slowly)
    yield ready
    ready.set()


def test_sound_is_said_to_be_prepared_until_it_plays(sound, studio, player, qtbot, armed, made):
    button = studio.playback.button
    studio.do("play_on_actuators")
    assert button.text().endswith("Preparing…")
    assert studio.playback.bar.play.accessibleName() == "Stop"
    made.set()
    qtbot.waitUntil(lambda: player.now is not None, **WAIT)
    assert button.text().endswith("Actuators playing")
    player.stop_at_once()
    qtbot.waitUntil(lambda: not player.playing, **WAIT)
    assert button.text().endswith("Actuators off")


def test_what_is_played_after_something_was_cancelled_is_what_is_heard(
    sound, studio, player, qtbot, armed, made
):
    for _ in range(3):
        studio.do("play_on_actuators")
    assert player.preparing
    made.set()
    qtbot.waitUntil(lambda: player.now is not None, **WAIT)
    assert len(sound.streams) == 1
    assert not player.preparing
    player.stop_at_once()
    qtbot.waitUntil(lambda: not player.playing, **WAIT)
