"""File > Export stimulus…: what is written is what was looked at."""

import json
from threading import Event

import pytest
import soundfile
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QApplication,
    QCheckBox,
    QFileDialog,
    QLabel,
    QMessageBox,
    QProgressBar,
    QPushButton,
)

import skinsource as ss
from skinsource.base.errors import Stopped
from skinsource.base.job import stop_if
from skinsource.export.stimulus_export import preparing
from skinsource_gui.pages.stimulus import page as preparing_worker
from tests.gui.stimulus.stimulus_bench import WAIT_MS, choose, export, label


def test_the_bytes_that_are_told_are_those_of_the_file(page, desk, qtbot, save_as):
    n_bytes = page.channels.overview.n_bytes
    path = save_as("drive.wav")
    export(desk, page, qtbot)
    assert abs(path.stat().st_size - n_bytes) < 300


def test_what_was_looked_at_is_written_with_its_sidecar(
    page_in_window, window, qtbot, save_as, design
):
    choose(page_in_window, qtbot, "samples", "pcm24")
    choose(page_in_window, qtbot, "rate", "44100")
    path = save_as("drive.wav")
    export(window, page_in_window, qtbot)
    about = soundfile.info(path)
    assert (about.samplerate, about.channels, about.subtype) == (44_100, 2, "PCM_24")
    metadata = json.loads((path.parent / "drive.wav.json").read_text())
    assert metadata["rate_hz"] == 44_100
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


def test_closing_the_studio_closes_the_page(page_in_window, window):
    page_in_window.form.field("format").choose("csv")
    window.close_unasked()
    assert window.stimuli.page is None


_Answer = QMessageBox.StandardButton


@pytest.fixture
def asked(monkeypatch):
    """Questions that were asked; each was answered with the last of ``answers``."""
    questions, answers = [], [_Answer.Cancel]

    def question(_parent, _title, text, *_):
        questions.append(text)
        return answers[-1]

    monkeypatch.setattr(QMessageBox, "question", question)
    return questions, answers


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


def test_the_file_of_another_channel_is_replaced_only_if_the_user_says_so(
    page, desk, qtbot, save_as, asked, tmp_path
):
    questions, answers = asked
    choose(page, qtbot, "format", "pwle")
    path = save_as("twenty.pwle.json")
    mine = tmp_path / "twenty_channel-2.pwle.json"
    mine.write_text("mine")
    export(desk, page, qtbot)
    assert questions == ["twenty_channel-2.pwle.json exists already. Replace it?"]
    assert (mine.read_text(), path.exists()) == ("mine", False)
    answers.append(_Answer.Yes)
    desk.stimuli.show()
    qtbot.waitUntil(lambda: desk.stimuli.page.ready)
    export(desk, desk.stimuli.page, qtbot)
    assert path.exists()
    assert mine.read_text() != "mine"


def test_a_sidecar_that_is_there_without_its_file_is_not_lost_unasked(
    page, desk, qtbot, save_as, asked, tmp_path
):
    save_as("drive.wav")
    (tmp_path / "drive.wav.json").write_text("mine")
    export(desk, page, qtbot)
    assert asked[0] == ["drive.wav.json exists already. Replace it?"]
    assert contents(tmp_path).get("drive.wav.json") == b"mine"


def test_who_let_a_file_go_is_not_asked_about_its_sidecar(
    page, desk, qtbot, save_as, asked, tmp_path
):
    path = save_as("drive.wav")
    for name in ("drive.wav", "drive.wav.json"):
        (tmp_path / name).write_text("old")
    export(desk, page, qtbot)
    assert asked[0] == []
    assert path.stat().st_size > 1000


def test_one_file_per_input_asks_about_each_that_is_there(
    page, desk, qtbot, save_as, asked, tmp_path
):
    choose(page, qtbot, "channels", "files")
    save_as("drive.wav")
    for number in (1, 3):
        (tmp_path / f"drive_input-{number}.wav").write_text("mine")
    export(desk, page, qtbot)
    assert asked[0] == [
        "2 files exist already: drive_input-1.wav, drive_input-3.wav. Replace them?"
    ]
    assert not (tmp_path / "drive_input-2.wav").exists()


