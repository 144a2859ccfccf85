"""Signals of all outputs over a part of the response, to be looked at instant by instant."""

from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.quoting import quoted
from skinsource.sampling import parted, values_at


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Moving:
    """Acceleration of all outputs over a part of the response.

    Attributes
    ----------
    signals : (n_outputs, n_axes, n_times)
        In m/s².
    first
        The sample of the response with which they begin.
    sample_rate_hz
        Theirs.
    response_samples
        Samples of the whole response.
    largest
        The largest length of the vector at any output and any sample of the whole response, m/s².
    delay_s
        The pre-trigger delay that the response contains.
    """

    signals: Floats
    first: int
    sample_rate_hz: float
    response_samples: int
    largest: float
    delay_s: float

    @property
    def end(self) -> int:
        """The sample of the response after the last one that is held."""
        return self.first + self.signals.shape[-1]

    def acceleration(self, time_s: float) -> Floats:
        """Acceleration at an instant of the response, (n_outputs, n_axes), in m/s².

        Between samples it is what the samples describe, see `values_at`: a frame belongs to its
        instant, however slowly they follow one another.  Before and after the response, silence.
        """
        return values_at(self.signals, time_s * self.sample_rate_hz - self.first)

    def magnitude(self, time_s: float) -> Floats:
        """Length of the vector at an instant, (n_outputs,), in m/s²."""
        found: Floats = np.linalg.norm(self.acceleration(time_s), axis=-1)
        return found


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SlidingEnergy:
    """Running sums of the squares of all outputs over a part of the response.

    Attributes
    ----------
    sums : (n_outputs, n_times + 1)
        Sums of the squares of all samples before one, (m/s²)².
    first, sample_rate_hz, response_samples, largest, delay_s
        As those of `Moving`.
    """

    sums: Floats
    first: int
    sample_rate_hz: float
    response_samples: int
    largest: float
    delay_s: float

    @property
    def end(self) -> int:
        """The sample of the response after the last one that is held."""
        return self.first + self.sums.shape[-1] - 1

    def rms(self, time_s: float, window_s: float) -> Floats:
        """RMS around an instant, (n_outputs,), in m/s².

        The window holds a whole number of samples, at least one, half of them before the instant
        and half after; between two samples the mean square is on the line between its values
        there.  Before and after the response there is silence.

        Raises
        ------
        InvalidInputError
            The window is not a positive time.
        """
        if not window_s > 0.0:
            raise InvalidInputError(f"window_s is {quoted(window_s)}, expected a positive time")
        count = max(round(window_s * self.sample_rate_hz), 1)
        # An odd window lies around a sample, an even one around the middle between two.
        start = time_s * self.sample_rate_hz - self.first - (count - 1) / 2
        whole, behind = parted(start)
        square = (1.0 - behind) * self._sum(whole, count) + behind * self._sum(whole + 1, count)
        found: Floats = np.sqrt(np.maximum(square / count, 0.0))
        return found

    def _sum(self, start: int, count: int) -> Floats:
        last = self.sums.shape[-1] - 1
        low, high = min(max(start, 0), last), min(max(start + count, 0), last)
        found: Floats = self.sums[:, high] - self.sums[:, low]
        return found
