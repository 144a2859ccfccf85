"""The page that makes up a motion: clicked or typed path, numbers, preview, one step."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QLineEdit, QPushButton

from skinsource.design import edits
from skinsource.design.motions import MOTIONS, ApparentMotion, TapSequence
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.pages.motion import MotionPage, PathLayer


@pytest.fixture
def page(desk, qtbot):
    page = desk.show_motion()
    qtbot.waitExposed(page)
    return page


def button(page: MotionPage, name: str) -> QPushButton:
    return page.findChild(QPushButton, name)


def choose(page: MotionPage, name: str) -> None:
    """Choose a kind of motion in the list."""
    box = page.fields.cells[0].field
    box.setCurrentIndex(box.findData(name))
    box.activated.emit(box.currentIndex())


def choose_waveform(page: MotionPage, name: str) -> None:
    cell = page.fields.cells[1]
    assert cell.name == "kind"
    cell.edited.emit("kind", name, None)


def click(page: MotionPage, *places: int) -> None:
    for place in places:
        at = page.hand.site_centre(place)
        QTest.mouseClick(page.hand, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, at)


def type_path(page: MotionPage, text: str) -> None:
    field = page.findChild(QLineEdit, "path_field")
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, text)


def field_of(page: MotionPage, name: str):
    return next(cell for cell in page.fields.cells if cell.name == name)


def test_a_motion_on_clicked_places_is_added_in_one_step(desk, page):
    before = desk.document.design
    choose(page, "TapSequence")
    button(page, "clear_path").click()
    click(page, 7, 12, 17)
    assert page.path_row.field.text() == "7, 12, 17"
    assert page.hand.findChild(PathLayer).size() == page.hand.size()
    assert desk.document.design is before
    assert desk.document.undo_stack.count() == 0
    button(page, "add_motion").click()
    design = desk.document.design
    assert design.inputs[:1] == before.inputs
    assert [track.location for track in design.inputs[1:]] == [7, 12, 17]
    assert [len(track.clips) for track in design.inputs[1:]] == [3, 3, 3]
    assert desk.document.view.selected_inputs == design.ids[1:]
    assert desk.document.undo_stack.count() == 1
    desk.document.undo_stack.undo()
    assert desk.document.design == before


def test_the_path_can_be_made_with_keys_alone(page):
    button(page, "clear_path").click()
    page.hand.setFocus(Qt.FocusReason.TabFocusReason)
    QTest.keyClick(page.hand, Qt.Key.Key_7)
    QTest.keyClick(page.hand, Qt.Key.Key_Return)
    page.hand.findChild(object, "typing").timeout.emit()
    QTest.keyClick(page.hand, Qt.Key.Key_9)
    QTest.keyClick(page.hand, Qt.Key.Key_Space)
    assert page.draft.path == (7, 9)
    QTest.keyClick(page.hand, Qt.Key.Key_Backspace)
    assert page.draft.path == (7,)


def test_the_path_can_be_typed_and_what_is_none_is_said(page):
    type_path(page, "3, 8, 13")
    assert page.draft.motion.path == (3, 8, 13)
    assert page.path_row.field.text() == "3, 8, 13"
    type_path(page, "3, x")
    assert "'x'" in page.strip.message
    assert not button(page, "add_motion").isEnabled()
    QTest.keyClick(page.path_row.field, Qt.Key.Key_Tab)
    assert page.path_row.field.text() == ", ".join(map(str, page.draft.path))
    type_path(page, "3 99")
    assert not button(page, "add_motion").isEnabled()
    type_path(page, "3 4")
    assert button(page, "add_motion").isEnabled()
    assert page.strip.message == ""


@pytest.mark.parametrize("kind", MOTIONS)
def test_the_preview_shows_the_tracks_that_are_added(desk, page, kind):
    choose(page, kind.__name__)
    lanes = page.strip.lanes
    summary = page.findChild(QLabel, "motion_summary")
    assert summary.text() == page.draft.motion.summary
    about = page.findChild(QLabel, "motion_about").text()
    assert all(part in about for part in ("Law", "Source", "On the palm"))
    page.grab()
    button(page, "add_motion").click()
    added = desk.document.design.inputs[1:]
    assert [(track.location, track.colour) for track in added] == [
        (lane.place, lane.colour) for lane in lanes
    ]
    for repeated, lane in zip(added, lanes, strict=True):
        starts = [(clip.onset_s, clip.duration_s) for clip in repeated.clips]
        assert starts == [(clip.start_s, clip.duration_s) for clip in lane.clips]


def test_numbers_of_motion_and_waveform_are_taken_over(page):
    choose(page, "ApparentMotion")
    field_of(page, "duration_s").edited.emit("duration_s", 0.05, None)
    assert page.draft.motion == ApparentMotion(waveform=Tone(200.0, duration_s=0.05))
    assert "63.3 ms" in page.findChild(QLabel, "motion_summary").text()
    field_of(page, "onset_s").edited.emit("onset_s", 0.5, None)
    assert page.strip.lanes[0].clips[0].start_s == 0.5


def test_what_does_not_go_together_stays_and_is_said(page):
    choose(page, "ApparentMotion")
    choose_waveform(page, "PulseTrain")
    field_of(page, "rate_hz").edited.emit("rate_hz", 400.0, None)
    assert page.draft.motion.waveform.rate_hz == 40.0
    assert "pulse_s" in field_of(page, "rate_hz").note


def test_other_kinds_follow_the_path_and_a_phantom_gives_it_back(page):
    choose(page, "TapSequence")
    page.draft.change_path((7, 12, 17))
    choose(page, "Phantom")
    assert page.draft.motion.path == (7, 12)
    click(page, 20)
    assert "takes 2 places" in page.strip.message
    button(page, "remove_last").click()
    choose(page, "TravellingPhase")
    assert page.draft.motion.path == (7, 12)
    page.draft.change_path((7, 12, 17))
    choose(page, "Phantom")
    choose(page, "TapSequence")
    assert page.draft.motion.path == (7, 12, 17)
    assert isinstance(page.draft.motion, TapSequence)


def test_what_a_limb_cannot_play_is_said_before_it_is_added(page):
    choose(page, "ApparentMotion")
    field_of(page, "frequency_hz").edited.emit("frequency_hz", 700.0, None)
    assert "frequency_hz is 700" in page.strip.message
    assert not button(page, "add_motion").isEnabled()


def test_a_motion_opens_again_and_is_changed_in_one_step(desk, page):
    page.draft.change_path((16, 18, 20))
    button(page, "add_motion").click()
    document = desk.document
    before, steps = document.design, document.undo_stack.count()
    again = desk.show_motion()
    assert again.draft.motion == before.motions[0].motion
    assert button(again, "add_motion").text() == "Change"
    field_of(again, "overlap").edited.emit("overlap", 0.25, None)
    again.draft.change_path((16, 18, 5))
    assert again.strip.message == ""
    assert [lane.place for lane in again.strip.lanes] == [16, 18, 5]
    button(again, "add_motion").click()
    assert document.undo_stack.count() == steps + 1
    (group,) = document.design.motions
    assert (group.motion.overlap, group.motion.path) == (0.25, (16, 18, 5))
    assert [track.location for track in document.design.inputs[1:]] == [16, 18, 5]
    document.undo_stack.undo()
    assert document.design == before


def test_a_motion_that_is_edited_by_hand_becomes_single_clips_until_that_is_undone(desk, page):
    button(page, "add_motion").click()
    document, messages = desk.document, []
    document.message.connect(messages.append)
    before = document.design
    for _ in range(2):
        document.apply(
            edits.move_clips(document.design, document.view, before.motions[0].clips[:1], 0.1)
        )
    assert document.design.motions == ()
    assert len(messages) == 1
    document.undo_stack.undo()
    document.undo_stack.undo()
    assert document.design.motions == before.motions
    assert button(desk.show_motion(), "add_motion").text() == "Change"
