"""File > Export stimulus…: seen first, then written."""

import json

import pytest
import soundfile
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QCheckBox, QFileDialog, QLabel, QPushButton

import skinsource as ss
from skinsource.actuators import MeasuredResponse
from skinsource.rigs import Rig, RigChannel, save_rig
from skinsource.stimulus_formats import FORMATS
from skinsource.view import View
from skinsource_gui.stimulus_page.page import bytes_in_words, duration_words

#: The first one imports scipy, on a machine that may be busy.
WAIT_MS = 30_000
GABOR = ss.waveforms.Gabor(frequency_hz=200.0)


@pytest.fixture
def design():
    return ss.Design(
        limb="synthetic-1",
        inputs=(
            ss.track(7, GABOR, onset_s=0.06, amplitude=0.5),
            ss.track(12, ss.waveforms.Tone(frequency_hz=100.0), onset_s=0.1),
            ss.track(7, ss.waveforms.Tap(), onset_s=0.2, amplitude=0.25),
        ),
        loop_s=(0.05, 0.15),
    )


def selected(design):
    return View(selected_inputs=(2,), selected_clips=(design.inputs[1].clips[0].id,))


@pytest.fixture
def desk(make_desk, design):
    return make_desk(design, selected(design))


@pytest.fixture
def window(make_window, design):
    return make_window(design, selected(design))


def opened(actions, qtbot):
    """The page, once it shows what would be exported."""
    qtbot.waitExposed(actions.page)
    qtbot.waitUntil(lambda: not actions.page.busy, timeout=WAIT_MS)
    return actions.page


@pytest.fixture
def page(desk, qtbot):
    desk.stimuli.show()
    yield opened(desk.stimuli, qtbot)
    desk.stimuli.end()


@pytest.fixture
def page_in_window(window, qtbot):
    window.do("export_stimulus")
    yield opened(window.stimuli, qtbot)
    window.stimuli.end()


@pytest.fixture
def save_as(monkeypatch, tmp_path):
    """Have the next dialog answer with a name."""

    def answer_with(name):
        path = tmp_path / name
        monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), ""))
        return path

    return answer_with


def label(page, name):
    return page.findChild(QLabel, f"stimulus_{name}").text()


def choose(page, qtbot, name, option):
    page.form.field(name).choose(option)
    qtbot.waitUntil(lambda: not page.busy, timeout=WAIT_MS)


def export(window, page, qtbot):
    page.findChild(QPushButton, "stimulus_export").click()
    qtbot.waitUntil(lambda: not window.runner.busy, timeout=WAIT_MS)


def test_it_shows_the_channels_as_they_will_be(page, design):
    found = page.channels.overview
    assert [(one.place, one.inputs) for one in found.channels] == [(7, (1, 3)), (12, (2,))]
    assert max(one.peak for one in found.channels) == pytest.approx(1.0)
    assert found.channels[1].extremes.max() == pytest.approx(1.0)
    assert found.channels[0].extremes.shape == (2, 600)
    assert "1  Place 7, Digit II, pad; peak" in page.channels.accessibleDescription()
    text = label(page, "summary")
    n_times = ss.stimulus_of(design, 48_000).n_times
    assert text.startswith(f"2 channels, {1e3 * n_times / 48_000:.4g} ms at 48 000 Hz, about ")
    assert bytes_in_words(found.n_bytes) in text
    assert "Uncalibrated" in label(page, "loses")


def test_the_bytes_that_are_told_are_those_of_the_file(page, desk, qtbot, save_as):
    told = page.channels.overview.n_bytes
    path = save_as("drive.wav")
    export(desk, page, qtbot)
    assert abs(path.stat().st_size - told) < 300


def test_what_was_looked_at_is_written_with_its_sidecar(
    page_in_window, window, qtbot, save_as, design
):
    choose(page_in_window, qtbot, "samples", "pcm24")
    choose(page_in_window, qtbot, "rate", "44100")
    path = save_as("drive.wav")
    export(window, page_in_window, qtbot)
    about = soundfile.info(path)
    assert (about.samplerate, about.channels, about.subtype) == (44_100, 2, "PCM_24")
    told = json.loads((path.parent / "drive.wav.json").read_text())
    assert told["rate_hz"] == 44_100
    assert "Saved" in window.statusBar().currentMessage()
    assert window.document.design is design or window.document.design == design
    assert window.document.undo_stack.count() == 0


