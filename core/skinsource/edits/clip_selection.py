"""Which clips are selected, and where the playhead stands."""

from collections.abc import Iterable
from dataclasses import replace

from skinsource.design import Design
from skinsource.edits.edit import Edit, Refusal, refused
from skinsource.errors import InvalidInputError
from skinsource.view import View


def clips_selected(design: Design, view: View, ids: Iterable[int]) -> View:
    """The view with these clips selected, and the tracks that they are on; the last one last.

    Where there are none, the selected tracks stay.
    """
    track_ids = {clip.id: one.id for one in design.inputs for clip in one.clips}
    chosen = tuple(dict.fromkeys(id for id in ids if id in track_ids))
    if not chosen:
        return replace(view, selected_clips=())
    # The track of the last clip stands last.
    tracks = tuple(dict.fromkeys(track_ids[id] for id in reversed(chosen)))[::-1]
    return replace(view, selected_clips=chosen, selected_inputs=tracks)


def select_clips(design: Design, view: View, ids: Iterable[int]) -> Edit:
    """Select clips, the last of them the one that stands apart, and their tracks."""
    return Edit(label="Select clips", design=design, view=clips_selected(design, view, ids))


def toggle_clip(design: Design, view: View, id: int) -> Edit:
    """Add a clip to the selected ones, or take it out."""
    left = tuple(one for one in view.selected_clips if one != id)
    return select_clips(design, view, left if id in view.selected_clips else (*left, id))


def select_all_clips(design: Design, view: View) -> Edit:
    """Select every clip; the one that stood apart still does."""
    last = () if view.selected_clip is None else (view.selected_clip,)
    others = (one.id for one in design.clips if one.id not in last)
    return select_clips(design, view, (*others, *last))


def move_playhead(design: Design, view: View, time_s: float) -> Edit | Refusal:
    """Put the playhead somewhere."""
    try:
        after = replace(view, playhead_s=time_s)
    except InvalidInputError as error:
        return refused(error)
    return Edit(label="Move playhead", design=design, view=after)
