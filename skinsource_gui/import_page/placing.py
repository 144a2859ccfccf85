"""Where a recording goes, in words and as an edit."""

from dataclasses import replace

from skinsource.design import edits
from skinsource.design.design import Design, Input
from skinsource.design.edits import Edit, Refusal
from skinsource.design.edits.edit import clip_of, place_words
from skinsource.design.edits.inputs import usual_location
from skinsource.design.view import View
from skinsource.design.waveforms import Recording
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.widgets.drop_place import DropPlace

# The page stays open while its design is edited.
_GONE = Refusal(sentence="That recording is no longer there; import it to another place.")


def options(design: Design, view: View, place: DropPlace | None) -> tuple[tuple[str, str], ...]:
    """Name and words of each place, the likeliest one first."""
    found = [_track(design, one.id) for one in design.inputs if one.id in _tracks(view, place)]
    first = usual_location(design.limb)
    if place is not None and place.location is not None:
        first = place.location
    elif view.selected_input in design.ids:
        first = design.input(view.selected_input).location
    locations = [first, *(k for k in range(1, facts_of(design.limb).n_inputs + 1) if k != first)]
    new = [(f"new {k}", f"A new input at {place_words(k, design.limb)}") for k in locations]
    by_place = place is not None and place.location is not None and place.input_id is None
    if place is not None:
        return (*new, *found) if by_place else (*found, *new)
    instead = _instead(design, view)
    if instead is None:
        return (*found, *new)
    option, stands_in = instead
    return (option, *found, *new) if stands_in else (*found, option, *new)


def _instead(design: Design, view: View) -> tuple[tuple[str, str], bool] | None:
    """In place of the selected recording; and whether that only stands for one to be chosen."""
    if view.selected_input not in design.ids:
        return None
    one = design.input(view.selected_input)
    clip = clip_of(one, view)
    if clip is None or not isinstance(clip.waveform, Recording):
        return None
    where = f"input {design.index_of(one.id) + 1}, at {place_words(one.location, design.limb)}"
    # Samples without a name were taken over from another kind of waveform.
    return (f"clip {clip.id}", f"In place of the recording on {where}"), not clip.waveform.name


def _tracks(view: View, place: DropPlace | None) -> set[int]:
    dropped = {place.input_id} if place and place.input_id is not None else set()
    return dropped or set(view.selected_inputs[-1:])


def _holds(one: Input, clip_id: int) -> bool:
    return any(clip.id == clip_id for clip in one.clips)


def _track(design: Design, id: int) -> tuple[str, str]:
    where = place_words(design.input(id).location, design.limb)
    return f"track {id}", f"A clip on input {design.index_of(id) + 1}, at {where}"


def placed(
    design: Design, view: View, option: str, onset_s: float, recording: Recording
) -> Edit | Refusal:
    """The edit that puts ``recording`` where ``option`` says."""
    what, _, number = option.partition(" ")
    if what == "clip":
        one = next((one for one in design.inputs if _holds(one, int(number))), None)
        if one is None:
            return _GONE
        chosen = replace(view, selected_inputs=(one.id,), selected_clips=(int(number),))
        return edits.change_waveform(design, chosen, (one.id,), recording)
    if what == "track":
        return edits.add_clip(design, view, int(number), onset_s, recording)
    return edits.place_waveform(design, view, int(number), recording, onset_s)
