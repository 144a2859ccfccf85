"""Which windows of a response belong to its stimulus."""

from dataclasses import dataclass
from math import ceil, floor

from skinsource.arguments import positive_number, real_number, whole_number
from skinsource.errors import InvalidInputError
from skinsource.limb import PRE_TRIGGER_DELAY_S
from skinsource.sampling import NEAR

#: Windows that are looked at together.
MOST_WINDOWS = 60
_MOST_SAMPLES = 2**53


@dataclass(frozen=True, slots=True, kw_only=True)
class Windows:
    """Windows that follow each other, as `skinsource.windowed_rms` cuts them.

    Attributes
    ----------
    first_sample
        Where the first one begins.
    window_samples
        Samples of each.
    count
        How many there are.
    """

    first_sample: int
    window_samples: int
    count: int

    def bounds_s(self, sample_rate_hz: float) -> list[tuple[float, float]]:
        """Begin and end of each, in s from the begin of the first one."""
        length_s = self.window_samples / sample_rate_hz
        return [(j * length_s, (j + 1) * length_s) for j in range(self.count)]


def windows_over(
    stimulus_samples: int,
    response_samples: int,
    sample_rate_hz: float,
    *,
    count: int | None = None,
    window_s: float | None = None,
    delay_s: float = PRE_TRIGGER_DELAY_S,
) -> Windows:
    """Return the windows in which the response to a stimulus arrives.

    The first one begins as late as the pre-trigger delay is long: what it holds was caused by the
    begin of the stimulus.  Only whole windows count, and at most `MOST_WINDOWS`.

    Parameters
    ----------
    stimulus_samples, response_samples
        Lengths of stimulus and response.
    sample_rate_hz
        Of both.
    count
        How many windows the stimulus is cut into, each of the same number of samples, or
    window_s
        how long each is; then there are as many as reach into the stimulus.
    delay_s
        Pre-trigger delay of the limb, `Limb.pre_trigger_delay_s`.

    Raises
    ------
    InvalidInputError
        Neither or both are given, or one is out of range.
    """
    samples = whole_number("stimulus_samples", stimulus_samples, 1, _MOST_SAMPLES)
    until = whole_number("response_samples", response_samples, samples, _MOST_SAMPLES)
    rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
    if (count is None) == (window_s is None):
        raise InvalidInputError(
            f"count is {count} and window_s is {window_s}: expected one of them, and no other"
        )
    first = floor(real_number("delay_s", delay_s, least=0.0) * rate_hz + NEAR)
    if count is not None:
        most = whole_number("count", count, 1, MOST_WINDOWS)
        length = max(samples // most, 1)
    else:
        length = max(floor(positive_number("window_s", window_s or 0.0) * rate_hz + 0.5), 1)
        most = min(ceil(samples / length), MOST_WINDOWS)
    whole = max(until - first, 0) // length
    return Windows(first_sample=first, window_samples=length, count=min(most, whole))
