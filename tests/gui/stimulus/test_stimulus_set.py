"""File > Export…, Stimulus set: a file for each combination of values."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QFileDialog, QPushButton

import skinsource as ss
from skinsource.cli.command_line import main
from skinsource_gui.qt.theme import current_theme
from tests.gui.stimulus.conftest import opened
from tests.gui.stimulus.stimulus_bench import WAIT_MS, export


@pytest.fixture
def part(desk, qtbot):
    desk.exports.show("stimulus_set")
    yield opened(desk.exports, qtbot)
    desk.exports.end()


def vary(part, qtbot, row, name, values):
    part.variables[row].choose(name)
    line = part.values[part.variables[row]].line
    line.selectAll()
    QTest.keyClicks(line, values)
    qtbot.waitUntil(lambda: part.planned is not None and not part._worker.busy, timeout=WAIT_MS)


def type_in(part, editor, text):
    editor.line.setFocus()
    editor.line.selectAll()
    QTest.keyClick(editor.line, Qt.Key.Key_Delete)
    QTest.keyClicks(editor.line, text)
    QTest.keyClick(editor.line, Qt.Key.Key_Tab)


def levels_of(part, qtbot):
    qtbot.waitUntil(lambda: part.planned is not None and not part._worker.busy, timeout=WAIT_MS)
    return [round(condition.level_db, 3) for condition in part.planned.conditions]


def content_of(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_the_window_writes_what_the_command_writes(
    part, desk, design, qtbot, save_as, tmp_path, capsys
):
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
    type_in(part, editor, text)
    assert editor.line.problem in part._problem.text() != ""
    frame = editor.line.viewport().grab().toImage().pixelColor(20, 1)
    assert frame == QColor(current_theme().error)
    part.form.emit_order()
    assert not part.window().findChild(QPushButton, "export_button").isEnabled()
    editor.line.setFocus()
    QTest.keyClick(editor.line, Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: part.ready, timeout=WAIT_MS)
    assert not part._problem.isVisible()
    assert len(part.planned.conditions) == 2


def test_a_variable_that_matching_cancels_is_refused(part, qtbot):
    part.output.choose("29")
    part.variables[0].choose("amplitude")
    qtbot.waitUntil(lambda: "Remove the amplitude" in part._problem.text(), timeout=WAIT_MS)
    assert not part.ready
    part.output.choose("")
    qtbot.waitUntil(lambda: part.ready, timeout=WAIT_MS)


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
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *all: asked.append(all) or ("", ""))
    desk.exports.show("stimulus_set")
    part = opened(desk.exports, qtbot)
    assert levels_of(part, qtbot) == [2.0, 2.0]
    assert part.values[part.variables[1]].value == (50, 120)
    export(desk, part, qtbot)
    assert asked[0][2] == f"{first}-2"
