"""File > Export…, Stimulus: seen first, then written, and remembered."""

import json
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication, QDialogButtonBox, QFileDialog, QLabel, QPushButton

import skinsource as ss
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.rigs import Rig, RigChannel, save_rig
from skinsource.design.design import View
from skinsource.export.formats import FORMATS
from skinsource.export.stimulus_export.preparing import size_text
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.pages.stimulus.page import joined
from tests.gui.stimulus.conftest import opened
from tests.gui.stimulus.stimulus_bench import WAIT_MS, choose, export, label


def test_it_shows_the_channels_as_they_will_be(page, design):
    channels = page.channels.channels
    assert [(each.channel.place, each.channel.inputs) for each in channels] == [
        (7, (1, 3)),
        (12, (2,)),
    ]
    assert max(channel.peak for channel in channels) == pytest.approx(1.0)
    assert channels[1].extremes.max() == pytest.approx(1.0)
    assert channels[0].extremes.shape == (2, 600)
    assert "1  Place 7, Digit II, pad; peak" in page.channels.accessibleDescription()
    text = label(page, "summary")
    n_times = ss.stimulus_of(design, 48_000).n_times
    assert text.startswith(f"2 channels, 48 kHz, {1e3 * n_times / 48_000:.4g} ms, about ")
    assert size_text(page.prepared.n_bytes) in text
    assert text.endswith("m/s², not equalised (raw accelerations).")
    assert "Uncalibrated" in label(page, "loses")


def test_only_rows_that_mean_something_are_shown(page, qtbot):
    form = page.form
    assert not form.field("channels").isVisible()
    form.field("advanced").click()
    assert not form.field("dither").isVisible()
    assert not form.field("from").isVisible()
    choose(page, qtbot, "samples", "pcm16")
    assert form.field("dither").isVisible()
    choose(page, qtbot, "time", "part")
    assert form.field("from").isVisible()
    choose(page, qtbot, "rate", "other")
    assert form.field("other_rate").isVisible()
    assert form.field("map").isVisible()
    choose(page, qtbot, "channels", "files")
    assert not form.field("map").isVisible()
    choose(page, qtbot, "format", "csv")
    assert form.field("rate").value == "1300"
    assert form.field("layout").isVisible()


def test_options_reach_what_is_shown(page, qtbot):
    def shown():
        return [overview.channel.title for overview in page.channels.channels]

    choose(page, qtbot, "plays", "tracks")
    assert shown() == ["Digit II, base"]
    choose(page, qtbot, "plays", "all")
    choose(page, qtbot, "channels", "input")
    assert shown() == ["Digit II, pad", "Digit II, base", "Digit II, pad"]
    page.form.field("sync").click()
    qtbot.waitUntil(lambda: not page.busy, timeout=WAIT_MS)
    assert shown()[-1] == "Sync"
    page.form.field("sync").click()
    choose(page, qtbot, "time", "loop")
    assert page.prepared.files[0].stimulus.duration_s == pytest.approx(0.1)
    choose(page, qtbot, "channels", "files")
    assert len(page.prepared.files) == 3
    assert "3 files" in label(page, "summary")


def test_tracks_that_are_silent_are_said_to_be_left_out(make_desk, design, qtbot):
    design = design.with_input(0, muted=True).with_input(1, solo=True)
    design = design.with_clip(design.inputs[1].clips[0].id, muted=True)
    clips = tuple(clip.id for clip in design.clips)
    page = opened(make_desk(design, View(selected_inputs=design.ids, selected_clips=clips)), qtbot)
    silent = "Left out: track at 7 (muted), 1 muted clip at 12, track at 7 (not solo)."
    for plays in ("all", "tracks", "clips"):
        choose(page, qtbot, "plays", plays)
        assert label(page, "loses").startswith(silent)


def test_what_cannot_be_says_why_and_cannot_be_exported(page, qtbot):
    page.form.field("map").setText("1, x")
    assert "expected whole numbers such as" in label(page, "problem")
    assert not page.ready
    page.form.field("map").setText("1")
    qtbot.waitUntil(
        lambda: "each channel from 1 to 2 once" in label(page, "problem"), timeout=WAIT_MS
    )
    assert not page.ready
    page.form.field("map").setText("2, 0, 1")
    qtbot.waitUntil(lambda: page.ready, timeout=WAIT_MS)
    assert [overview.channel.place for overview in page.channels.channels] == [12, None, 7]
    assert label(page, "problem") == ""


