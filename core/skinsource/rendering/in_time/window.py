"""Which part of a long response is kept in time: two blocks, and what is looked at beyond."""

from math import floor

#: A response that is transformed at once is shorter at 1300 Hz; of a longer one, two blocks of
#: this length are kept.
BLOCK_S = 12.0
# What is looked at before and after: the reach of interpolation, half of a sliding window, and the
# pre-trigger delay.
_BEYOND_S = 1.0

#: First sample, and the one after the last.
Window = tuple[int, int]


def block_of(time_s: float) -> int:
    """Number of the block in which a time lies, from 0."""
    return max(floor(time_s / BLOCK_S), 0)


def window_of(block: int, n_times: int, sample_rate_hz: float) -> Window:
    """Samples that are kept while one looks at a block: it, the next one, and a second around."""
    first = floor((block * BLOCK_S - _BEYOND_S) * sample_rate_hz)
    end = floor(((block + 2) * BLOCK_S + _BEYOND_S) * sample_rate_hz)
    first = min(max(first, 0), n_times)
    return first, max(min(end, n_times), first)
