"""When a stimulus begins and ends."""

from math import ceil

import numpy as np

from skinsource.arguments import real_number
from skinsource.errors import InvalidInputError
from skinsource.sampling import NEAR
from skinsource.stimulus.stimulus import Stimulus

#: Longest silence that is put before a stimulus.
LONGEST_LEAD_IN_S = 60.0


def part_of_time(stimulus: Stimulus, from_s: float, to_s: float) -> Stimulus:
    """Return the samples from one time of the design up to, not including, another.

    What sounds at these times is cut off hard; see `faded`.  Where the stimulus ends earlier,
    silence follows.

    Raises
    ------
    InvalidInputError
        The times are not in order, or no sample lies between them.
    """
    begin_s = real_number("from_s", from_s, "a time of the design from 0 on", least=0.0)
    end_s = real_number("to_s", to_s, f"a time after from_s, {begin_s:g} s", least=begin_s)
    first, end = (
        ceil((time_s - stimulus.start_s) * stimulus.sample_rate_hz - NEAR)
        for time_s in (begin_s, end_s)
    )
    first = max(first, 0)
    if end <= first:
        raise InvalidInputError(
            f"to_s is {end_s:g} and from_s is {begin_s:g}: no sample lies between them, expected "
            "at least one. Take a longer part."
        )
    found = np.zeros((len(stimulus.channels), end - first))
    inside = stimulus.samples[:, first:end]
    found[:, : inside.shape[1]] = inside
    return stimulus.with_samples(found, start_s=stimulus.start_s + first / stimulus.sample_rate_hz)


def with_lead_in(stimulus: Stimulus, silence_s: float) -> Stimulus:
    """Put silence before a stimulus, rounded up to whole samples."""
    n = lead_in_samples(silence_s, stimulus.sample_rate_hz)
    if not n:
        return stimulus
    found = np.zeros((len(stimulus.channels), n + stimulus.n_times))
    found[:, n:] = stimulus.samples
    return stimulus.with_samples(found, start_s=stimulus.start_s - n / stimulus.sample_rate_hz)


def lead_in_samples(length_s: float, sample_rate_hz: float) -> int:
    """Return how many samples a lead-in has: rounded up.

    Raises
    ------
    InvalidInputError
        It is negative, or longer than `LONGEST_LEAD_IN_S`.
    """
    length_s = real_number(
        "lead_in_s",
        length_s,
        f"a time from 0 to {LONGEST_LEAD_IN_S:g} s",
        least=0.0,
        most=LONGEST_LEAD_IN_S,
    )
    return ceil(length_s * sample_rate_hz - NEAR)
