"""Copying pieces of a design, and putting them in: here, on other tracks, in another studio."""

from collections.abc import Iterable
from dataclasses import replace

from skinsource import codec
from skinsource.clips import Clip, Fragment, Lane
from skinsource.codec import text
from skinsource.counting import counted
from skinsource.design import MAX_INPUTS, Design, Input
from skinsource.edits.clips import NO_CLIP, clips_words, present_clips, short, with_new_clips
from skinsource.edits.edit import Edit, Refusal, refused
from skinsource.errors import InvalidInputError
from skinsource.fields import Address
from skinsource.view import View

#: What the text of a fragment says that it is.
FORMAT = "skinsource clips"


def fragment_of(design: Design, ids: Iterable[int]) -> Fragment | None:
    """The clips with these ids as they lie to each other; None where there are none."""
    chosen = {one.id for one in present_clips(design, ids)}
    tracks = [
        (place, one, [clip for clip in one.clips if clip.id in chosen])
        for place, one in enumerate(design.inputs)
    ]
    tracks = [entry for entry in tracks if entry[2]]
    if not tracks:
        return None
    start_s = min(clip.onset_s for *_, clips in tracks for clip in clips)
    return Fragment(
        lanes=tuple(
            Lane(
                location=one.location,
                amplitude=one.amplitude,
                offset=place - tracks[0][0],
                clips=tuple(
                    replace(clip, onset_s=short(clip.onset_s - start_s), id=0) for clip in clips
                ),
            )
            for place, one, clips in tracks
        )
    )


def cut_clips(design: Design, view: View, ids: Iterable[int]) -> Edit | Refusal:
    """Remove clips that were copied as a fragment; no other clip is selected."""
    chosen = present_clips(design, ids)
    if not chosen:
        return NO_CLIP
    gone = {one.id for one in chosen}
    inputs = tuple(
        replace(one, clips=left)
        if len(left := tuple(c for c in one.clips if c.id not in gone)) < len(one.clips)
        else one
        for one in design.inputs
    )
    return Edit(
        label=f"Cut {clips_words(design, chosen)}",
        design=replace(design, inputs=inputs),
        view=replace(view, selected_clips=()),
    )


def paste_fragment(design: Design, view: View, fragment: Fragment, at_s: float) -> Edit | Refusal:
    """Put a fragment in from a time on: its first lane on the selected track, the others below.

    Of several selected tracks the uppermost counts: what was copied from them goes back to them.
    Lanes for which there is no track below get a new one, at the place that they came from; and so
    do all of them where no track is selected.  How many and when is told: a clip that lies exactly
    on its original cannot be seen.
    """
    count = sum(len(lane.clips) for lane in fragment.lanes)
    found = _put_in(
        design, view, fragment, at_s, f"Paste {_words(count)}", _selected_place(design, view)
    )
    if isinstance(found, Refusal):
        return found
    over = ", on top of what was copied" if _lies_on_its_like(found.design, design) else ""
    return replace(found, said=f"{counted(count, 'clip')} pasted at {at_s * 1e3:.6g} ms{over}")


def _lies_on_its_like(after: Design, before: Design) -> bool:
    """Whether a clip that is new has an equal one on its track, at the same time."""
    old = {one.id for one in before.clips}
    for track in after.inputs:
        # Of thousands of clips hardly any two begin together.
        there: dict[float, list[Clip]] = {}
        for one in track.clips:
            if one.id in old:
                there.setdefault(one.onset_s, []).append(one)
        new = (one for one in track.clips if one.id not in old)
        if any(
            replace(one, id=like.id) == like for one in new for like in there.get(one.onset_s, ())
        ):
            return True
    return False


def place_fragment(
    design: Design,
    view: View,
    fragment: Fragment,
    name: str,
    at_s: float | None = None,
    input_id: int | None = None,
    location: int | None = None,
) -> Edit | Refusal:
    """Put a fragment of the library in, and select its clips.

    Parameters
    ----------
    design, view
        What is open.
    fragment
        Clips.
    name
        What the fragment is called.
    at_s
        From when on; None: from the playhead on.
    input_id
        The track that takes its first lane; those below take the others.  None: the selected one,
        of several the uppermost.
    location
        Place of a new track for its first lane; the others get new ones too, at the places that
        they came from.  It goes before ``input_id``.
    """
    at_s = view.playhead_s if at_s is None else at_s
    words = f"Place {name}"
    if location is not None:
        try:
            first, *others = fragment.lanes
            fragment = replace(fragment, lanes=(replace(first, location=location), *others))
        except InvalidInputError as error:
            return refused(error)
        return _put_in(design, view, fragment, at_s, words, len(design.inputs))
    if input_id is None:
        return _put_in(design, view, fragment, at_s, words, _selected_place(design, view))
    if input_id not in design.ids:
        return Refusal(sentence="That track is no longer there; choose another one.")
    return _put_in(design, view, fragment, at_s, words, design.index_of(input_id))


def _selected_place(design: Design, view: View) -> int:
    """Where in the list the uppermost selected track is; behind the last one where none is."""
    chosen = (design.index_of(id) for id in view.selected_inputs if id in design.ids)
    return min(chosen, default=len(design.inputs))


def _put_in(
    design: Design, view: View, fragment: Fragment, at_s: float, words: str, place: int
) -> Edit | Refusal:
    """Put a fragment on the tracks from ``place`` on, and on new ones behind the last."""
    after = design
    new: list[tuple[int, Clip]] = []
    try:
        for lane in fragment.lanes:
            if place + lane.offset < len(design.inputs):
                track_id = design.inputs[place + lane.offset].id
            elif len(after.inputs) < MAX_INPUTS:
                after = after.adding(Input(location=lane.location, amplitude=lane.amplitude))
                track_id = after.ids[-1]
            else:
                return Refusal(sentence=f"A design holds at most {MAX_INPUTS} inputs.")
            new += [
                (track_id, replace(one, onset_s=short(at_s + one.onset_s))) for one in lane.clips
            ]
    except (InvalidInputError, TypeError) as error:
        return refused(InvalidInputError(str(error)))
    return with_new_clips(after, view, words, new)


def fragment_text(fragment: Fragment) -> str:
    """The fragment as a text for the clipboard; see `skinsource.codec.text`."""
    return text.to_text(codec.encode(fragment), FORMAT)


def fragment_from(words: str) -> Fragment:
    """The fragment that `fragment_text` wrote.

    Raises
    ------
    FileFormatError
        The text is something else, or damaged.
    """
    found: Fragment = codec.decode(text.from_text(words, FORMAT), (Fragment,), Address())
    return found


def _words(count: int) -> str:
    return "clip" if count == 1 else f"{count} clips"
