"""Which channel goes to which output of a device."""

from collections.abc import Sequence

import numpy as np

from skinsource.arguments import whole_number
from skinsource.errors import InvalidInputError
from skinsource.quoting import quoted
from skinsource.stimulus.channel import Channel
from skinsource.stimulus.stimulus import Stimulus, numbered

#: Outputs of the largest device that is thought of.
MOST_OUTPUTS = 1024


def in_order(stimulus: Stimulus, outputs: Sequence[int]) -> Stimulus:
    """Return the channels in another order.

    Parameters
    ----------
    stimulus
        Channels 1, 2, 3, …
    outputs
        For each output of the device, from the first on, the number of the channel that it gets;
        0: it stays silent.

    Raises
    ------
    InvalidInputError
        A number that no channel has, a channel that is named twice, or one that is left out.
    """
    known = len(stimulus.channels)
    numbers = [whole_number("Channel map", number, 0, known) for number in outputs]
    used = [number for number in numbers if number]
    if len(numbers) > MOST_OUTPUTS or sorted(used) != list(range(1, known + 1)):
        raise InvalidInputError(
            f"Channel map is {quoted(list(outputs))}, expected each channel from 1 to {known} "
            f"once, and 0 for outputs that stay silent, at most {MOST_OUTPUTS} altogether. Say "
            "which tracks take part where a channel shall be left out."
        )
    silent = Channel(number=0, place=None, title="Silent")
    samples = np.zeros((len(numbers), stimulus.n_times))
    channels = []
    for row, number in enumerate(numbers):
        channels.append(stimulus.channels[number - 1] if number else silent)
        if number:
            samples[row] = stimulus.samples[number - 1]
    return stimulus.with_samples(samples, channels=numbered(channels))
