"""The page of motions with as much as fits a design."""

from PySide6.QtCore import QObject

from skinsource.design.design import Design
from skinsource.design.effects import playing
from skinsource_gui.pages.motion import Draft
from skinsource_gui.plots import preview


def test_a_motion_that_repeats_one_long_burst_draws_it_once(qtbot, monkeypatch):
    drawn = []
    played = playing.played
    monkeypatch.setattr(
        preview, "played", lambda *arguments: (drawn.append(arguments), played(*arguments))[1]
    )
    owner = QObject()
    draft = Draft(Design(limb="synthetic-1"), 0.0, owner)
    draft.change_kind("Alternation")
    draft.change_field("rounds", 200)
    draft.change_waveform_field("duration_s", 60.0)
    drawn.clear()
    lanes = draft.lanes()
    clips = [clip for lane in lanes for clip in lane.clips]
    assert len(clips) == 600
    assert len(drawn) == 1
    assert len({id(clip.samples) for clip in clips}) == 1
