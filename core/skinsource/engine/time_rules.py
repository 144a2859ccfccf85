"""Rules from vibrations to signals of all outputs in time, from which frames are drawn.

Signals are transformed back once, for the part of the response that is kept; frames transform
nothing.  Of a long response, two blocks and a margin are kept.
"""

from dataclasses import dataclass
from math import floor

import numpy as np

from skinsource.base.conventions import Floats, axes_text, axis_numbers
from skinsource.base.errors import InvalidInputError, quoted
from skinsource.base.job import Stop, stop_if
from skinsource.engine.moments import Projection
from skinsource.engine.spectra import TotalSpectrum
from skinsource.engine.streaming import StreamedVibration, output_groups
from skinsource.engine.transforms import inverse
from skinsource.limbs.limb import Limb
from skinsource.signals.projection import magnitude
from skinsource.signals.sampling import sample_and_rest, values_at


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _PartOfResponse:
    """All outputs over a part of the response.

    Attributes
    ----------
    first
        Sample at which it begins, counted from time 0 of the design: an equaliser begins before.
    response_samples
        Samples of the whole response from time 0 on.
    largest
        Largest length of the vector at any output and any sample of the whole response, m/s².
    delay_s
        Pre-trigger delay in the response.
    """

    first: int
    sample_rate_hz: float
    response_samples: int
    largest: float
    delay_s: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Moving(_PartOfResponse):
    """Acceleration of all outputs over a part of the response.

    Attributes
    ----------
    signals : (n_outputs, n_axes, n_times)
        In m/s².
    """

    signals: Floats

    @property
    def end(self) -> int:
        """Sample of the response after the last sample that is held."""
        return self.first + self.signals.shape[-1]

    @property
    def is_whole(self) -> bool:
        """Whether the whole response is held."""
        return self.first <= 0 and self.end == self.response_samples

    def acceleration(self, time_s: float) -> Floats:
        """Return the acceleration at an instant of the response, (n_outputs, n_axes), m/s².

        Between samples it is interpolated, see `values_at`, so that a frame belongs to its instant
        in slow motion too.  Before and after the response it is 0.
        """
        return values_at(self.signals, time_s * self.sample_rate_hz - self.first)

    def magnitude(self, time_s: float) -> Floats:
        """Return the length of the vector at an instant, (n_outputs,), m/s²."""
        return np.linalg.norm(self.acceleration(time_s), axis=-1)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SlidingEnergy(_PartOfResponse):
    """Running sums of the squares of all outputs over a part of the response.

    Attributes
    ----------
    sums : (n_outputs, n_times + 1)
        Sums of the squares of all samples before each sample, (m/s²)².
    """

    sums: Floats

    @property
    def end(self) -> int:
        """Sample of the response after the last sample that is held."""
        return self.first + self.sums.shape[-1] - 1

    def rms(self, time_s: float, window_s: float) -> Floats:
        """Return the RMS around an instant, (n_outputs,), m/s².

        The window holds a whole number of samples, at least one, half of them before the instant
        and half after.  Between two samples the mean square is interpolated linearly.  Before and
        after the response there is silence.

        Raises
        ------
        InvalidInputError
            The window is not a positive time.
        """
        if not window_s > 0.0:
            raise InvalidInputError(f"window_s is {quoted(window_s)}, expected a positive time")
        count = max(round(window_s * self.sample_rate_hz), 1)
        # An odd window is centred on a sample, an even one between two samples.
        start = time_s * self.sample_rate_hz - self.first - (count - 1) / 2
        whole, share = sample_and_rest(start)
        square = (1.0 - share) * self._sum(whole, count) + share * self._sum(whole + 1, count)
        return np.sqrt(np.maximum(square / count, 0.0))

    def _sum(self, start: int, count: int) -> Floats:
        last = self.sums.shape[-1] - 1
        low, high = min(max(start, 0), last), min(max(start + count, 0), last)
        return self.sums[:, high] - self.sums[:, low]


#: Length of a block.  At 1300 Hz every response that is transformed at once is shorter.
BLOCK_S = 12.0
# Margin around both blocks: for interpolation, half of a sliding window, and pre-trigger delay.
_BEYOND_S = 1.0

#: First sample, and the sample after the last.
Window = tuple[int, int]


def block_of(time_s: float) -> int:
    """Return the number of the block in which a time lies, from 0."""
    return max(floor(time_s / BLOCK_S), 0)


def moving_window(
    moving_block: int, response_samples: int, n_fft: int | None, sample_rate_hz: float
) -> Window:
    """First sample that is kept, and the sample after the last; all of a short response."""
    if n_fft is not None:
        return 0, response_samples
    # The block, the next one, and a second around.
    first = floor((moving_block * BLOCK_S - _BEYOND_S) * sample_rate_hz)
    end = floor(((moving_block + 2) * BLOCK_S + _BEYOND_S) * sample_rate_hz)
    first = min(max(first, 0), response_samples)
    return first, max(min(end, response_samples), first)


