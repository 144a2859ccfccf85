"""Fades at both ends of a stimulus."""

import numpy as np

from skinsource.arguments import real_number
from skinsource.arrays import Floats
from skinsource.stimulus.stimulus import Stimulus


def faded(stimulus: Stimulus, fade_in_s: float = 0.0, fade_out_s: float = 0.0) -> Stimulus:
    """Fade all channels that drive an actuator in and out, along half a cosine.

    The first and the last sample become 0.

    Parameters
    ----------
    stimulus
        As it would be cut off hard.
    fade_in_s, fade_out_s
        How long; 0: nothing is changed at that end.

    Raises
    ------
    InvalidInputError
        A fade is longer than the stimulus.
    """
    factor = np.ones(stimulus.n_times)
    duration_s = stimulus.duration_s
    for name, length_s, part in (
        ("fade_in_s", fade_in_s, factor),
        ("fade_out_s", fade_out_s, factor[::-1]),
    ):
        given_s = real_number(
            name,
            length_s,
            f"a time from 0 to {duration_s:g} s, the length of the stimulus",
            least=0.0,
            most=duration_s,
        )
        n = round(given_s * stimulus.sample_rate_hz)
        part[:n] *= _rise(n)
    if np.all(factor == 1.0):
        return stimulus
    samples = stimulus.samples.copy()
    samples[list(stimulus.driving)] *= factor
    return stimulus.with_samples(samples)


def _rise(n: int) -> Floats:
    """From 0 on, towards 1 at sample n, (n,)."""
    rise: Floats = 0.5 - 0.5 * np.cos(np.pi * np.arange(n) / max(n, 1))
    return rise
