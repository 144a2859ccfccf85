"""File > Export…, Stimulus and Stimulus set: what is written is what was looked at."""

import json
from threading import Event

import pytest
import soundfile
from PySide6 import QtWidgets
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest

import skinsource as ss
from skinsource.base.job import stop_if
from skinsource.cli.command_line import main
from skinsource.design.design import View
from skinsource.engine import stimulus
from skinsource.export.stimulus_export import preparing, sidecar
from skinsource_gui.pages.stimulus import page as preparing_worker
from skinsource_gui.qt.theme import current_theme
from tests.core.sweeps.test_stimulus_set import content_of
from tests.gui.stimulus.conftest import opened
from tests.gui.stimulus.stimulus_bench import WAIT_MS, choose, export, label


def test_from_page_to_file_each_clip_is_sampled_once(desk, qtbot, save_as, monkeypatch, design):
    sampled, sample, predictions, predict = [], stimulus.played, [], sidecar.about_validity

    def count_sampled(waveform, *arguments):
        sampled.append(waveform)
        return sample(waveform, *arguments)

    def count_predictions(*arguments):
        predictions.append(arguments)
        return predict(*arguments)

    monkeypatch.setattr(stimulus, "played", count_sampled)
    monkeypatch.setattr(sidecar, "about_validity", count_predictions)
    page = opened(desk, qtbot)
    # Its losses to 48 kHz are told already.
    assert page.prepared.drives.sample_rate_hz == 48_000
    path, told = save_as("drive.wav"), []
    desk.runner.progressed.connect(lambda _, progress: told.append((progress.text, progress.total)))
    export(desk, page, qtbot)
    # The share of what is written is none of what is computed of validity.
    assert told[-1] == ("Computing", 0)
    assert path.stat().st_size > 1000
    assert sampled == [clip.waveform for clip in design.clips]
    assert len(predictions) == 1


def test_it_can_be_done_with_keys_alone(page, desk, qtbot, save_as):
    page.form.field("advanced").click()
    first = page.form.field("format")
    assert QtWidgets.QApplication.focusWidget() is first
    QTest.keyClick(first, Qt.Key.Key_Down)
    assert page.form.format.name == "flac"
    reached = set()
    for _ in range(30):
        QTest.keyClick(QtWidgets.QApplication.focusWidget(), Qt.Key.Key_Tab)
        reached.add(QtWidgets.QApplication.focusWidget().objectName())
        assert QtWidgets.QApplication.focusWidget().accessibleName() or isinstance(
            QtWidgets.QApplication.focusWidget(), QtWidgets.QCheckBox | QtWidgets.QPushButton
        ), QtWidgets.QApplication.focusWidget()
        if "stimulus_format" in reached:
            break
    names = ("rate", "plays", "channels", "map", "time", "fade_in", "lead_in", "scale", "sync")
    assert {f"stimulus_{name}" for name in names} <= reached
    qtbot.waitUntil(lambda: page.ready, timeout=WAIT_MS)
    path = save_as("drive.flac")
    QTest.keyClick(page.window(), Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: path.exists() and not desk.runner.busy, timeout=WAIT_MS)
    assert soundfile.info(path).subtype == "PCM_24"


def test_what_would_clip_is_shown_and_must_be_confirmed(page, desk, qtbot, save_as):
    page.form.field("advanced").click()
    choose(page, qtbot, "scale", "own")
    field = page.form.field("full_scale")
    field.setFocus()
    QTest.keyClicks(field, "0.5")
    QTest.keyClick(field, Qt.Key.Key_Tab)
    qtbot.waitUntil(lambda: not page.busy, timeout=WAIT_MS)
    clipped = page.channels.channels[1].clipped
    assert clipped > 100
    assert f"channel 2 (Digit II, base) {clipped}" in label(page, "problem")
    assert f"{clipped} samples would clip" in page.channels.accessibleDescription()
    assert not page.ready
    page.findChild(QtWidgets.QCheckBox, "stimulus_confirm").click()
    assert page.ready
    # What was confirmed was this, and nothing else.
    choose(page, qtbot, "rate", "8000")
    assert not page.ready
    page.findChild(QtWidgets.QCheckBox, "stimulus_confirm").click()
    path = save_as("loud.wav")
    export(desk, page, qtbot)
    assert json.loads((path.parent / "loud.wav.json").read_text())["clip_count"] > 0


def test_the_file_of_another_channel_is_replaced_only_if_the_user_says_so(
    page, desk, qtbot, save_as, answers, tmp_path
):
    choose(page, qtbot, "format", "pwle")
    path = save_as("twenty.pwle.json")
    mine = tmp_path / "twenty_channel-2.pwle.json"
    mine.write_text("mine")
    export(desk, page, qtbot)
    assert answers["asked"] == ["twenty_channel-2.pwle.json exists already. Replace it?"]
    assert (mine.read_text(), path.exists()) == ("mine", False)
    answers["question"] = QtWidgets.QMessageBox.StandardButton.Yes
    # The dialog stayed open.
    export(desk, page, qtbot)
    assert path.exists()
    assert mine.read_text() != "mine"


