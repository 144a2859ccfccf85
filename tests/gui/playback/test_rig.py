"""The rig of this machine: chosen once, kept, and said."""

from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtWidgets import QFileDialog

from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.prediction import Limits
from skinsource.actuators.rigs import Rig, RigChannel, save_rig
from skinsource.design import edits
from skinsource_gui.fields.rig_field import RigField

pytestmark = pytest.mark.usefixtures("sound")
WAIT = {"timeout": 20_000}
FLAT = MeasuredResponse(((1.0, 50.0, 0.0), (2000.0, 50.0, 0.0)))
BENCH = Rig(
    title="Bench 3",
    channels=(
        RigChannel(place=7, output=2, full_scale_v=2.0, measured=FLAT, measured_on="2026-03-04"),
        RigChannel(place=12, output=1, full_scale_v=2.0, measured=FLAT),
    ),
)


@pytest.fixture
def path(tmp_path):
    save_rig(tmp_path / "bench.skinrig", BENCH)
    return tmp_path / "bench.skinrig"


def test_a_rig_is_asked_for_where_the_last_file_was(panel, path, monkeypatch):
    began = []

    def ask(parent, title, folder, kinds):
        began.append(folder)
        return str(path), ""

    monkeypatch.setattr(QFileDialog, "getOpenFileName", ask)
    rig = panel.fields.rig
    assert RigField().folder == Path.home()
    panel.show_folder(path.parent.parent)
    for _ in range(2):
        rig.edited.emit("file", None)
    assert began == [str(path.parent.parent), str(path.parent)]


def test_a_rig_wires_the_places_and_says_how_calibrated_it_is(panel, studio, player, path):
    panel.fields.rig.rig_chosen.emit(path)
    assert studio.document.design.rig == player.settings.rig == BENCH
    assert panel.fields.rig.currentText() == "Bench 3"
    assert "Calibrated, measured on 2026-03-04." in panel.text.text()
    assert "Uncalibrated" not in panel.text.text()
    assert [(row.place, row.output.value_si) for row in panel.rows.rows] == [(7, 2.0), (12, 1.0)]
    assert not panel.rows.rows[0].output.isEnabled()
    panel.fields.rig.rig_chosen.emit(None)
    assert panel.fields.rig.currentText() == "None"
    assert panel.rows.rows[0].output.isEnabled()


def test_what_is_no_rig_is_refused_and_the_present_one_stays(panel, player, path, studio, tmp_path):
    player.settings.choose_rig(path)
    other = tmp_path / "other.skinrig"
    other.write_text("no rig")
    player.settings.choose_rig(other)
    assert "other.skinrig" in studio.notice.text
    assert player.settings.rig == BENCH


def test_a_rig_that_is_gone_does_not_play_without_its_limits(sound, studio, player, path, tmp_path):
    player.settings.preferences.rig_path = str(tmp_path / "gone.skinrig")
    player.settings._rig_was_read = False
    player.arm(True)
    assert player.peak is None
    assert "The rig of this machine cannot be read" in studio.notice.text
    assert not sound.streams


def test_a_limit_in_the_first_block_is_said_even_if_that_is_over_before_play_was_under_way(
    sound, studio, player, tmp_path, qtbot, monkeypatch, arm
):
    limited = Rig(
        channels=tuple(
            replace(channel, limits=Limits(peak_voltage_v=0.01)) for channel in BENCH.channels
        )
    )
    save_rig(tmp_path / "limited.skinrig", limited)
    player.settings.choose_rig(tmp_path / "limited.skinrig")
    make = player._session().play

    def play_to_the_end(*which, **how):
        playing = make(*which, **how)
        sound.streams[-1]._thread.join(20)
        return playing

    monkeypatch.setattr(player._session(), "play", play_to_the_end)
    arm()
    studio.do("play_on_actuators")
    qtbot.waitUntil(lambda: "Stopped" in studio.notice.text, **WAIT)
    assert not player.playing
    assert "a limit of the rig would have been passed (place" in studio.notice.text


def test_a_design_for_another_rig_is_not_played_and_one_without_uses_that_of_the_machine(
    studio, panel, player, path, arm
):
    player.settings.choose_rig(path)
    other = replace(BENCH, title="Bench 4")
    design, view = studio.document.design, studio.document.view
    studio.document.apply(edits.choose_rig(design, view, other))
    player.arm(True)
    assert player.peak is None
    assert "made for the rig 'Bench 4'" in studio.notice.text
    studio.document.undo_stack.undo()
    assert "this machine plays for Bench 3" in panel.text.text()
    arm()
    # 0.9 of 2 V.
    assert player.peak.volts == pytest.approx(1.8, abs=0.01)
