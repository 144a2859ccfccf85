"""What the clips of a fragment sound like together."""

import numpy as np

from skinsource.arrays import Floats
from skinsource.clips import Fragment, Lane
from skinsource.errors import InvalidInputError

#: What is longer is too much for a picture.
LONGEST_S = 60.0


def mixed(fragment: Fragment, sample_rate_hz: float) -> Floats:
    """Sum of all lanes, (n_times,), from the earliest onset on; muted clips are silent.

    Raises
    ------
    InvalidInputError
        It lasts longer than `LONGEST_S`, or holds something that cannot be played at this rate.
    """
    if fragment.duration_s > LONGEST_S:
        raise InvalidInputError(
            f"{fragment.duration_s:.3g} s are too long for a picture, expected at most "
            f"{LONGEST_S:g} s; place it to see it"
        )
    played = [
        (first, lane.amplitude * gain * samples)
        for lane in fragment.lanes
        for first, gain, samples in _clips(lane, sample_rate_hz)
    ]
    n = max((first + samples.size for first, samples in played), default=0)
    total = np.zeros(n)
    for first, samples in played:
        total[first : first + samples.size] += samples
    return total


def _clips(lane: Lane, sample_rate_hz: float) -> list[tuple[int, float, Floats]]:
    found = []
    for clip in lane.clips:
        if not clip.muted:
            first, samples = clip.sampled(sample_rate_hz)
            found.append((first, clip.gain, samples))
    return found
