"""Where a recording goes when one is selected."""

from skinsource.design import edits
from skinsource_gui.pages import actions


def test_a_recording_goes_in_place_of_what_stands_for_one_and_of_another_when_that_is_said(
    desk, page_at, sound
):
    document = desk.document
    track = document.design.inputs[0]
    document.apply(
        edits.change_kind(document.design, document.view, (track.id,), "Recording"), None
    )
    clip = document.design.inputs[0].clips[0]
    document.apply(edits.select_clips(document.design, document.view, (clip.id,)), None)
    first = actions.options(document.design, document.view, None)[0]
    assert first[0] == f"clip {clip.id}"
    assert first[1].startswith("In place of the recording on input 1, at ")
    page_at(sound).accept()
    (now,) = document.design.inputs[0].clips
    assert now.waveform.name == "tap.wav, channel 1"
    assert (now.id, now.onset_s) == (clip.id, clip.onset_s)
    again = [name for name, _ in actions.options(document.design, document.view, None)]
    assert again[:2] == [f"track {track.id}", f"clip {clip.id}"]


def test_a_recording_whose_place_went_while_its_page_was_open_is_refused(desk, page_at, sound):
    document = desk.document
    track = document.design.inputs[0]
    document.apply(
        edits.change_kind(document.design, document.view, (track.id,), "Recording"), None
    )
    clip = document.design.inputs[0].clips[0]
    document.apply(edits.select_clips(document.design, document.view, (clip.id,)), None)
    page, messages = page_at(sound), []
    document.refused.connect(messages.append)
    document.apply(edits.remove_clips(document.design, document.view, (clip.id,)), None)
    without = document.design
    page.accept()
    assert messages == ["That recording is no longer there; import it to another place."]
    assert document.design == without
