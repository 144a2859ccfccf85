"""Whether a stimulus begins or ends hard, in words."""

from collections.abc import Sequence
from typing import Literal

import numpy as np

from skinsource.arrays import Floats
from skinsource.stimulus import Stimulus
from skinsource.stimulus.stimulus import peaks
from skinsource.stimulus_export.options import StimulusOptions

#: An end of a stimulus.
Ends = Literal["begin", "end"]
#: First or last sample, in parts of the peak of its channel, above which it is said.
LARGEST_EDGE = 0.01
#: Time before what sounds in which it may ring where the rate is changed; see `resample`.
RINGS_S = 0.1


def cut_ends(options: StimulusOptions) -> tuple[Ends, ...]:
    """At which ends a part is cut out; one that names its end only begins at time 0."""
    if options.to_s is not None:
        return ("begin", "end")
    return () if options.from_s is None else ("begin",)


def edge_words(stimuli: Sequence[Stimulus], cut: Sequence[Ends] = ()) -> str:
    """Return what is said of channels whose first or last sample is above 1 % of their peak.

    Parameters
    ----------
    stimuli
        Of one export, all from the same time on; what drives no actuator is left out.
    cut
        At which ends a part of the design was cut out.
    """
    if not stimuli:
        return ""
    found = []
    resampled = any(one.sample_rate_hz != one.own_rate_hz for one in stimuli)
    if said := _said(stimuli, 0, "begin"):
        if "begin" in cut:
            said += ": what lies before that part is cut off. A fade-in softens it."
        elif resampled and stimuli[0].start_s >= 0.0:
            said += f": what lies before time 0 is cut off. A lead-in of {RINGS_S:g} s keeps it."
        elif resampled:
            said += ": what rings before is cut off. A longer lead-in keeps it."
        else:
            said += ". A lead-in puts silence before it."
        found.append(said)
    if said := _said(stimuli, -1, "end"):
        what = "what follows is cut off. " if resampled or "end" in cut else ""
        found.append(f"{said}{': ' if what else '. '}{what}A fade-out softens it.")
    return " ".join(found)


def _said(stimuli: Sequence[Stimulus], sample: int, verb: Ends) -> str:
    """Which channels begin or end hard, and how much so, without a full stop; "": none."""
    hard = [
        (channel.number, part)
        for one in stimuli
        for channel, part in zip(one.channels, _parts(one, sample), strict=True)
        if channel.place is not None and part > LARGEST_EDGE
    ]
    if not hard:
        return ""
    percent = 100.0 * max(part for _, part in hard)
    shown = f"{percent:.0f}" if percent >= 9.95 else f"{percent:.1f}"
    if len(hard) == 1:
        return f"Channel {hard[0][0]} {verb}s at {shown} % of its peak"
    return f"{len(hard)} channels {verb} at up to {shown} % of their peaks"


def _parts(stimulus: Stimulus, sample: int) -> Floats:
    """A sample of each channel in parts of its peak, (n_channels,); 0 of silence."""
    largest = peaks(stimulus.samples)
    edge = np.abs(stimulus.samples[:, sample])
    return np.divide(edge, largest, out=np.zeros_like(largest), where=largest > 0.0)
