from dataclasses import replace

import pytest
from PySide6.QtWidgets import QFileDialog, QMessageBox

from skinsource.design import Input
from skinsource.design_file import open_design


@pytest.fixture
def answers(monkeypatch):
    """Answer the questions that dialogs would ask; remember what was asked."""
    given = {"open": "", "save": "", "question": QMessageBox.StandardButton.Cancel}
    asked = []

    def answer(kind):
        asked.append(kind)
        return given[kind]

    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (answer("open"), ""))
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (answer("save"), ""))
    monkeypatch.setattr(QMessageBox, "question", lambda *_: answer("question"))
    given["asked"] = asked
    return given


def place(window, location=3):
    window.document.edit("Place", window.document.design.adding(Input(location=location)))


def test_a_saved_design_comes_back_with_its_view_and_arrangement(window, settle, answers, tmp_path):
    place(window)
    window.document.look(replace(window.document.view, outputs=(1, 61), map_range_db=(-40.0, 0.0)))
    window.docks["spectra"].hide()
    design, view = window.document.design, window.document.view
    answers["save"] = str(tmp_path / "tap")
    window.commands.save_design()
    assert not window.document.modified
    assert window.document.path == tmp_path / "tap.skinsource"
    answers["question"] = QMessageBox.StandardButton.Discard
    window.commands.new_design()
    assert window.document.design.inputs == ()
    window.commands.arrange_design()
    answers["open"] = str(tmp_path / "tap.skinsource")
    window.commands.open_design()
    settle()
    assert window.document.design == design
    assert window.document.view == view
    assert window.docks["spectra"].isHidden()
    assert window.windowTitle().startswith("tap")
    assert not window.document.undo_stack.canUndo()


def test_unsaved_work_is_not_lost_by_opening_closing_or_starting_over(window, answers, tmp_path):
    place(window)
    assert window.isWindowModified()
    design = window.document.design
    window.commands.new_design()
    window.files.open(tmp_path / "other.skinsource")
    window.close()
    assert answers["asked"] == ["question"] * 3
    assert window.document.design == design
    assert window.isVisible()


def test_answering_save_saves_before_closing(window, answers, tmp_path):
    place(window)
    answers["question"] = QMessageBox.StandardButton.Save
    answers["save"] = str(tmp_path / "kept.skinsource")
    window.close()
    assert not window.isVisible()
    assert len(open_design(tmp_path / "kept.skinsource").design.inputs) == 2


def test_a_file_that_is_no_design_is_refused_and_what_is_open_stays(window, answers, tmp_path):
    path = tmp_path / "song.skinsource"
    path.write_bytes(b"not a design")
    design = window.document.design
    window.files.open(path)
    assert "song.skinsource" in window.notice.text
    assert window.document.design is design


def test_a_folder_that_cannot_be_written_is_one_clear_error(window, answers, tmp_path):
    place(window)
    answers["save"] = str(tmp_path / "no" / "such" / "folder.skinsource")
    window.commands.save_design()
    assert "cannot be written" in window.notice.text
    assert window.document.modified


def test_recent_files_are_offered_newest_first_and_missing_ones_dropped(
    window, answers, tmp_path, preferences
):
    for name in ("one", "two"):
        place(window)
        answers["save"] = str(tmp_path / f"{name}.skinsource")
        window.commands.save_design_as()
    assert [path.stem for path in preferences.recent_files] == ["two", "one"]
    (tmp_path / "one.skinsource").unlink()
    window.files.open(tmp_path / "one.skinsource")
    assert [path.stem for path in preferences.recent_files] == ["two"]
    menu = window.findChild(type(window.menuBar().addMenu("x")), "open_recent")
    menu.aboutToShow.emit()
    assert [entry.text() for entry in menu.actions()] == ["two.skinsource"]


def test_exports_hold_the_present_design(window, settle, answers, tmp_path):
    answers["save"] = str(tmp_path / "traces.csv")
    window.commands.export_traces()
    lines = (tmp_path / "traces.csv").read_text(encoding="utf-8").splitlines()
    assert any("SYNTHETIC" in line for line in lines)
    assert "time_s,output_29_m_per_s2,output_52_m_per_s2" in lines
    answers["save"] = str(tmp_path / "map.png")
    window.commands.export_picture()
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")


def test_traces_of_no_outputs_cannot_be_exported(window, answers):
    window.commands.select_no_outputs()
    window.commands.export_traces()
    assert "No output is selected" in window.notice.text
    assert answers["asked"] == []
