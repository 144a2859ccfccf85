"""The library: looked at, searched, placed, dragged; the user's own kept, renamed and deleted."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QEvent, QMimeData, QPoint, QPointF, Qt
from PySide6.QtGui import QDragEnterEvent, QDropEvent, QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialogButtonBox, QMessageBox

from skinsource import edits, presets
from skinsource.clips import Clip, Fragment, Lane
from skinsource.design import Design, track
from skinsource.presets import Preset
from skinsource.presets.shipped import SHIPPED
from skinsource.view import View
from skinsource.waveforms import Tap, Tone
from skinsource_gui.library_page.choices import choices
from skinsource_gui.panels.library.presets_model import OWN

KEY = Qt.Key
MINE = Preset(
    name="My tap",
    tags=("mine", "quick"),
    description="A <b>tap</b>.",
    fragment=Fragment(lanes=(Lane(location=3, clips=(Clip(waveform=Tap()),)),)),
)


@pytest.fixture
def panel(window, qtbot):
    window.docks["library"].show()
    qtbot.waitUntil(lambda: window.panel("library").isVisible())
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    return window.panel("library")


def names(panel):
    return [panel.model.index(k).data() for k in range(panel.model.rowCount())]


def go_to(panel, name):
    panel.rows.go_to(names(panel).index(name))


def save(preset=MINE):
    return presets.save_preset(presets.users_folder(), preset)


def labels(window):
    stack = window.document.undo_stack
    return [stack.text(k) for k in range(stack.count())]


def test_every_shipped_preset_is_listed_and_drawn(window, panel):
    assert set(names(panel)) == {one.name for one in SHIPPED}
    for row in range(panel.model.rowCount()):
        panel.rows.go_to(row)
        assert panel.preview.strip.words == ""
        assert panel.preview.preset.name in panel.preview.words.text()
        assert panel.preview.preset.name == panel.model.index(row).data()


def test_a_hidden_panel_reads_no_file(window):
    panel = window.panel("library")
    assert panel.model.rowCount() == 0
    assert panel.shelves.entries == ()


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


def test_enter_places_at_the_playhead_on_the_selected_track_in_one_step(window, panel, settle):
    document = window.document
    document.look(replace(document.view, playhead_s=0.25))
    before = document.design
    go_to(panel, "Double tap")
    panel.rows.setFocus()
    QTest.keyClick(panel.rows, KEY.Key_Return)
    assert labels(window) == ["Place Double tap"]
    (one,) = document.design.inputs
    assert [clip.onset_s for clip in one.clips[1:]] == [0.25, 0.37]
    assert set(document.view.selected_clips) == {clip.id for clip in one.clips[1:]}
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
        told = []
        patch.setattr(window.reports, "complain", told.append)
        window.library.failed.connect(told.append)
        window.library.place_file(path, None)
    assert "bad.skinpreset" in told[0]
    assert window.document.design is before


def test_own_presets_are_there_as_soon_as_their_files_are(window, panel, qtbot):
    path = save()
    qtbot.waitUntil(lambda: "My tap" in names(panel))
    assert names(panel)[0] == "My tap"
    assert panel.model.index(0).data(OWN)
    path.write_text(presets.preset_text(replace(MINE, name="My other tap")))
    qtbot.waitUntil(lambda: names(panel)[0] == "My other tap")
    path.unlink()
    qtbot.waitUntil(lambda: len(names(panel)) == len(SHIPPED))


def test_one_bad_file_is_named_and_left_out_until_it_is_mended(window, panel, qtbot):
    save()
    bad = presets.users_folder() / "bad.skinpreset"
    bad.write_text("{")
    qtbot.waitUntil(panel.faults.isVisible)
    assert "bad.skinpreset" in panel.faults.text()
    assert "My tap" in names(panel)
    bad.unlink()
    qtbot.waitUntil(panel.faults.isHidden)


def test_what_changed_while_it_was_hidden_is_there_when_it_is_shown(window, panel, qtbot):
    window.docks["library"].hide()
    save()
    window.docks["library"].show()
    qtbot.waitUntil(lambda: "My tap" in names(panel))


def test_own_presets_are_renamed_in_place_and_shipped_ones_are_not(window, panel, qtbot):
    save()
    panel.shelves.read()
    index = panel.model.index(0)
    assert index.flags() & Qt.ItemFlag.ItemIsEditable
    panel.model.setData(index, "Ready", Qt.ItemDataRole.EditRole)
    assert names(panel)[0] == "Ready"
    assert panel.rows.currentIndex().data() == "Ready"
    assert [path.name for path in presets.users_folder().iterdir()] == ["ready.skinpreset"]
    go_to(panel, "Tap")
    assert not panel.rows.currentIndex().flags() & Qt.ItemFlag.ItemIsEditable
    assert not panel.buttons.rename.isEnabled()
    assert not panel.buttons.delete.isEnabled()


def test_a_name_that_is_none_is_refused_in_a_sentence(window, panel, qtbot):
    save()
    panel.shelves.read()
    with qtbot.waitSignal(panel.failed) as told:
        panel.model.setData(panel.model.index(0), " ", Qt.ItemDataRole.EditRole)
    assert "name" in told.args[0]
    assert names(panel)[0] == "My tap"


@pytest.mark.parametrize("yes", [True, False])
def test_own_presets_are_deleted_after_a_question(window, panel, monkeypatch, yes):
    answer = QMessageBox.StandardButton.Yes if yes else QMessageBox.StandardButton.No
    monkeypatch.setattr(QMessageBox, "question", lambda *_: answer)
    path = save()
    panel.shelves.read()
    go_to(panel, "My tap")
    panel.rows.setFocus()
    QTest.keyClick(panel.rows, KEY.Key_Delete)
    assert path.exists() is not yes
    assert ("My tap" in names(panel)) is not yes


def test_delete_leaves_shipped_ones_alone(window, panel, monkeypatch):
    monkeypatch.setattr(QMessageBox, "question", lambda *_: pytest.fail("asked"))
    go_to(panel, "Tap")
    panel.rows.setFocus()
    QTest.keyClick(panel.rows, KEY.Key_Delete)
    assert "Tap" in names(panel)


SEVERAL = Design(
    limb="synthetic-1",
    inputs=(
        replace(track(7, Tone(80.0)), clips=(Clip(onset_s=0.1, label="Hum"), Clip(onset_s=0.5))),
        track(2, Tap(), onset_s=0.2, muted=True),
    ),
)


def test_what_can_be_kept_is_what_is_selected_the_track_and_all():
    view = View(selected_inputs=(1,), selected_clips=(1,))
    found = choices(SEVERAL, view)
    assert [one.words for one in found] == [
        "Selected: 1 clip",
        "On the selected track: 2 clips",
        "The whole design: 3 clips on 2 tracks",
    ]
    assert [one.name for one in found] == ["Hum"] * 3
    assert [len(one.fragment.lanes) for one in found] == [1, 1, 2]
    assert found[-1].fragment.lanes[1].clips[0].muted
    assert len(choices(Design(limb="synthetic-1", inputs=(track(7),)), View())) == 1
    assert choices(Design(limb="synthetic-1"), View()) == ()


def test_a_clip_is_kept_under_a_name_and_found_again(window, panel, qtbot):
    page = window.library.ask_and_save()
    button = page.buttons.button(QDialogButtonBox.StandardButton.Save)
    page.name.setText("  ")
    assert not button.isEnabled()
    page.name.setText("  Good   tone ")
    page.tags.setText("mine, low, mine")
    page.description.setText("For the start.")
    button.click()
    qtbot.waitUntil(lambda: "Good tone" in names(panel))
    (entry,) = presets.read_shelf(presets.users_folder()).entries
    assert entry.preset.tags == ("mine", "low")
    assert entry.preset.description == "For the start."
    (clip,) = entry.preset.fragment.lanes[0].clips
    assert clip.waveform == window.document.design.clips[0].waveform
    assert labels(window) == []


def test_what_cannot_be_kept_says_why_and_the_page_stays(window, user_data):
    (user_data / "presets").write_text("in the way")
    page = window.library.ask_and_save()
    page.buttons.button(QDialogButtonBox.StandardButton.Save).click()
    assert page.isVisible()
    assert "cannot be written" in page.problem.text()
    page.tags.setText("x" * 50)
    page.buttons.button(QDialogButtonBox.StandardButton.Save).click()
    assert "tags" in page.problem.text()
    page.reject()


def test_there_is_nothing_to_keep_in_an_empty_design(window):
    window.do("clear_inputs")
    assert not window.actions_by_name["save_to_library"].isEnabled()
