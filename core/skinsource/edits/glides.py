"""Curves of a glide."""

from dataclasses import replace

from skinsource.design import Design
from skinsource.edits.edit import Edit, Refusal, changed, refused
from skinsource.errors import InvalidInputError
from skinsource.synthesis.glide_curves import Column, Curve, with_curve
from skinsource.view import View
from skinsource.waveforms import Glide

_NO_GLIDE = Refusal(sentence="The clip does not play a glide; choose that waveform first.")


def set_glide_curve(
    design: Design, view: View, clip_id: int, column: Column, curve: Curve
) -> Edit | Refusal:
    """Give the glide of a clip another curve of frequency, or of amplitude; the other one stays.

    Parameters
    ----------
    clip_id
        The clip, which plays a `Glide`.
    column
        ``"frequency"`` or ``"amplitude"``.
    curve
        (time, value), times never falling; the last one ends the glide.
    """
    try:
        clip, track = design.clip(clip_id), design.track_of(clip_id)
        glide = clip.waveform
        if not isinstance(glide, Glide) or column not in ("frequency", "amplitude"):
            return _NO_GLIDE
        waveform = replace(glide, points=with_curve(glide.points, column, curve))
    except InvalidInputError as error:
        return refused(error)
    return changed(
        design, view, f"Draw {column} of", {track.id: {}}, {clip_id: {"waveform": waveform}}
    )
