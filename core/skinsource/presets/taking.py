"""Making presets of what is open."""

from dataclasses import replace

import numpy as np

from skinsource.clips import Clip, Fragment
from skinsource.clips.clip import MAX_EFFECTS
from skinsource.design import Design, Input, audible_indices
from skinsource.edits.fragments import fragment_of
from skinsource.effects import Envelope
from skinsource.fields import Breakpoint
from skinsource.waveforms import Layers


def whole_design(design: Design) -> Fragment | None:
    """All clips of a design as they are heard; None where there are none.

    A fragment has no mute, no solo and no gain curve of tracks: clips of silent tracks become
    muted, and a gain curve becomes an `Envelope` of each clip below it.
    """
    heard = audible_indices(design.inputs)
    inputs = tuple(
        replace(one, clips=tuple(_alone(one, clip, index in heard) for clip in one.clips))
        for index, one in enumerate(design.inputs)
    )
    return fragment_of(replace(design, inputs=inputs), (clip.id for clip in design.clips))


def _alone(one: Input, clip: Clip, heard: bool) -> Clip:
    """The clip with what its track does to it."""
    if one.gain_curve and len(clip.effects) == MAX_EFFECTS:
        # There is no room for another one but around it.
        inside = replace(clip, onset_s=0.0, gain=1.0, muted=False, id=0)
        clip = replace(clip, waveform=Layers((inside,)), effects=())
    effects = clip.effects
    if one.gain_curve:
        effects = (*effects, Envelope(_points(one.gain_curve, clip)))
    if effects is clip.effects and (heard or clip.muted):
        return clip
    return replace(clip, effects=effects, muted=clip.muted or not heard)


def _points(curve: tuple[tuple[float, float], ...], clip: Clip) -> tuple[Breakpoint, ...]:
    """The gain curve over the own time of a clip: as far as the first point behind its end."""
    own: list[Breakpoint] = [(time_s - clip.onset_s, gain, "straight") for time_s, gain in curve]
    before = sum(point[0] <= 0.0 for point in own)
    behind = next((k for k, point in enumerate(own) if point[0] >= clip.duration_s), len(own))
    whole = Envelope(tuple((time_s, gain, "straight") for time_s, gain in curve))
    start = float(whole.values_at(np.array([clip.onset_s]))[0])
    return ((0.0, start, "straight"), *own[before : behind + 1])
