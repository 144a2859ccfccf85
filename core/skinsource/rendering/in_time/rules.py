"""Rules from vibrations to signals of all outputs in time.

They are brought back to time once, for as much of the response as is kept; frames are taken from
them, and transform nothing.
"""

from collections.abc import Iterator

import numpy as np

from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.job import Stop, stop_if
from skinsource.limb import Limb, axis_numbers
from skinsource.limb.axes import words
from skinsource.projection import magnitude
from skinsource.rendering.in_time.moving import Moving, SlidingEnergy
from skinsource.rendering.in_time.window import Window, window_of
from skinsource.rendering.projecting import Projection
from skinsource.rendering.streaming import StreamedVibration
from skinsource.rendering.total_spectrum import TotalSpectrum
from skinsource.rendering.transforms import inverse

# Outputs that are held in time and as spectra together.
_OUTPUTS_AT_ONCE = 18


def moving_window(
    moving_block: int, response_samples: int, n_fft: int | None, sample_rate_hz: float
) -> Window:
    """First sample that is kept in time, and the one after the last; all of a short response."""
    if n_fft is not None:
        return 0, response_samples
    return window_of(moving_block, response_samples, sample_rate_hz)


def moving_z(
    total_spectrum: TotalSpectrum | None,
    streamed_vibration: StreamedVibration | None,
    moving_window: Window,
    moving_z_largest: float | None,
    response_samples: int,
    limb_data: Limb,
    stop: Stop,
) -> Moving:
    """Acceleration of all outputs along z, the axis that is upright to the skin everywhere."""
    axes = z_axis(limb_data)
    signals = _signals(total_spectrum, streamed_vibration, moving_window, axes, limb_data, stop)
    return _moving(signals, moving_window, response_samples, limb_data, moving_z_largest)


def moving_vector(
    total_spectrum: TotalSpectrum | None,
    streamed_vibration: StreamedVibration | None,
    moving_window: Window,
    moving_vector_largest: float | None,
    response_samples: int,
    limb_data: Limb,
    stop: Stop,
) -> Moving:
    """Acceleration of all outputs on all axes."""
    axes = _all_axes(limb_data)
    signals = _signals(total_spectrum, streamed_vibration, moving_window, axes, limb_data, stop)
    return _moving(signals, moving_window, response_samples, limb_data, moving_vector_largest)


def moving_energy(
    moving_vector: Moving, projection: Projection, limb_data: Limb, stop: Stop
) -> SlidingEnergy:
    """Running sums of the squares of what levels are the RMS of."""
    n_outputs, _, n_times = moving_vector.signals.shape
    axes = np.array(projection.axis_numbers)
    sums = np.zeros((n_outputs, n_times + 1))
    for rows in _some_outputs(limb_data):
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
    """Largest acceleration along z of a long response, m/s²; None: the signals tell."""
    return _largest(streamed_vibration, z_axis(limb_data), limb_data, stop)


def moving_vector_largest(
    streamed_vibration: StreamedVibration | None, limb_data: Limb, stop: Stop
) -> float | None:
    """Largest length of the vector of a long response, m/s²; None: the signals tell."""
    return _largest(streamed_vibration, _all_axes(limb_data), limb_data, stop)


def z_axis(limb: Limb) -> tuple[int, ...]:
    """Place of z among the axes of a limb.

    Raises
    ------
    InvalidInputError
        It was measured without.
    """
    if "z" not in limb.axes:
        raise InvalidInputError(
            f"{limb.name} was measured along {words(limb.axes)}, and not along z: look at its "
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
        first=window[0],
        sample_rate_hz=limb.sample_rate_hz,
        response_samples=response_samples,
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
    """Acceleration of all outputs over a window, (n_outputs, n_axes, n_times)."""
    first, end = window
    found = np.zeros((limb.n_outputs, len(axes), end - first))
    if total is not None:
        for rows in _some_outputs(limb):
            stop_if(stop)
            signals = inverse(total.rows(rows, axes), total.n_fft)
            found[rows] = signals[..., first:end]
    elif streamed is not None:
        every = range(1, limb.n_outputs + 1)
        for begin, block in streamed.blocks_of(every, axes, stop, window):
            low, high = max(begin, first), min(begin + block.shape[-1], end)
            if low < high:
                found[..., low - first : high - first] = block[..., low - begin : high - begin]
    # Frames are read by one thread while the next window is made by another.
    found.flags.writeable = False
    return found


def _some_outputs(limb: Limb) -> Iterator[np.ndarray]:
    for first in range(0, limb.n_outputs, _OUTPUTS_AT_ONCE):
        yield np.arange(first, min(first + _OUTPUTS_AT_ONCE, limb.n_outputs))


def _largest(
    streamed: StreamedVibration | None, axes: tuple[int, ...], limb: Limb, stop: Stop
) -> float | None:
    if streamed is None:
        return None
    every = range(1, limb.n_outputs + 1)
    blocks = (block for _, block in streamed.blocks_of(every, axes, stop))
    return max((float(magnitude(block).max(initial=0.0)) for block in blocks), default=0.0)


RULES = (
    moving_window,
    moving_z,
    moving_vector,
    moving_energy,
    moving_z_largest,
    moving_vector_largest,
)
