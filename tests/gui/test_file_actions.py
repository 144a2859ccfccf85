from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import QTimer
from PySide6.QtGui import QColor, QDragEnterEvent, QImage
from PySide6.QtWidgets import QApplication, QMessageBox, QWidget

from skinsource import open_design, save_design, track
from skinsource_gui.plots.pictures import PictureOptions
from skinsource_gui.qt.questions import ask_to_save
from skinsource_gui.qt.theme import DARK
from tests.gui.exporting import press, shown
from tests.gui.importing.test_import_page import drop


def place(window, location=3):
    window.document.edit("Place", window.document.design.adding(track(location=location)))


def test_a_saved_design_comes_back_with_its_view_in_ones_panels(window, settle, answers, tmp_path):
    place(window)
    panels = (("skin", (("map_range_db", (-40.0, 0.0)),)),)
    window.document.look(replace(window.document.view, outputs=(1, 61), panels=panels))
    window.docks["spectra"].hide()
    design, view = window.document.design, window.document.view
    answers["save"] = str(tmp_path / "tap")
    window.do("save_design")
    assert not window.document.modified
    assert window.document.path == tmp_path / "tap.skinsource"
    answers["question"] = QMessageBox.StandardButton.Discard
    window.do("new_design")
    assert window.document.design.inputs == ()
    window.docks["spectra"].show()
    window.docks["traces"].hide()
    answers["open"] = str(tmp_path / "tap.skinsource")
    window.do("open_design")
    settle()
    assert window.document.design == design
    assert window.document.view == view
    assert window.docks["traces"].isHidden()
    assert not window.docks["spectra"].isHidden()
    assert window.windowTitle().startswith("tap")
    assert not window.document.undo_stack.canUndo()


def test_unsaved_work_is_not_lost_by_opening_closing_a_scene_or_starting_over(
    window, answers, tmp_path
):
    place(window)
    assert window.isWindowModified()
    design = window.document.design
    save_design(tmp_path / "other.skinsource", design)
    window.do("new_design")
    window.files.open(tmp_path / "other.skinsource")
    window.scenes.open("2F")
    window.close()
    assert len(answers["asked"]) == 4
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


def test_recent_files_are_offered_newest_first_and_missing_ones_dropped(
    window, answers, tmp_path, preferences
):
    for name in ("one", "two"):
        place(window)
        answers["save"] = str(tmp_path / f"{name}.skinsource")
        window.do("save_design_as")
    assert [Path(name).stem for name in window.preferences.recent_names] == ["two", "one"]
    (tmp_path / "one.skinsource").unlink()
    window.files.open(tmp_path / "one.skinsource")
    assert [Path(name).stem for name in window.preferences.recent_names] == ["two"]
    menu = window.findChild(type(window.menuBar().addMenu("x")), "open_recent")
    menu.aboutToShow.emit()
    assert [entry.text() for entry in menu.actions()] == ["two.skinsource"]


def test_the_picture_has_the_size_and_colours_asked_for_and_they_are_kept(
    window, answers, tmp_path
):
    answers["save"] = str(tmp_path / "map.png")
    part = shown(window, "picture")
    for name, value in (("width_px", 500.0), ("height_px", 400.0), ("colours", "dark")):
        part.form._edit(name, value, None)
    preview = part.image.image
    assert QColor(preview.pixel(2, 2)).name() == DARK.base
    assert preview.width() / preview.height() == pytest.approx(1.25, rel=0.01)
    press(part)
    picture = QImage(answers["save"])
    assert (picture.width(), picture.height()) == (500, 400)
    assert QColor(picture.pixel(2, 2)).name() == DARK.base
    kept = PictureOptions(width_px=500, height_px=400, colours="dark")
    assert shown(window, "picture").form.options == kept
    window.exports.end()
    assert answers["asked"] == []


def test_an_existing_file_is_not_replaced_behind_the_dialog(window, answers, tmp_path):
    (tmp_path / "old.skinsource").write_bytes(b"precious")
    place(window)
    answers["save"] = str(tmp_path / "old")
    window.do("save_design")
    assert len(answers["asked"]) == 1
    assert (tmp_path / "old.skinsource").read_bytes() == b"precious"
    assert window.document.modified


def test_a_file_dropped_on_the_window_is_opened(window, settle, answers, tmp_path):
    place(window)
    answers["save"] = str(tmp_path / "a.skinsource")
    window.do("save_design")
    design = window.document.design
    window.do("new_design")
    middle = window.panel("traces").mapTo(window, window.panel("traces").rect().center())
    assert drop(window, tmp_path / "a.skinsource", middle, QDragEnterEvent).isAccepted()
    drop(window, tmp_path / "a.skinsource", middle)
    assert window.document.design == design


def test_a_key_discards(qtbot):
    owner, keys = QWidget(), []
    qtbot.addWidget(owner)

    def look():
        box = QApplication.activeModalWidget()
        keys.append(box.button(QMessageBox.StandardButton.Discard).shortcut().toString())
        box.reject()

    # After what the question does when it opens.
    QTimer.singleShot(0, lambda: QTimer.singleShot(0, look))
    assert not ask_to_save(owner, "Unsaved design", "Save?", lambda: False)
    assert keys == ["Alt+D"]
