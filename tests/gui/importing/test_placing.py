"""Where a recording goes when one is selected."""

import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDragLeaveEvent, QDragMoveEvent, QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QWidget

from skinsource.design import edits
from skinsource.design.waveforms.samples import Recording
from skinsource_gui.pages import actions
from skinsource_gui.panels.timeline.content import clip_name


@pytest.fixture
def placeholder(desk):
    """A track whose only clip stands for a recording, and that clip, which is selected."""
    document = desk.document
    track = document.design.inputs[0]
    document.apply(
        edits.change_kind(document.design, document.view, (track.id,), "Recording"), None
    )
    clip = document.design.inputs[0].clips[0]
    document.apply(edits.select_clips(document.design, document.view, (clip.id,)), None)
    return track, clip


def test_a_recording_goes_in_place_of_what_stands_for_one_and_of_another_when_that_is_said(
    desk, page_at, sound, placeholder
):
    document, track, clip = desk.document, *placeholder
    first = actions.options(document.design, document.view, None)[0]
    assert first[0] == f"clip {clip.id}"
    assert first[1].startswith("In place of the recording on input 1, at ")
    page_at(sound).accept()
    (now,) = document.design.inputs[0].clips
    assert now.waveform.name == "tap.wav, channel 1"
    assert (now.id, now.onset_s) == (clip.id, clip.onset_s)
    again = [name for name, _ in actions.options(document.design, document.view, None)]
    assert again[:2] == [f"track {track.id}", f"clip {clip.id}"]


def test_a_recording_whose_place_went_while_its_page_was_open_is_refused(
    desk, page_at, sound, placeholder
):
    document, (_, clip) = desk.document, placeholder
    page, messages = page_at(sound), []
    document.refused.connect(messages.append)
    document.apply(edits.remove_clips(document.design, document.view, (clip.id,)), None)
    without = document.design
    page.accept()
    assert messages == ["That recording is no longer there; import it to another place."]
    assert document.design == without


NO_KEYS = Qt.KeyboardModifier.NoModifier


def drop(window, path, at, kind=QDropEvent, *others):
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(each)) for each in (path, *others)])
    where = QPointF(at) if kind is QDropEvent else at
    event = kind(where, Qt.DropAction.CopyAction, data, Qt.MouseButton.LeftButton, NO_KEYS)
    QApplication.sendEvent(window, event)
    return event


def site(window, number):
    diagram = window.panel("hand").diagram
    return diagram.mapTo(window, diagram.site_centre(number))


@pytest.mark.parametrize("where", ["site", "row", "elsewhere"])
def test_a_file_that_is_dropped_goes_where_it_was_dropped(window, qtbot, sound, where):
    first = window.document.design.inputs[0]
    row = window.panel("timeline").heads.viewport()
    at = {
        "site": site(window, 13),
        "row": row.mapTo(window, QPoint(60, 10)),
        "elsewhere": window.panel("traces").mapTo(window, QPoint(50, 50)),
    }[where]
    assert drop(window, sound, at, QDragEnterEvent).isAccepted()
    assert drop(window, sound, at).isAccepted()
    (page,) = window.imports.pages
    qtbot.waitUntil(lambda: not page.busy, timeout=60_000)
    QApplication.processEvents()
    page.accept()
    inputs = window.document.design.inputs
    if where == "site":
        assert inputs[-1].location == 13
        assert isinstance(inputs[-1].clips[0].waveform, Recording)
    else:
        # The start design's only input is the selected one.
        assert [track.id for track in inputs] == [first.id]
        assert isinstance(inputs[0].clips[-1].waveform, Recording)


def test_of_several_files_one_after_the_other_is_asked_about_and_what_is_left_out_is_named(
    window, qtbot, sound, tmp_path
):
    second = tmp_path / "second.wav"
    second.write_bytes(sound.read_bytes())
    for kind in (QDragEnterEvent, QDropEvent):
        drop(window, sound, site(window, 13), kind, tmp_path / "a.skinsource", second)
    assert "a.skinsource" in window.notice.text
    for path in (sound, second):
        (page,) = window.imports.pages
        assert path.name in page.windowTitle()
        qtbot.waitUntil(lambda page=page: page.ready, timeout=60_000)
        page.accept()
        QApplication.processEvents()
    assert window.imports.pages == ()
    names = [track.clips[0].waveform.name for track in window.document.design.inputs[1:]]
    assert names == ["tap.wav, channel 1", "second.wav, channel 1"]


def test_a_site_lights_up_while_a_recording_is_held_over_it(window, sound, tmp_path):
    stage = window.panel("hand").diagram.stage
    at = site(window, 13)
    drop(window, sound, at, QDragEnterEvent)
    drop(window, sound, at, QDragMoveEvent)
    assert stage.state.target == 13
    QApplication.sendEvent(window, QDragLeaveEvent())
    assert stage.state.target is None
    drop(window, tmp_path / "a.skinsource", at, QDragEnterEvent)
    assert stage.state.target is None


def where(page):
    return page.findChild(QLabel, "import_where").text()


def test_a_recording_goes_to_the_playhead_even_over_a_clip_and_has_the_name_of_its_file(
    desk, page_at, sound
):
    document = desk.document
    document.apply(edits.move_playhead(document.design, document.view, 0.1))
    assert document.design.inputs[0].clips[0].end_s > 0.1
    page = page_at(sound)
    assert where(page) == "Starts at 100 ms on 7 (II pad)"
    QTest.keyClick(page.findChild(QWidget, "import_place"), Qt.Key.Key_End)
    assert where(page) != "Starts at 100 ms on 7 (II pad)"
    QTest.keyClick(page.findChild(QWidget, "import_place"), Qt.Key.Key_Home)
    # What was said holds.
    document.apply(edits.move_playhead(document.design, document.view, 3.0))
    page.accept()
    clip = document.design.inputs[0].clips[-1]
    assert clip.onset_s == 0.1
    assert clip_name(clip).startswith("tap.wav")


def test_each_channel_gets_a_clip_on_a_place_of_its_own_and_keeps_its_share(
    desk, qtbot, page_at, sound
):
    document = desk.document
    document.apply(edits.move_playhead(document.design, document.view, 1.0))
    page = page_at(sound)
    field = page.form.findChild(QWidget, "import_axes")
    assert field.isVisibleTo(page)
    QTest.keyClick(field, Qt.Key.Key_Down)
    qtbot.waitUntil(lambda: page.ready, timeout=60_000)
    assert page.preview.text.startswith("1 of 2")
    assert where(page) == "Starts at 1000 ms on 7 (II pad), 8 (III pad)"
    # Another signal leaves that choice.
    page.form.findChild(QWidget, "import_signal").choose("1")
    qtbot.waitUntil(lambda: page.ready, timeout=60_000)
    assert len(page.form.choices) == 2
    before, said = document.undo_stack.count(), []
    document.message.connect(said.append)
    page.accept()
    assert document.undo_stack.count() == before + 1
    assert said == [where(page)]
    tracks = document.design.inputs
    assert [track.location for track in tracks] == [7, 8]
    clips = [track.clips[-1] for track in tracks]
    assert [clip.waveform.name for clip in clips] == ["tap.wav, channel 1", "tap.wav, channel 2"]
    assert [clip.onset_s for clip in clips] == [1.0, 1.0]
    assert [clip.waveform.samples.peak for clip in clips] == pytest.approx([1.0, 0.5], rel=1e-3)
    assert document.view.selected_inputs == document.design.ids
    assert document.view.selected_clips == tuple(clip.id for clip in clips)
