"""Placing a waveform that was made elsewhere: a recording, a preset."""

from dataclasses import replace

from skinsource.design import MAX_INPUTS, Design, track
from skinsource.edits.edit import Edit, Refusal, place_words, refused
from skinsource.errors import InvalidInputError
from skinsource.view import View
from skinsource.waveforms import Waveform


def place_waveform(
    design: Design, view: View, location: int, waveform: Waveform, onset_s: float = 0.0
) -> Edit | Refusal:
    """Add an input at a place that plays ``waveform``, with amplitude 1, and select it."""
    if len(design.inputs) >= MAX_INPUTS:
        return Refusal(sentence=f"A design holds at most {MAX_INPUTS} inputs; remove one first.")
    try:
        after = design.adding(track(location, waveform, onset_s=onset_s))
    except InvalidInputError as error:
        return refused(error)
    return Edit(
        label=f"Place {waveform.title.lower()} at {place_words(location, design.limb)}",
        design=after,
        view=replace(view, selected_inputs=after.ids[-1:], selected_clips=()),
    )