def test_what_a_standard_wants_beside_a_file_is_not_lost_unasked(
    page, desk, qtbot, save_as, asked, tmp_path
):
    choose(page, qtbot, "format", "bids")
    save_as("sub-1_stim.tsv.gz")
    (tmp_path / "sub-1_stim.json").write_text("mine")
    export(desk, page, qtbot)
    assert asked[0] == ["sub-1_stim.json exists already. Replace it?"]
    assert contents(tmp_path) == {"sub-1_stim.json": b"mine"}


@pytest.fixture
def gate(monkeypatch):
    """Set it, and a stimulus is prepared; nothing is before."""
    gate, whole = Event(), preparing.prepare_stimulus

    def held(*arguments, progress, stop, **options):
        progress(1, 4, "Computing")
        while not gate.wait(0.01):
            stop_if(stop)
        return whole(*arguments, progress=progress, stop=stop, **options)

    monkeypatch.setattr(preparing_worker, "prepare_stimulus", held)
    yield gate
    gate.set()


def computing_label(page):
    return page.findChild(QLabel, "stimulus_computing")


def pale(page, name):
    effect = page.findChild(QLabel, f"stimulus_{name}").graphicsEffect()
    return effect is not None and effect.isEnabled()


def test_the_page_says_that_it_computes_and_how_far_it_is(desk, qtbot, gate):
    desk.stimuli.show()
    page = desk.stimuli.page
    qtbot.waitExposed(page)
    qtbot.waitUntil(
        lambda: (
            computing_label(page).isVisible() and computing_label(page).text() == "Computing… 12 %"
        )
    )
    bar = page.findChild(QProgressBar, "stimulus_progress")
    assert bar.isVisible()
    assert (bar.value(), bar.maximum()) == (1, 8)
    gate.set()
    qtbot.waitUntil(lambda: page.ready, timeout=WAIT_MS)
    assert not computing_label(page).isVisible()
    assert not bar.isVisible()
    desk.stimuli.end()


def test_escape_leaves_the_page_while_it_computes(desk, qtbot, gate):
    desk.stimuli.show()
    page = desk.stimuli.page
    qtbot.waitUntil(lambda: computing_label(page).isVisible())
    with qtbot.waitSignal(page.finished):
        QTest.keyClick(page, Qt.Key.Key_Escape)
    assert not gate.is_set()


def test_what_is_said_of_another_order_is_as_pale_as_its_picture(page, qtbot, gate):
    assert not pale(page, "summary")
    page.form.field("rate").choose("8000")
    assert page.busy
    assert "at 48 000 Hz" in label(page, "summary")
    assert pale(page, "summary")
    assert pale(page, "loses")
    gate.set()
    qtbot.waitUntil(lambda: page.ready, timeout=WAIT_MS)
    assert not pale(page, "summary")
    assert "at 8 000 Hz" in label(page, "summary")


def test_a_refusal_is_not_pale(page, qtbot):
    page.form.field("map").setText("1")
    qtbot.waitUntil(lambda: "each channel" in label(page, "problem"), timeout=WAIT_MS)
    assert not pale(page, "problem")
    assert not computing_label(page).isVisible()


def test_a_stimulus_is_given_up_between_two_of_its_channels():
    design = ss.Design(limb="synthetic-1", inputs=tuple(ss.track(place) for place in (7, 8, 9)))
    progress = []

    def note(done, total, text):
        progress.append((done, total))

    ss.stimulus_of(design, 48_000, progress=note)
    assert progress == [(0, 3), (1, 3), (2, 3)]
    progress.clear()
    with pytest.raises(Stopped):
        ss.stimulus_of(design, 48_000, progress=note, stop=lambda: len(progress) > 1)
    assert progress == [(0, 3), (1, 3)]
