"""Edits that let an input be played that cannot be played, or leave it out."""

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace

import numpy as np

from skinsource.base.errors import SkinSourceError
from skinsource.design.clips import Clip
from skinsource.design.design import Design
from skinsource.design.edits.edit import Edit
from skinsource.design.edits.setup import predict_through
from skinsource.design.effects.level import BandLimit, Fade
from skinsource.design.signal_path import check_drive, drive_of_clips
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import CentredTap, Tap
from skinsource.design.waveforms.samples import Drawn
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.samples import Samples

# Longest fade that mends, and the share of a clip that it takes at most.
_LONGEST_FADE_S, _FADED_SHARE = 0.05, 0.25


def mends(design: Design, view: View, id: int) -> tuple[Edit, ...]:
    """Return edits after which nothing keeps an input from being played, the best one first.

    At most one of them changes its clips, and only if that is enough.
    """
    track = design.input(id)

    edits = []
    for label, change in _changes(design):
        # What cannot be sampled cannot be balanced either.
        with suppress(SkinSourceError):
            clips = tuple(clip if clip.muted else change(clip) for clip in track.clips)
            after = design.with_input(design.index_of(id), clips=clips)
            if clips != track.clips and _plays(after, id):
                edits.append(Edit(label=label, design=after, view=view))
                break
    muted = design.with_input(design.index_of(id), muted=True)
    edits.append(Edit(label="Mute it", design=muted, view=view))
    without = predict_through(design, view, None)
    if isinstance(without, Edit) and design.actuated is not None and _plays(without.design, id):
        edits.append(without)
    return tuple(edits)


def mend_through(design: Design, view: View, id: int) -> Edit | None:
    """Return the edit that lets the chosen actuators follow an input; None: none has to, or can."""
    if design.actuation is None or id not in design.ids:
        return None
    through = replace(design, actuation=replace(design.actuation, on=True))
    edit = mends(through, view, id)[0]
    if edit.design.input(id).muted or _plays(through, id):
        return None
    return replace(edit, design=replace(edit.design, actuation=design.actuation))


def _changes(design: Design) -> Iterator[tuple[str, Callable[[Clip], Clip]]]:
    """Yield labels of edits, and what they do to a clip; those that change least come first."""
    facts = facts_of(design.limb)

    def centred(clip: Clip) -> Clip:
        return replace(clip, waveform=CentredTap()) if isinstance(clip.waveform, Tap) else clip

    yield "Use a centred tap", centred
    if facts.band_hz is not None:
        limit = BandLimit(low_hz=facts.band_hz[0], high_hz=facts.band_hz[1])
        yield "Limit to the band", lambda clip: replace(clip, effects=(*clip.effects, limit))

    def faded(clip: Clip) -> Clip:
        fade_s = min(_LONGEST_FADE_S, _FADED_SHARE * clip.duration_s)
        return replace(clip, effects=(*clip.effects, Fade(in_s=fade_s, out_s=fade_s)))

    def balanced(clip: Clip) -> Clip:
        """Take away a slow bump with the velocity that the samples leave."""
        rate_hz = facts.sample_rate_hz
        samples = clip.waveform.samples(rate_hz)
        bump = np.hanning(samples.size + 2)[1:-1]
        left = samples - bump * (samples.sum() / bump.sum())
        return replace(clip, waveform=Drawn(Samples(values=left, sample_rate_hz=rate_hz)))

    yield "Fade in and out", faded
    yield "Balance the samples", balanced


def _plays(design: Design, id: int) -> bool:
    track, facts = design.input(id), facts_of(design.limb)
    rate_hz, place = facts.sample_rate_hz, track.location
    try:
        _, drive = drive_of_clips(track.clips, track.gain_curve, rate_hz, place)
        if design.actuated is not None:
            design.actuated.at(place)
        check_drive(design.actuated, drive, rate_hz, facts.band_hz, place)
    except SkinSourceError:
        return False
    return place <= facts.n_inputs