def test_it_can_be_done_with_keys_alone(page, desk, qtbot, save_as):
    first = page.form.field("format")
    assert QApplication.focusWidget() is first
    QTest.keyClick(first, Qt.Key.Key_Down)
    assert page.form.format.name == "flac"
    reached = set()
    for _ in range(30):
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Tab)
        reached.add(QApplication.focusWidget().objectName())
        assert QApplication.focusWidget().accessibleName() or isinstance(
            QApplication.focusWidget(), QCheckBox | QPushButton
        ), QApplication.focusWidget()
        if "stimulus_format" in reached:
            break
    names = ("rate", "plays", "channels", "map", "time", "fade_in", "lead_in", "scale", "sync")
    assert {f"stimulus_{name}" for name in names} <= reached
    qtbot.waitUntil(lambda: page.ready, timeout=WAIT_MS)
    path = save_as("drive.flac")
    QTest.keyClick(page, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: path.exists() and not desk.runner.busy, timeout=WAIT_MS)
    assert soundfile.info(path).subtype == "PCM_24"


def test_only_rows_that_mean_something_are_shown(page, qtbot):
    form = page.form
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
        return [one.title for one in page.channels.overview.channels]

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
    assert page.channels.overview.duration_s == pytest.approx(0.1)
    choose(page, qtbot, "channels", "files")
    assert page.channels.overview.n_files == 3
    assert "in 3 files" in label(page, "summary")


def test_what_would_clip_is_shown_and_must_be_confirmed(page, desk, qtbot, save_as):
    choose(page, qtbot, "scale", "own")
    field = page.form.field("full_scale")
    field.setFocus()
    QTest.keyClicks(field, "0.5")
    QTest.keyClick(field, Qt.Key.Key_Tab)
    qtbot.waitUntil(lambda: not page.busy, timeout=WAIT_MS)
    clipped = page.channels.overview.channels[1].clipped
    assert clipped > 100
    assert f"channel 2 (Digit II, base) {clipped}" in label(page, "problem")
    assert f"{clipped} samples would clip" in page.channels.accessibleDescription()
    assert not page.ready
    page.findChild(QCheckBox, "stimulus_confirm").click()
    assert page.ready
    # What was confirmed was this, and nothing else.
    choose(page, qtbot, "rate", "8000")
    assert not page.ready
    page.findChild(QCheckBox, "stimulus_confirm").click()
    path = save_as("loud.wav")
    export(desk, page, qtbot)
    assert json.loads((path.parent / "loud.wav.json").read_text())["clip_count"] > 0


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
    assert [one.place for one in page.channels.overview.channels] == [12, None, 7]
    assert label(page, "problem") == ""


def test_lossy_formats_say_what_they_lose(page, qtbot):
    choose(page, qtbot, "samples", "pcm16")
    assert "98 dB below full scale" in label(page, "loses")


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
    choose(page, qtbot, "equaliser", "linear")
    assert not form.field("scale").isVisible()
    # 1 m/s² needs a fiftieth of a volt.
    assert page.channels.overview.channels[0].peak == pytest.approx(0.02, rel=0.05)
    path = save_as("volts.wav")
    export(desk, page, qtbot)
    told = json.loads((path.parent / "volts.wav.json").read_text())
    assert told["rig"] == "Bench 3"
    assert told["equaliser"]["phase"] == "linear"


def test_what_is_no_rig_says_so_and_changes_nothing(page, qtbot, monkeypatch, tmp_path):
    file = tmp_path / "bench.skinrig"
    file.write_text("not a rig")
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(file), ""))
    page.form.field("rig").choose("file")
    assert "bench.skinrig" in label(page, "problem")
    assert page.form.field("rig").value == "none"
    assert page.form.rigs.rig is None


def test_cancel_writes_nothing_and_leaves_no_thread(page, desk, tmp_path):
    page.form.field("format").choose("hdf5")
    page.reject()
    assert not desk.runner.busy
    assert list(tmp_path.glob("*.h5")) == []


def test_no_name_writes_nothing(page_in_window, window, qtbot, monkeypatch):
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: ("", ""))
    export(window, page_in_window, qtbot)
    assert "Saved" not in window.statusBar().currentMessage()


def test_a_folder_that_is_missing_is_said_to_be(page_in_window, window, qtbot, save_as):
    save_as("missing/drive.wav")
    export(window, page_in_window, qtbot)
    assert "Choose a folder that exists" in window.notice.text


def test_where_nothing_is_heard_there_is_nothing_to_export(make_window):
    quiet = make_window(ss.Design(limb="synthetic-1", inputs=(ss.track(7, muted=True),)))
    assert not quiet.actions_by_name["export_stimulus"].isEnabled()


def test_every_format_of_the_table_is_offered_and_shown(page, qtbot):
    for one in FORMATS:
        choose(page, qtbot, "format", one.name)
        assert page.ready, one.name
        for name in one.choices:
            assert page.form.field(name).isVisible()


def test_closing_the_studio_closes_the_page(page_in_window, window):
    page_in_window.form.field("format").choose("csv")
    window.close_unasked()
    assert window.stimuli.page is None


def test_lengths_of_time_are_said_as_people_read_them():
    said = [duration_words(time_s) for time_s in (37 / 48_000, 0.2, 1.5)]
    assert said == ["0.77 ms", "200 ms", "1.5 s"]
