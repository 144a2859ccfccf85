"""What a pen does to a clip."""

import numpy as np

from skinsource.arrays import Floats
from skinsource.design import Design
from skinsource.drawing import bounded_to_band
from skinsource.edits.edit import Edit, Refusal, place_words, refused
from skinsource.errors import InvalidInputError
from skinsource.own_limbs import facts_of
from skinsource.samples import Samples
from skinsource.view import View
from skinsource.waveforms import Drawn

_NO_BAND = Refusal(
    sentence="In which band this limb was measured is not known; import it with its band."
)


def draw_clip(
    design: Design, view: View, clip_id: int, samples: Floats, sample_rate_hz: float
) -> Edit | Refusal:
    """Let a clip play drawn samples, (n_times,), in place of its waveform; effects stay."""
    try:
        waveform = Drawn(Samples(values=samples, sample_rate_hz=sample_rate_hz))
        after = design.with_clip(clip_id, waveform=waveform)
        place = place_words(design.track_of(clip_id).location, design.limb)
    except InvalidInputError as error:
        return refused(error)
    return Edit(label=f"Draw at {place}", design=after, view=view)


def bound_clip(design: Design, view: View, clip_id: int, sample_rate_hz: float) -> Edit | Refusal:
    """Take away what of a clip's waveform lies outside the measured band; it becomes samples."""
    try:
        band_hz = facts_of(design.limb).band_hz
        if band_hz is None:
            return _NO_BAND
        drawn = design.clip(clip_id).waveform.samples(sample_rate_hz)
        bounded = bounded_to_band(drawn, sample_rate_hz, band_hz)
    except InvalidInputError as error:
        return refused(error)
    if bounded.removed == 0.0 and np.array_equal(bounded.samples, drawn):
        return Refusal(sentence="Nothing of the clip lies outside the measured band.")
    outcome = draw_clip(design, view, clip_id, bounded.samples, sample_rate_hz)
    if isinstance(outcome, Refusal):
        return outcome
    low_hz, high_hz = band_hz
    label = f"Bound to {low_hz:g}\u2013{high_hz:g} Hz, {100 * bounded.removed:.3g} % removed"
    return Edit(label=label, design=outcome.design, view=outcome.view)
