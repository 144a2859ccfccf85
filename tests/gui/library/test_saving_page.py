"""What is kept in the library, and the page that asks for its name."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDialogButtonBox, QMessageBox

from skinsource.design.clips import Clip, Fragment, Lane
from skinsource.design.design import Design, track
from skinsource.design.presets import presets
from skinsource.design.presets.presets import Preset
from skinsource.design.presets.shipped import SHIPPED
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Tap
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.pages.library import fragments_to_save
from skinsource_gui.panels.library.list import OWN
from tests.gui.library.bench import KEY, go_to, labels, names

SEVERAL = Design(
    limb="synthetic-1",
    inputs=(
        replace(track(7, Tone(80.0)), clips=(Clip(onset_s=0.1, label="Hum"), Clip(onset_s=0.5))),
        track(2, Tap(), onset_s=0.2, muted=True),
    ),
)


def test_what_can_be_kept_is_what_is_selected_the_track_and_all():
    view = View(selected_inputs=(1,), selected_clips=(1,))
    fragments = fragments_to_save(SEVERAL, view)
    assert [fragment.text for fragment in fragments] == [
        "Selected: 1 clip",
        "On the selected track: 2 clips",
        "The whole design: 3 clips on 2 tracks",
    ]
    assert [fragment.name for fragment in fragments] == ["Hum"] * 3
    assert [len(fragment.fragment.lanes) for fragment in fragments] == [1, 1, 2]
    assert fragments[-1].fragment.lanes[1].clips[0].muted
    assert len(fragments_to_save(Design(limb="synthetic-1", inputs=(track(7),)), View())) == 1
    assert fragments_to_save(Design(limb="synthetic-1"), View()) == ()


def test_a_clip_is_kept_under_a_name_and_found_again(window, panel, qtbot):
    page = window.library.ask_and_save()
    button = page.buttons.button(QDialogButtonBox.StandardButton.Save)
    page.name.setText("  ")
    assert not button.isEnabled()
    page.name.setText("  Good   tone ")
    page.tags.setText("mine, low, mine")
    page.description.setText("For the start.")
    button.click()
    qtbot.waitUntil(lambda: "Good tone" in names(panel))
    (entry,) = presets.read_preset_folder(presets.users_folder()).entries
    assert entry.preset.tags == ("mine", "low")
    assert entry.preset.description == "For the start."
    (clip,) = entry.preset.fragment.lanes[0].clips
    assert clip.waveform == window.document.design.clips[0].waveform
    assert labels(window) == []


def test_what_cannot_be_kept_says_why_and_the_page_stays(window, user_data):
    (user_data / "presets").write_text("in the way")
    page = window.library.ask_and_save()
    page.buttons.button(QDialogButtonBox.StandardButton.Save).click()
    assert page.isVisible()
    assert "cannot be written" in page.message.text()
    page.tags.setText("x" * 50)
    page.buttons.button(QDialogButtonBox.StandardButton.Save).click()
    assert "tags" in page.message.text()
    page.reject()


def test_there_is_nothing_to_keep_in_an_empty_design(window):
    window.do("clear_inputs")
    assert not window.actions_by_name["save_to_library"].isEnabled()


MINE = Preset(
    name="My tap",
    tags=("mine", "quick"),
    description="A <b>tap</b>.",
    fragment=Fragment(lanes=(Lane(location=3, clips=(Clip(waveform=Tap()),)),)),
)


def save(preset=MINE):
    return presets.save_preset(presets.users_folder(), preset)


def test_own_presets_are_there_as_soon_as_their_files_are(window, panel, qtbot):
    path = save()
    qtbot.waitUntil(lambda: "My tap" in names(panel))
    assert names(panel)[0] == "My tap"
    assert panel.model.index(0).data(OWN)
    path.write_text(presets.preset_text(replace(MINE, name="My other tap")))
    qtbot.waitUntil(lambda: names(panel)[0] == "My other tap")
    path.unlink()
    qtbot.waitUntil(lambda: len(names(panel)) == len(SHIPPED))


def test_one_bad_file_is_named_and_left_out_until_it_is_mended(window, panel, qtbot):
    save()
    bad = presets.users_folder() / "bad.skinpreset"
    bad.write_text("{")
    qtbot.waitUntil(panel.faults.isVisible)
    assert "bad.skinpreset" in panel.faults.text()
    assert "My tap" in names(panel)
    bad.unlink()
    qtbot.waitUntil(panel.faults.isHidden)


def test_what_changed_while_it_was_hidden_is_there_when_it_is_shown(window, panel, qtbot):
    window.docks["library"].hide()
    save()
    window.docks["library"].bring_forward()
    qtbot.waitUntil(lambda: "My tap" in names(panel))


def test_own_presets_are_renamed_in_place_and_shipped_ones_are_not(window, panel, qtbot):
    save()
    panel.folders.read()
    index = panel.model.index(0)
    assert index.flags() & Qt.ItemFlag.ItemIsEditable
    panel.model.setData(index, "Ready", Qt.ItemDataRole.EditRole)
    assert names(panel)[0] == "Ready"
    assert panel.rows.currentIndex().data() == "Ready"
    assert [path.name for path in presets.users_folder().iterdir()] == ["ready.skinpreset"]
    go_to(panel, "Tap")
    assert not panel.rows.currentIndex().flags() & Qt.ItemFlag.ItemIsEditable
    assert not panel.buttons.rename.isEnabled()
    assert not panel.buttons.delete.isEnabled()


def test_a_name_that_is_none_is_refused_in_a_sentence(window, panel, qtbot):
    save()
    panel.folders.read()
    with qtbot.waitSignal(panel.failed) as failure:
        panel.model.setData(panel.model.index(0), " ", Qt.ItemDataRole.EditRole)
    assert "name" in failure.args[0]
    assert names(panel)[0] == "My tap"


@pytest.mark.parametrize("yes", [True, False])
def test_own_presets_are_deleted_after_a_question(window, panel, monkeypatch, yes):
    answer = QMessageBox.StandardButton.Yes if yes else QMessageBox.StandardButton.No
    monkeypatch.setattr(QMessageBox, "question", lambda *_: answer)
    path = save()
    panel.folders.read()
    go_to(panel, "My tap")
    panel.rows.setFocus()
    QTest.keyClick(panel.rows, KEY.Key_Delete)
    assert path.exists() is not yes
    assert ("My tap" in names(panel)) is not yes


def test_delete_leaves_shipped_ones_alone(window, panel, monkeypatch):
    monkeypatch.setattr(QMessageBox, "question", lambda *_: pytest.fail("asked"))
    go_to(panel, "Tap")
    panel.rows.setFocus()
    QTest.keyClick(panel.rows, KEY.Key_Delete)
    assert "Tap" in names(panel)
