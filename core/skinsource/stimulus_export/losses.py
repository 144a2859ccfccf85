"""How much of what is exported does not reach the rate at which it is written."""

from dataclasses import replace

import numpy as np

from skinsource.arrays import Floats
from skinsource.job import Stop, stop_if
from skinsource.resampling import passed
from skinsource.stimulus import Stimulus, faded, part_of_time
from skinsource.stimulus_export.options import StimulusOptions

# More is told of nothing: the stop band of `skinsource.resample`.
_MOST_DB = 140.0


def with_losses(drives: Stimulus, own: Stimulus, options: StimulusOptions, stop: Stop) -> Stimulus:
    """Return ``drives`` with the loss of each channel.

    It is the energy of the exported part of the design over what the filter leaves of it, so that
    what is cut off at an end of the part is not taken for lost.

    Parameters
    ----------
    drives, own
        As written; all of it at the rate of the design, from time 0 on.
    """
    found: dict[tuple[int, ...], float] = {}
    for row, one in enumerate(own.channels):
        stop_if(stop)
        samples = own.samples[row]
        left = passed(samples, own.sample_rate_hz, drives.sample_rate_hz)
        ring = (left.size - samples.size) // 2
        alone = own.with_samples(
            np.stack((np.pad(samples, ring), left)),
            channels=(one, one),
            start_s=-ring / own.sample_rate_hz,
        )
        found[one.inputs] = _loss_db(_exported(alone, own.duration_s, options).samples)
    # A stage may have added channels, or left some out.
    channels = tuple(replace(one, loss_db=found.get(one.inputs, 0.0)) for one in drives.channels)
    return replace(drives, channels=channels)


def _exported(stimulus: Stimulus, end_s: float, options: StimulusOptions) -> Stimulus:
    """The part that is exported, with its fades; all that rings where it is the whole."""
    fades_s = options.fade_in_s, options.fade_out_s
    if (options.from_s, options.to_s, *fades_s) == (None, None, 0.0, 0.0):
        return stimulus
    from_s = options.from_s or 0.0
    to_s = end_s if options.to_s is None else options.to_s
    # The shortest part may lie between two samples of the design.
    part = part_of_time(stimulus, from_s, max(to_s, from_s + 1.0 / stimulus.sample_rate_hz))
    return faded(part, *(min(one_s, part.duration_s) for one_s in fades_s))


def _loss_db(samples: Floats) -> float:
    """Energy of the first over that of the second, 0 dB or more."""
    before, after = np.sum(samples**2, axis=1)
    if after >= before:
        return 0.0
    return float(min(10.0 * np.log10(before / after), _MOST_DB)) if after else _MOST_DB
