"""A channel that tells other devices when the stimulus begins."""

from math import ceil

import numpy as np

from skinsource.arguments import real_number
from skinsource.sampling import NEAR
from skinsource.stimulus.channel import Channel
from skinsource.stimulus.stimulus import Stimulus

#: Long enough for a recorder at 1 kHz to see it ten times.
PULSE_S = 0.01


def with_sync(stimulus: Stimulus, pulse_s: float = PULSE_S, at_s: float = 0.0) -> Stimulus:
    """Add a last channel: a pulse at full scale from a time of the design on.

    Where the stimulus begins later than that, the pulse begins with it; where it ends before the
    pulse does, the pulse ends with it.  Its samples count in parts of full scale, whatever the
    other channels are scaled with.

    Parameters
    ----------
    stimulus
        With its lead-in, if it has one: that is not marked.
    pulse_s
        How long the pulse is.
    at_s
        When it begins.
    """
    length_s = real_number("pulse_s", pulse_s, "a time from 0.0001 to 10 s", least=1e-4, most=10.0)
    first = max(ceil((at_s - stimulus.start_s) * stimulus.sample_rate_hz - NEAR), 0)
    pulse = np.zeros((1, stimulus.n_times))
    pulse[0, first : first + max(round(length_s * stimulus.sample_rate_hz), 1)] = 1.0
    channel = Channel(number=len(stimulus.channels) + 1, place=None, title="Sync")
    return stimulus.with_samples(
        np.concatenate((stimulus.samples, pulse)), channels=(*stimulus.channels, channel)
    )