def test_a_rig_says_what_is_wired_and_an_equaliser_makes_volts(
    page, desk, qtbot, save_as, monkeypatch, tmp_path
):
    flat = MeasuredResponse(((1.0, 50.0, 0.0), (2000.0, 50.0, 0.0)))
    channels = tuple(
        RigChannel(place=place, output=place, full_scale_v=1.0, measured=flat) for place in (7, 12)
    )
    file = tmp_path / "bench.skinrig"
    save_rig(file, Rig(title="Bench 3", channels=channels))
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(file), ""))
    form = page.form
    assert not form.field("equaliser").isVisible()
    choose(page, qtbot, "plays", "tracks")
    choose(page, qtbot, "rig", "file")
    assert form.field("rig").currentText() == "Bench 3"
    assert "Calibrated" in label(page, "loses")
    choose(page, qtbot, "equaliser", "RegularisedInverse")
    assert desk.document.design.rig.title == "Bench 3"
    assert not form.field("scale").isVisible()
    # 1 m/s² needs a fiftieth of a volt.
    assert page.channels.channels[0].peak == pytest.approx(0.02, rel=0.05)
    path = save_as("volts.wav")
    export(desk, page, qtbot)
    metadata = json.loads((path.parent / "volts.wav.json").read_text())
    assert metadata["rig"] == "Bench 3"
    assert metadata["equaliser"]["phase"] == "linear"


def test_every_format_of_the_table_is_offered_and_shown(page, qtbot):
    page.form.field("advanced").click()
    page.window().resize(1080, 520)
    hint = page.findChild(QLabel, "stimulus_format_hint")
    for file_format in FORMATS:
        choose(page, qtbot, "format", file_format.name)
        QApplication.processEvents()
        assert hint.height() >= hint.heightForWidth(hint.width()), file_format.name
        assert page.ready, file_format.name
        for name in file_format.choices:
            assert page.form.field(name).isVisible()


def test_neighbours_in_the_picture_of_a_channel_meet():
    samples = np.array([0.0, 0.8, -0.6, -0.6, 0.1])
    low, high = joined(np.stack((samples, samples)))
    assert (low[1:] <= high[:-1]).all()
    assert (high[1:] >= low[:-1]).all()
    # Each begins where the one before is, and holds no more than both.
    assert low.tolist() == [0.0, 0.0, -0.6, -0.6, -0.6]
    assert high.tolist() == [0.0, 0.8, 0.8, -0.6, 0.1]


def test_the_methods_text_of_what_is_shown_is_copied(page, qtbot, qapp):
    button = page.findChild(QPushButton, "stimulus_copy_methods")
    choose(page, qtbot, "rate", "44100")
    button.click()
    qtbot.waitUntil(lambda: button.text() == "Methods text copied", timeout=WAIT_MS)
    assert "WAV (44.1 kHz, full scale = 1 m/s²)" in qapp.clipboard().text()
    choose(page, qtbot, "rate", "8000")
    assert button.text() == "Copy methods text"


def test_the_wiring_page_has_the_channels_of_the_stimulus(page, qtbot):
    choose(page, qtbot, "plays", "tracks")
    page.form.field("sync").setChecked(True)
    qtbot.waitUntil(lambda: not page.busy, timeout=WAIT_MS)
    dialog = page.window()
    dialog.show_export("wiring")
    part = dialog.part
    wired = part.writer(None).keywords
    assert wired["options"].inputs == (2,)
    assert wired["options"].sync
    qtbot.waitUntil(lambda: not part.image.image.isNull(), timeout=WAIT_MS)
    assert part.suggestion()[:2] == ("wiring.pdf", "PDF (*.pdf);;PNG (*.png);;SVG (*.svg)")
    dialog.findChild(ChoiceField, "export_page_kind").set_value(".svg")
    assert part.suggestion()[0] == "wiring.svg"


def test_what_the_actuators_cannot_follow_names_its_place_and_is_mended_here(desk, qtbot):
    desk.document.look(replace(desk.document.view, selected_inputs=desk.document.design.ids))
    page = opened(desk, qtbot)
    choose(page, qtbot, "rate", "8000")
    choose(page, qtbot, "plays", "tracks")
    page.form.field("actuator").choose("kastor-2023-air")
    mend = page.findChild(QPushButton, "stimulus_mend")
    qtbot.waitUntil(mend.isVisible, timeout=WAIT_MS)
    assert label(page, "problem").startswith("Place 7: the drive leaves a velocity")
    # Another error has a remedy of its own, although this edit would still be possible.
    choose(page, qtbot, "format", "drv2605l")
    qtbot.waitUntil(mend.isVisible, timeout=WAIT_MS)
    assert mend.text() == "Remove the equaliser"
    page.form.field("format").choose("wav")
    choose(page, qtbot, "rate", "8000")
    qtbot.waitUntil(mend.isVisible, timeout=WAIT_MS)
    before = desk.document.design
    mend.click()
    qtbot.waitUntil(lambda: page.prepared is not None, timeout=WAIT_MS)
    # All choices stay, or other channels would be written.
    assert [page.form.field(name).value for name in ("rate", "plays")] == ["8000", "tracks"]
    assert [type(track.clips[0].waveform).__name__ for track in desk.document.design.inputs] == [
        "Gabor",
        "Tone",
        "CentredTap",
    ]
    assert desk.document.design.actuation == before.actuation is not None
    desk.document.undo_stack.undo()
    assert desk.document.design == before


