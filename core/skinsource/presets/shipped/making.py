"""Short ways to write presets down."""

from collections.abc import Iterable

from skinsource.clips import Clip, Fragment, Lane
from skinsource.design import Design, Input
from skinsource.edits.fragments import fragment_of
from skinsource.presets.preset import Preset, tags_of
from skinsource.waveforms import Waveform

#: What stands as source where no publication gives the numbers.
OURS = "Our choice."
#: The pad of digit II, where the first window has its input too; where presets of one track go
#: when no track is selected.
PAD_OF_II = 7


def preset(
    name: str, tags: str, description: str, *clips: Clip | Waveform, source: str = OURS
) -> Preset:
    """Return a preset of one track."""
    lane = Lane(location=PAD_OF_II, clips=tuple(map(_as_clip, clips)))
    return Preset(
        name=name,
        tags=tags_of(tags),
        source=source,
        description=description,
        fragment=Fragment(lanes=(lane,)),
    )


def preset_of_tracks(
    name: str, tags: str, description: str, tracks: Iterable[Input], source: str = OURS
) -> Preset:
    """Return a preset of several tracks."""
    design = Design(limb="", inputs=tuple(tracks))
    fragment = fragment_of(design, (clip.id for clip in design.clips))
    if fragment is None:
        raise ValueError(f"{name} has no clips")
    return Preset(
        name=name, tags=tags_of(tags), source=source, description=description, fragment=fragment
    )


def _as_clip(one: Clip | Waveform) -> Clip:
    return one if isinstance(one, Clip) else Clip(waveform=one)
