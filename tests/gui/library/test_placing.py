"""Presets of the library: placed by keys and mouse, dragged, dropped."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QEvent, QMimeData, QPoint, QPointF, Qt
from PySide6.QtGui import QDragEnterEvent, QDropEvent, QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.design import edits
from skinsource.design.presets.presets import read_preset_folder, shipped_folder
from tests.gui.library.bench import KEY, go_to, labels, names

SHIPPED = read_preset_folder(shipped_folder()).entries


def test_enter_places_at_the_playhead_on_the_selected_track_in_one_step(window, panel, settle):
    document = window.document
    document.look(replace(document.view, playhead_s=0.25))
    before = document.design
    go_to(panel, "Double tap")
    panel.rows.setFocus()
    QTest.keyClick(panel.rows, KEY.Key_Return)
    assert labels(window) == ["Place Double tap"]
    (track,) = document.design.inputs
    assert [clip.onset_s for clip in track.clips[1:]] == [0.25, 0.37]
    assert set(document.view.selected_clips) == {clip.id for clip in track.clips[1:]}
    settle()
    document.undo_stack.undo()
    assert document.design == before


def test_enter_in_the_search_places_what_was_found_first(window, panel):
    panel.search.line.setText("heart")
    QTest.keyClick(panel.search.line, KEY.Key_Return)
    assert labels(window) == ["Place Heartbeat"]


def test_a_double_click_places_and_a_click_only_looks(window, panel):
    go_to(panel, "Click")
    area = panel.rows.visualRect(panel.rows.currentIndex())
    port, left = panel.rows.viewport(), Qt.MouseButton.LeftButton
    QTest.mouseClick(port, left, pos=area.center())
    assert labels(window) == []
    QTest.mouseDClick(port, left, pos=area.center())
    assert labels(window) == ["Place Click"]


def dropped(window, data: QMimeData, at: QPoint):
    """Hold ``data`` over the window at ``at``, and let it go there."""
    copy, left = Qt.DropAction.CopyAction, Qt.MouseButton.LeftButton
    none = Qt.KeyboardModifier.NoModifier
    QApplication.sendEvent(window, QDragEnterEvent(at, copy, data, left, none))
    event = QDropEvent(QPointF(at), copy, data, left, none)
    QApplication.sendEvent(window, event)
    return event


def dragged(panel, name):
    row = names(panel).index(name)
    return panel.model.mimeData([panel.model.index(row)])


def test_a_preset_is_dragged_onto_a_place_of_the_hand(window, panel):
    diagram = window.panel("hand").diagram
    at = diagram.mapTo(window, diagram.site_centre(13))
    event = dropped(window, dragged(panel, "Heartbeat"), at)
    assert event.dropAction() == Qt.DropAction.CopyAction
    assert labels(window) == ["Place Heartbeat"]
    new = window.document.design.inputs[-1]
    assert (new.location, len(new.clips)) == (13, 6)


def test_a_preset_is_dragged_onto_a_track_and_elsewhere_goes_to_the_selected_one(
    window, panel, settle
):
    window.document.apply(edits.place_input(window.document.design, window.document.view, 2), None)
    settle()
    timeline = window.panel("timeline")
    place = next(
        place
        for y in range(timeline.height())
        if (place := timeline.drop_place(QPoint(400, y))) is not None
    )
    y = next(y for y in range(timeline.height()) if timeline.drop_place(QPoint(400, y)) == place)
    dropped(window, dragged(panel, "Click"), timeline.mapTo(window, QPoint(400, y)))
    track_of_drop = window.document.design.input(place.input_id)
    assert track_of_drop.clips[-1].onset_s == pytest.approx(place.onset_s)
    assert len(track_of_drop.clips) == 2
    second = window.document.design.inputs[1].id
    window.document.look(replace(window.document.view, selected_inputs=(second,)))
    dropped(window, dragged(panel, "Tap"), QPoint(5, 5))
    assert len(window.document.design.input(second).clips) == 2


def test_a_damaged_file_that_is_dropped_is_refused_in_a_sentence(window, panel, tmp_path):
    path = tmp_path / "bad.skinpreset"
    path.write_text("{}")
    before = window.document.design
    with pytest.MonkeyPatch.context() as patch:
        messages = []
        patch.setattr(window.reports, "complain", messages.append)
        window.library.failed.connect(messages.append)
        window.library.place_file(path, None)
    assert "bad.skinpreset" in messages[0]
    assert window.document.design is before


def test_every_shipped_preset_is_listed_and_drawn(window, panel):
    assert set(names(panel)) == {entry.preset.name for entry in SHIPPED}
    for row in range(panel.model.rowCount()):
        panel.rows.go_to(row)
        assert panel.preview.strip.message == ""
        assert panel.preview.preset.name in panel.preview.text.text()
        assert panel.preview.preset.name == panel.model.index(row).data()


def test_a_hidden_panel_reads_no_file(window):
    panel = window.panel("library")
    assert panel.model.rowCount() == 0
    assert panel.folders.entries == ()


def test_words_and_tags_narrow_the_list(window, panel):
    QTest.keyClicks(panel.search.line, "contracting equal")
    assert names(panel) == ["Contracting train, equal energy"]
    QTest.keyClick(panel.search.line, KEY.Key_Escape)
    assert len(names(panel)) == len(SHIPPED)
    panel.search.tags.setCurrentText("flutter")
    assert names(panel) == ["Tone 30 Hz"]
    panel.search.line.setText("noise")
    assert names(panel) == []
    assert panel.preview.isHidden()
    assert not panel.buttons.place.isEnabled()


def test_the_pointer_shows_what_it_is_over_and_leaving_shows_the_chosen_one(window, panel):
    panel.rows.go_to(0)
    other = panel.model.index(2)
    at = QPointF(panel.rows.visualRect(other).center())
    none, keys = Qt.MouseButton.NoButton, Qt.KeyboardModifier.NoModifier
    port = panel.rows.viewport()
    over = QMouseEvent(QEvent.Type.MouseMove, at, port.mapToGlobal(at), none, none, keys)
    QApplication.sendEvent(port, over)
    assert panel.preview.preset.name == other.data()
    assert panel.rows.currentIndex().row() == 0
    QApplication.sendEvent(panel.rows, QEvent(QEvent.Type.Leave))
    assert panel.preview.preset.name == panel.model.index(0).data()