def moving_z(
    total_spectrum: TotalSpectrum | None,
    streamed_vibration: StreamedVibration | None,
    moving_window: Window,
    moving_z_largest: float | None,
    response_samples: int,
    driven_limb: Limb,
    limb_data: Limb,
    stop: Stop,
) -> Moving:
    """Acceleration of all outputs along z, the axis that is normal to the skin everywhere."""
    axes = _z_axis(limb_data)
    signals = _signals(total_spectrum, streamed_vibration, moving_window, axes, limb_data, stop)
    return _moving(signals, moving_window, response_samples, driven_limb, moving_z_largest)


def moving_vector(
    total_spectrum: TotalSpectrum | None,
    streamed_vibration: StreamedVibration | None,
    moving_window: Window,
    moving_vector_largest: float | None,
    response_samples: int,
    driven_limb: Limb,
    limb_data: Limb,
    stop: Stop,
) -> Moving:
    """Acceleration of all outputs on all axes."""
    axes = _all_axes(limb_data)
    signals = _signals(total_spectrum, streamed_vibration, moving_window, axes, limb_data, stop)
    return _moving(signals, moving_window, response_samples, driven_limb, moving_vector_largest)


def moving_energy(
    moving_vector: Moving, projection: Projection, limb_data: Limb, stop: Stop
) -> SlidingEnergy:
    """Running sums of the squares of the projected signals, of which levels are the RMS."""
    n_outputs, _, n_times = moving_vector.signals.shape
    axes = np.array(projection.axis_numbers)
    sums = np.zeros((n_outputs, n_times + 1))
    for rows in output_groups(limb_data.n_outputs):
        stop_if(stop)
        signals = projection.at(rows).signals(moving_vector.signals[np.ix_(rows, axes)])
        sums[rows, 1:] = np.cumsum(np.square(signals), axis=1)
    sums.flags.writeable = False
    return SlidingEnergy(
        sums=sums,
        first=moving_vector.first,
        sample_rate_hz=moving_vector.sample_rate_hz,
        response_samples=moving_vector.response_samples,
        largest=moving_vector.largest,
        delay_s=moving_vector.delay_s,
    )


def moving_z_largest(
    streamed_vibration: StreamedVibration | None, limb_data: Limb, stop: Stop
) -> float | None:
    """Largest acceleration along z of a long response, m/s²; None: it follows from the signals."""
    return _largest(streamed_vibration, _z_axis(limb_data), limb_data, stop)


def moving_vector_largest(
    streamed_vibration: StreamedVibration | None, limb_data: Limb, stop: Stop
) -> float | None:
    """Largest length of the vector of a long response, m/s²; None: it follows from the signals."""
    return _largest(streamed_vibration, _all_axes(limb_data), limb_data, stop)


def _z_axis(limb: Limb) -> tuple[int, ...]:
    """Return the number of z among the axes of a limb.

    Raises
    ------
    InvalidInputError
        The limb was not measured along z.
    """
    if "z" not in limb.axes:
        raise InvalidInputError(
            f"{limb.name} was measured along {axes_text(limb.axes)}, not along z: choose its "
            "magnitude or its sliding RMS."
        )
    return axis_numbers("z", limb.axes)


def _all_axes(limb: Limb) -> tuple[int, ...]:
    return tuple(range(limb.n_axes))


def _moving(
    signals: Floats, window: Window, response_samples: int, limb: Limb, largest: float | None
) -> Moving:
    if largest is None:
        largest = float(magnitude(signals).max(initial=0.0))
    return Moving(
        signals=signals,
        first=window[0] - limb.lead_samples,
        sample_rate_hz=limb.sample_rate_hz,
        response_samples=response_samples - limb.lead_samples,
        largest=largest,
        delay_s=limb.pre_trigger_delay_s,
    )


def _signals(
    total: TotalSpectrum | None,
    streamed: StreamedVibration | None,
    window: Window,
    axes: tuple[int, ...],
    limb: Limb,
    stop: Stop,
) -> Floats:
    """Return the acceleration of all outputs over a window, (n_outputs, n_axes, n_times)."""
    first, end = window
    acceleration = np.zeros((limb.n_outputs, len(axes), end - first))
    if total is not None:
        for rows in output_groups(limb.n_outputs):
            stop_if(stop)
            signals = inverse(total.rows(rows, axes), total.n_fft)
            acceleration[rows] = signals[..., first:end]
    elif streamed is not None:
        every = range(1, limb.n_outputs + 1)
        for begin, block in streamed.blocks_of(every, axes, stop, window):
            low, high = max(begin, first), min(begin + block.shape[-1], end)
            if low < high:
                acceleration[..., low - first : high - first] = block[
                    ..., low - begin : high - begin
                ]
    # One thread reads frames while another computes the next window.
    acceleration.flags.writeable = False
    return acceleration


def _largest(
    streamed: StreamedVibration | None, axes: tuple[int, ...], limb: Limb, stop: Stop
) -> float | None:
    if streamed is None:
        return None
    every = range(1, limb.n_outputs + 1)
    blocks = (block for _, block in streamed.blocks_of(every, axes, stop))
    return max((float(magnitude(block).max(initial=0.0)) for block in blocks), default=0.0)