def test_a_chip_that_follows_no_equaliser_is_exported_for_after_one_click(make_desk, qtbot):
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7),))
    desk = make_desk(design, View())
    page = opened(desk, qtbot)
    choose(page, qtbot, "format", "drv2605l")
    page.form.field("actuator").choose("example-resonant")
    mend = page.findChild(QPushButton, "stimulus_mend")
    qtbot.waitUntil(mend.isVisible, timeout=WAIT_MS)
    mend.click()
    qtbot.waitUntil(lambda: page.prepared is not None, timeout=WAIT_MS)
    assert desk.document.design.actuation.equaliser is None
    assert desk.document.undo_stack.undoText() == "Remove the equaliser"


def test_a_full_scale_that_is_not_that_of_the_chip_is_a_warning_and_mended_here(make_desk, qtbot):
    piezo = ss.ActuatorAt(actuator="x", model=ss.actuators.load("example-piezo"))
    through = ss.Actuation(actuators=(piezo,), equaliser=ss.equalising.RegularisedInverse())
    track = ss.track(7, ss.waveforms.Gabor(200.0), amplitude=100.0)
    design = ss.Design(limb="synthetic-1", inputs=(track,), actuation=through)
    page = opened(make_desk(design, View()), qtbot)
    choose(page, qtbot, "format", "bos1901")
    mend = page.findChild(QPushButton, "stimulus_mend")
    notes = page.findChild(QLabel, "stimulus_loses")
    assert notes.property("tone") == "warning"
    assert mend.text() == "Full scale of 95 V"
    mend.click()
    qtbot.waitUntil(lambda: not page.busy, timeout=WAIT_MS)
    assert page.prepared.files[0].full_scale == page.form.field("full_scale").value_si == 95.0
    assert not mend.isVisible()
    assert notes.property("tone") == "dim"
    choose(page, qtbot, "format", "wav")
    assert page.form.field("scale").value == "largest"


def test_what_is_chosen_here_is_an_edit_of_the_design(desk, page, qtbot):
    document, form = desk.document, page.form
    before, said = document.design, []
    document.message.connect(said.append)
    without_tap = replace(before, inputs=before.inputs[:2])
    document.edit("Remove the tap", without_tap)
    page = opened(desk, qtbot)
    choose(page, qtbot, "plays", "tracks")
    choose(page, qtbot, "actuator", "kastor-2023-air")
    form, actuation = page.form, document.design.actuation
    assert actuation.title == "Fingertip voice coil, in air"
    # By itself, as in the panel Output.
    assert actuation.equaliser == ss.equalising.RegularisedInverse()
    assert not actuation.on
    assert form.field("equaliser").value == "RegularisedInverse"
    assert form.field("plays").value == "tracks"
    assert "equalised for Fingertip voice coil" in label(page, "summary")
    for boost_db in (1.0, 2.0, 2.0):
        form.field("boost_db").edited.emit(boost_db, 1)
    qtbot.waitUntil(lambda: not page.busy, timeout=WAIT_MS)
    assert "limited to 2 dB" in label(page, "loses")
    assert ["Undo" in text for text in said] == [True] * 3
    # Closed without an export, and opened again.
    box = page.window().findChild(QDialogButtonBox)
    box.button(QDialogButtonBox.StandardButton.Close).click()
    page = opened(desk, qtbot, "stimulus_set")
    assert page.form.field("boost_db").value_si == 2.0
    desk.exports.page.show_export("stimulus")
    desk.exports.page.show_export("stimulus_set")
    choose(page, qtbot, "equaliser", "NoneType")
    desk.exports.page.show_export("stimulus")
    assert desk.exports.page.part.form.field("equaliser").value == "NoneType"
    assert document.design.actuation.equaliser is None
    for _ in range(3):
        document.undo_stack.undo()
    assert document.design == without_tap


def test_amplitudes_of_a_set_are_in_the_unit_that_the_equaliser_leaves(make_desk, design, qtbot):
    coil = ss.ActuatorAt(actuator="x", model=ss.actuators.load("kastor-2023-air"))
    through = ss.Actuation(actuators=(coil,), equaliser=ss.equalising.RegularisedInverse())
    desk = make_desk(replace(design, inputs=design.inputs[:2], actuation=through), View())
    part = opened(desk, qtbot, "stimulus_set")
    variable = part.variables[1]
    variable.choose("amplitude")
    assert variable.currentText() == "Amplitude (m/s²), all tracks"
    part.form.field("equaliser").choose("NoneType")
    assert variable.currentText() == "Amplitude (V), all tracks"
    part.form.field("equaliser").choose("RegularisedInverse")
    assert desk.document.design.actuated == through