def test_a_sidecar_that_is_there_without_its_file_is_not_lost_unasked(
    page, desk, qtbot, save_as, answers, tmp_path
):
    save_as("drive.wav")
    (tmp_path / "drive.wav.json").write_text("mine")
    export(desk, page, qtbot)
    assert answers["asked"] == ["drive.wav.json exists already. Replace it?"]
    assert (tmp_path / "drive.wav.json").read_text() == "mine"


def test_a_lossy_rate_keeps_the_button_off_until_it_is_ticked(make_desk, qtbot, save_as):
    tone = ss.waveforms.Tone(frequency_hz=500.0)
    desk = make_desk(ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone),)), View())
    low = opened(desk, qtbot)
    low.form.field("other_rate").set_value(1000)
    choose(low, qtbot, "rate", "other")
    assert not low.ready
    assert "channel 1 (Digit II, pad) loses 5.8 dB of its energy" in label(low, "loses")
    assert label(low, "problem") == (
        "More than 1 dB is lost: choose 1300 Hz, the rate of the design, or lower the frequencies."
    )
    tick = low.findChild(QtWidgets.QCheckBox, "stimulus_confirm")
    assert tick.isVisible()
    tick.click()
    assert low.ready
    path = save_as("lossy.wav")
    export(desk, low, qtbot)
    assert "loses 5.8 dB" in json.loads((path.parent / "lossy.wav.json").read_text())["loses"]


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


def bar_of(page):
    return page.findChild(QtWidgets.QProgressBar, "stimulus_progress")


def pale(page, name):
    effect = page.findChild(QtWidgets.QLabel, f"stimulus_{name}").graphicsEffect()
    return effect is not None and effect.isEnabled()


def test_the_page_says_that_it_computes_and_how_far_it_is(desk, qtbot, gate):
    desk.exports.show("stimulus")
    page = desk.exports.page.part
    qtbot.waitExposed(page)
    bar = bar_of(page)
    qtbot.waitUntil(lambda: bar.isVisible() and bar.text() == "Computing… 25 %")
    assert (bar.value(), bar.maximum()) == (1, 4)
    gate.set()
    qtbot.waitUntil(lambda: page.ready, timeout=WAIT_MS)
    assert not bar.isVisible()


def test_escape_leaves_the_page_while_it_computes(desk, qtbot, gate):
    desk.exports.show("stimulus")
    page = desk.exports.page.part
    qtbot.waitUntil(lambda: bar_of(page).isVisible())
    with qtbot.waitSignal(page.window().finished):
        QTest.keyClick(page.window(), Qt.Key.Key_Escape)
    assert not gate.is_set()


def test_what_is_said_of_another_order_is_as_pale_as_its_picture(page, qtbot, gate):
    assert not pale(page, "summary")
    page.form.field("rate").choose("8000")
    assert page.busy
    assert "48 kHz" in label(page, "summary")
    assert pale(page, "summary")
    assert pale(page, "loses")
    gate.set()
    qtbot.waitUntil(lambda: page.ready, timeout=WAIT_MS)
    assert not pale(page, "summary")
    assert "8 kHz" in label(page, "summary")


@pytest.fixture
def part(desk, qtbot):
    return opened(desk, qtbot, "stimulus_set")


def vary(part, qtbot, row, name, values):
    part.variables[row].choose(name)
    line = part.values[part.variables[row]].line
    line.selectAll()
    QTest.keyClicks(line, values)
    qtbot.waitUntil(lambda: part.planned is not None and not part._worker.busy, timeout=WAIT_MS)


def type_in(part, editor, text, end=Qt.Key.Key_Tab):
    editor.line.setFocus()
    editor.line.selectAll()
    QTest.keyClick(editor.line, Qt.Key.Key_Delete)
    QTest.keyClicks(editor.line, text)
    QTest.keyClick(editor.line, end)


def levels_of(part, qtbot):
    qtbot.waitUntil(lambda: part.planned is not None and not part._worker.busy, timeout=WAIT_MS)
    return [round(condition.level_db, 3) for condition in part.planned.conditions]


