"""Presets of the library: listed, looked at, placed by keys and mouse, dragged, dropped."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.design.presets.presets import read_preset_folder, shipped_folder

SHIPPED = read_preset_folder(shipped_folder()).entries
KEY, LEFT, NONE = Qt.Key, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier


def test_enter_places_at_the_playhead_on_the_selected_track_in_one_step(bench):
    bench.show(playhead_s=0.25)
    bench.go_to("Double tap")
    QTest.keyClick(bench.panel.rows, KEY.Key_Return)
    assert bench.labels == ["Place Double tap"]
    (track,) = bench.design.inputs
    assert [clip.onset_s for clip in track.clips[1:]] == [0.25, 0.37]
    assert set(bench.view.selected_clips) == {clip.id for clip in track.clips[1:]}
    # Enter in the search places what is listed first.
    bench.panel.search.line.setText("heart")
    QTest.keyClick(bench.panel.search.line, KEY.Key_Return)
    assert bench.labels[1:] == ["Place Heartbeat"]


def test_a_double_click_places_and_a_click_only_looks(bench):
    rows = bench.panel.rows
    bench.go_to("Click")
    area = rows.visualRect(rows.currentIndex())
    QTest.mouseClick(rows.viewport(), LEFT, pos=area.center())
    assert bench.labels == []
    QTest.mouseDClick(rows.viewport(), LEFT, pos=area.center())
    assert bench.labels == ["Place Click"]


def test_every_shipped_preset_is_listed_and_drawn_once_it_is_shown(bench):
    assert set(bench.names) == {entry.preset.name for entry in SHIPPED}
    panel = bench.panel
    for row in range(panel.model.rowCount()):
        panel.rows.go_to(row)
        assert panel.preview.strip.message == ""
        assert panel.preview.preset.name in panel.preview.text.text()
        assert panel.preview.preset.name == panel.model.index(row, 0).data()


def test_words_and_tags_narrow_the_list(bench):
    panel = bench.panel
    QTest.keyClicks(panel.search.line, "contracting equal")
    assert bench.names == ["Contracting train, equal energy"]
    QTest.keyClick(panel.search.line, KEY.Key_Escape)
    assert len(bench.names) == len(SHIPPED)
    panel.search.tags.setCurrentText("flutter")
    assert bench.names == ["Tone 30 Hz"]
    panel.search.line.setText("noise")
    assert bench.names == []
    assert panel.preview.isHidden()
    assert not panel.buttons.place.isEnabled()


@pytest.fixture
def drop(window, qtbot):
    """Lets a preset go over the window, as it is dragged from the list."""
    assert window.panel("library").model.rowCount() == 0, "a hidden panel reads no file"
    window.docks["library"].bring_forward()
    panel = window.panel("library")
    qtbot.waitUntil(panel.isVisible)

    def let_go(name, at):
        model = panel.model
        row = next(k for k in range(model.rowCount()) if model.index(k, 0).data() == name)
        copy, data = Qt.DropAction.CopyAction, model.mimeData([model.index(row, 0)])
        QApplication.sendEvent(window, QDragEnterEvent(at, copy, data, LEFT, NONE))
        event = QDropEvent(QPointF(at), copy, data, LEFT, NONE)
        QApplication.sendEvent(window, event)
        assert event.dropAction() == copy

    return let_go


def test_a_preset_goes_where_it_is_dropped_and_elsewhere_to_the_selected_track(
    window, drop, settle
):
    document, diagram = window.document, window.panel("hand").diagram
    drop("Heartbeat", diagram.mapTo(window, diagram.site_centre(13)))
    new = document.design.inputs[-1]
    assert (new.location, len(new.clips)) == (13, 6)
    settle()
    timeline = window.panel("timeline")
    y, place = next(
        (y, place)
        for y in range(timeline.height())
        if (place := timeline.drop_place(QPoint(400, y))) is not None
    )
    drop("Click", timeline.mapTo(window, QPoint(400, y)))
    track = document.design.input(place.input_id)
    assert track.clips[-1].onset_s == pytest.approx(place.onset_s)
    assert len(track.clips) == 2
    document.look(replace(document.view, selected_inputs=(new.id,)))
    drop("Tap", QPoint(5, 5))
    assert len(document.design.input(new.id).clips) == 7


def test_a_damaged_file_that_is_dropped_is_refused_in_a_sentence(window, tmp_path):
    path, messages = tmp_path / "bad.skinpreset", []
    path.write_text("{}")
    before = window.document.design
    window.library.failed.connect(messages.append)
    window.library.place_file(path, None)
    assert "bad.skinpreset" in messages[0]
    assert window.document.design is before
