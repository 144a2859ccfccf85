"""What of a design can be kept as a preset."""

from dataclasses import dataclass

from skinsource.base.work import counted
from skinsource.design import edits
from skinsource.design.clips import Fragment
from skinsource.design.design import Design
from skinsource.design.presets.presets import whole_design
from skinsource.design.view import View


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """Clips, what they are called in the list of choices, and a name to begin with."""

    words: str
    name: str
    fragment: Fragment


def choices(design: Design, view: View) -> tuple[Choice, ...]:
    """Selected clips, all clips of the selected tracks, the whole design; each once."""
    tracks = [one for one in design.inputs if one.id in view.selected_inputs]
    on_tracks = tuple(clip.id for one in tracks for clip in one.clips)
    found: list[Choice] = []
    for words, ids in (
        ("Selected", view.selected_clips),
        ("On the selected tracks" if len(tracks) > 1 else "On the selected track", on_tracks),
    ):
        fragment = edits.fragment_of(design, ids)
        if fragment is not None:
            found.append(_choice(words, _name(fragment), fragment))
    everything = whole_design(design)
    if everything is not None:
        found.append(_choice("The whole design", design.title or _name(everything), everything))
    once: list[Choice] = []
    for one in found:
        if all(one.fragment != other.fragment for other in once):
            once.append(one)
    return tuple(once)


def _choice(words: str, name: str, fragment: Fragment) -> Choice:
    n = sum(len(lane.clips) for lane in fragment.lanes)
    clips = counted(n, "clip")
    if len(fragment.lanes) > 1:
        clips += f" on {len(fragment.lanes)} tracks"
    return Choice(words=f"{words}: {clips}", name=name[:100], fragment=fragment)


def _name(fragment: Fragment) -> str:
    first = fragment.lanes[0].clips[0]
    return first.label.strip() or first.waveform.title