def test_the_window_writes_as_commands_do(part, desk, design, qtbot, save_as, tmp_path, capsys):
    vary(part, qtbot, 0, "2.frequency_hz", "50, 120")
    vary(part, qtbot, 1, "2.duration_s", "100, 200")
    part.output.choose("29")
    part.form.field("scale").choose("own")
    type_in(part, part.level, "20, -20")
    assert levels_of(part, qtbot)[::2] == [20] * 4
    assert "beyond full scale" in part.table.item(0, 0).text()
    # The line may be cut off: its tooltip has all of it.
    whole = part.table.item(0, 0).toolTip().replace("\n", " ")
    assert whole == part.table.item(0, 0).text()
    part.table.setCurrentCell(1, 0)
    qtbot.waitUntil(lambda: len(part.channels.channels) == 2, timeout=WAIT_MS)
    out = save_as("window")
    export(desk, part, qtbot)
    ss.save_design(tmp_path / "a.skinsource", design)
    call = ["export", str(tmp_path / "a.skinsource"), "--out", str(tmp_path / "command")]
    call += ["--vary", "2.frequency_hz=[50, 120]", "--vary", "2.duration_s=[0.1, 0.2]"]
    call += ["--match-output", "29", "--level-db", "20", "--level-db", "-20"]
    assert main([*call, "--full-scale", "1"]) == 1
    assert content_of(out) == content_of(tmp_path / "command")
    assert desk.document.design == design
    capsys.readouterr()


def test_a_variable_has_one_row_and_stays_while_the_dialog_is_open(part, desk, qtbot):
    vary(part, qtbot, 0, "location", "7, 12, 3")
    desk.exports.page.show_export("levels")
    desk.exports.page.show_export("stimulus_set")
    assert desk.exports.page.part.values[part.variables[0]].value == (7, 12, 3)
    part.variables[1].choose("location")
    assert not part.ready
    assert "chosen twice" in part._problem.text()
    part.variables[1].choose("")
    qtbot.waitUntil(lambda: part.ready, timeout=WAIT_MS)
    assert part.table.rowCount() == 3
    QTest.keyClick(part.variables[0], Qt.Key.Key_Tab)
    assert desk.exports.page.focusWidget() is part.values[part.variables[0]].line


def test_a_cleared_level_is_that_of_the_design_again(part, qtbot):
    part.output.choose("29")
    own = levels_of(part, qtbot)
    type_in(part, part.level, "2")
    assert levels_of(part, qtbot) == [2.0]
    type_in(part, part.level, "")
    assert levels_of(part, qtbot) == own != [2.0]


@pytest.mark.parametrize("text", ["abc", "50, abc", "5000, 0", ""])
def test_values_that_are_refused_are_marked_with_the_reason_and_not_exported(part, qtbot, text):
    part.variables[0].choose("2.frequency_hz")
    editor = part.values[part.variables[0]]
    type_in(part, editor, "50,120")
    type_in(part, editor, text, Qt.Key.Key_Return)
    assert editor.line.problem in part._problem.text() != ""
    frame = editor.line.viewport().grab().toImage().pixelColor(20, 1)
    assert frame == QColor(current_theme().error)
    part.form.emit_order()
    assert not part.window().findChild(QtWidgets.QPushButton, "export_button").isEnabled()
    editor.line.setFocus()
    QTest.keyClick(editor.line, Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: part.ready, timeout=WAIT_MS)
    assert not part._problem.isVisible()
    assert len(part.planned.conditions) == 2


def test_the_values_of_a_frequency_fit_into_the_column(part):
    part.variables[0].choose("frequency_hz")
    fields = part.findChild(QtWidgets.QScrollArea, "stimulus_fields")
    assert fields.widget().minimumSizeHint().width() <= fields.viewport().width()


def test_a_variable_that_matching_cancels_is_refused(part, qtbot):
    part.output.choose("29")
    part.variables[0].choose("amplitude")
    qtbot.waitUntil(lambda: "Remove the amplitude" in part._problem.text(), timeout=WAIT_MS)
    assert not part.ready
    part.output.choose("")
    qtbot.waitUntil(lambda: part.ready, timeout=WAIT_MS)
    assert label(part, "set_summary").endswith("Amplitude becomes the same on all tracks.")


def test_the_next_set_has_the_same_fields_and_begins_beside_the_last_one(
    part, desk, qtbot, save_as, monkeypatch
):
    part.variables[1].choose("2.frequency_hz")
    type_in(part, part.values[part.variables[1]], "50, 120")
    part.output.choose("29")
    type_in(part, part.level, "2")
    assert levels_of(part, qtbot) == [2.0, 2.0]
    first, asked = save_as(part.suggestion()[0]), []
    export(desk, part, qtbot)
    monkeypatch.setattr(
        QtWidgets.QFileDialog, "getSaveFileName", lambda *all: asked.append(all) or ("", "")
    )
    part = opened(desk, qtbot, "stimulus_set")
    assert levels_of(part, qtbot) == [2.0, 2.0]
    assert part.values[part.variables[1]].value == (50, 120)
    export(desk, part, qtbot)
    assert asked[0][2] == f"{first}-2"
    # A folder that exists cannot be chosen there.
    assert asked[0][3].startswith("New folder, none replaced")
