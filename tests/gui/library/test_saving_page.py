"""What is kept in the library, and the page that asks for its name."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDialogButtonBox, QMessageBox

from skinsource.design.clips import Clip, Fragment, Lane
from skinsource.design.design import Design, track
from skinsource.design.presets import presets
from skinsource.design.presets.presets import Preset, read_preset_folder, shipped_folder
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Tap
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.pages.library import fragments_to_save
from skinsource_gui.panels.library.list import OWN

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


def test_a_clip_is_kept_under_a_name(window):
    page = window.library.ask_and_save()
    button = page.buttons.button(QDialogButtonBox.StandardButton.Save)
    page.name.setText("  ")
    assert not button.isEnabled()
    page.name.setText("  Good   tone ")
    page.tags.setText("mine, low, mine")
    page.description.setText("For the start.")
    button.click()
    (entry,) = presets.read_preset_folder(presets.users_folder()).entries
    assert (entry.preset.name, entry.preset.tags) == ("Good tone", ("mine", "low"))
    assert entry.preset.description == "For the start."
    (clip,) = entry.preset.fragment.lanes[0].clips
    assert clip.waveform == window.document.design.clips[0].waveform
    assert window.document.undo_stack.count() == 0


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


MINE = Preset(
    name="My tap",
    tags=("mine", "quick"),
    description="A <b>tap</b>.",
    fragment=Fragment(lanes=(Lane(location=3, clips=(Clip(waveform=Tap()),)),)),
)


def test_own_presets_are_there_when_the_user_comes_back_and_bad_ones_are_named(bench):
    panel, comes_back = bench.panel, QGuiApplication.instance().focusWindowChanged.emit
    path = presets.save_preset(presets.users_folder(), MINE)
    comes_back(None)
    assert bench.names[0] == "My tap"
    assert panel.model.index(0, 0).data(OWN)
    path.write_text(presets.preset_text(replace(MINE, name="My other tap")))
    comes_back(None)
    assert bench.names[0] == "My other tap"
    bad = presets.users_folder() / "bad.skinpreset"
    bad.write_text("{")
    comes_back(None)
    assert panel.faults.isVisible()
    assert "bad.skinpreset" in panel.faults.text()
    assert bench.names[0] == "My other tap"
    # What changes while it is hidden is there when it is shown.
    panel.hide()
    bad.unlink()
    path.unlink()
    panel.show()
    assert panel.faults.isHidden()
    assert len(bench.names) == len(read_preset_folder(shipped_folder()).entries)


def test_own_presets_are_renamed_in_place_and_shipped_ones_are_not(bench, qtbot):
    panel = bench.panel
    bench.save(MINE)
    index = panel.model.index(0, 0)
    assert index.flags() & Qt.ItemFlag.ItemIsEditable
    panel.model.setData(index, "Ready", Qt.ItemDataRole.EditRole)
    assert bench.names[0] == panel.rows.currentIndex().data() == "Ready"
    assert [path.name for path in presets.users_folder().iterdir()] == ["ready.skinpreset"]
    with qtbot.waitSignal(panel.failed) as failure:
        panel.model.setData(panel.model.index(0, 0), " ", Qt.ItemDataRole.EditRole)
    assert "name" in failure.args[0]
    assert bench.names[0] == "Ready"
    bench.go_to("Tap")
    assert not panel.rows.currentIndex().flags() & Qt.ItemFlag.ItemIsEditable
    assert not panel.buttons.rename.isEnabled()
    assert not panel.buttons.delete.isEnabled()


@pytest.mark.parametrize("yes", [True, False])
def test_own_presets_are_deleted_after_a_question_and_shipped_ones_never(bench, answers, yes):
    kinds = QMessageBox.StandardButton
    answers["question"] = kinds.Yes if yes else kinds.No
    path = bench.save(MINE)
    for name in ("My tap", "Tap"):
        bench.go_to(name)
        QTest.keyClick(bench.panel.rows, Qt.Key.Key_Delete)
    assert path.exists() is not yes
    assert ("My tap" in bench.names) is not yes
    assert "Tap" in bench.names
    assert len(answers["asked"]) == 1
