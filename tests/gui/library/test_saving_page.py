"""What is kept in the library, and the page that asks for its name."""

from dataclasses import replace

from PySide6.QtWidgets import QDialogButtonBox

from skinsource.design.clips import Clip
from skinsource.design.design import Design, track
from skinsource.design.presets import presets
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Tap
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.pages.library import fragments_to_save
from tests.gui.library.bench import labels, names

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
    assert "cannot be written" in page.problem.text()
    page.tags.setText("x" * 50)
    page.buttons.button(QDialogButtonBox.StandardButton.Save).click()
    assert "tags" in page.problem.text()
    page.reject()


def test_there_is_nothing_to_keep_in_an_empty_design(window):
    window.do("clear_inputs")
    assert not window.actions_by_name["save_to_library"].isEnabled()
