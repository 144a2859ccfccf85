"""Storing a snapshot: beside the history, kept with the file, never lost unasked."""

from skinsource.design import edits
from skinsource.design.design_file import open_design
from tests.gui.compare.compare_bench import edit


def test_storing_is_no_step_and_is_saved_with_the_file(window, settle, tmp_path):
    window.files._save_to(tmp_path / "a.skinsource")
    titles = []
    window.document.title_changed.connect(lambda: titles.append(window.document.modified))
    edit(window, 2.0)
    window.do("store_snapshot_1")
    assert (window.document.modified, titles) == (True, [True])
    assert window.document.undo_stack.count() == 1
    window.do("undo")
    # What is in no file yet would be lost.
    assert (window.document.modified, titles) == (True, [True])
    assert not window.document.undo_stack.canUndo()
    window.do("redo")
    window.document.undo_stack.clear()
    assert not window.document.undo_stack.canUndo()
    window.files.save()
    assert (window.document.modified, titles[-1]) == (False, False)
    assert open_design(tmp_path / "a.skinsource").view.snapshots[0].design == window.document.design


def test_a_snapshot_of_what_was_saved_is_nothing_that_could_be_lost(window, tmp_path):
    document = window.document
    window.files._save_to(tmp_path / "a.skinsource")
    window.do("store_snapshot_1")
    assert not document.modified
    edit(window, 2.0)
    assert document.modified
    window.do("undo")
    assert not document.modified
    window.files.save()
    window.document.apply(edits.forget_snapshot(document.design, document.view, 1))
    assert document.modified


def test_what_is_said_of_a_stored_snapshot_names_the_other_one_if_there_is_one(window):
    window.do("store_snapshot_1")
    message = window.statusBar().currentMessage()
    assert message == "Stored snapshot 1; change the design, and X goes to and fro"
    edit(window, 2.0)
    window.do("store_snapshot_2")
    message = window.statusBar().currentMessage()
    assert message == "Stored snapshot 2; X shows snapshot 1, and this again"


def test_what_is_undone_later_takes_no_snapshot_away(window):
    document = window.document
    edit(window, 2.0)
    window.do("store_snapshot_1")
    window.do("undo")
    assert [snapshot.number for snapshot in document.view.snapshots] == [1]
    assert document.view.snapshots[0].design.inputs[0].amplitude == 2.0
    window.do("redo")
    assert len(document.view.snapshots) == 1
    assert document.undo_stack.count() == 1


def test_a_snapshot_that_another_replaces_comes_back_with_undo_and_later_ones_stay(window):
    document = window.document
    window.do("store_snapshot_1")
    first = document.view.snapshots
    edit(window, 2.0)
    window.do("store_snapshot_1")
    assert document.undo_stack.count() == 2
    assert "Undo brings back" in window.notice.text or "Undo brings back" in (
        window.statusBar().currentMessage()
    )
    window.do("store_snapshot_3")
    window.do("undo")
    assert document.view.snapshots[0] == first[0]
    assert [snapshot.number for snapshot in document.view.snapshots] == [1, 3]
    window.do("redo")
    assert document.view.snapshots[0].design.inputs[0].amplitude == 2.0
    assert {snapshot.number for snapshot in document.view.snapshots} == {1, 3}
