"""How well a prediction agrees with a measurement: the figures of the SkinSource paper's Fig. 4."""

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.arguments import finite_array
from skinsource.arrays import Booleans, Floats
from skinsource.errors import InvalidInputError

#: Channels count whose measured RMS is this many times that of the noise, or more.
LEAST_OVER_NOISE = 2.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Agreement:
    """Figures of each channel; NaN where it does not count.

    Attributes
    ----------
    counted : (n_outputs, n_axes) of bool
        Channels whose measured RMS is twice the noise or more.
    error : (n_outputs, n_axes)
        Mean over time of the magnitude of the difference, both divided by their own mean RMS.
    amplitude_percent : (n_outputs, n_axes)
        100 |RMS predicted - RMS measured| / RMS measured, of those same divided signals.
    correlation : (n_outputs, n_axes)
        Pearson's r over time.
    """

    counted: Booleans
    error: Floats
    amplitude_percent: Floats
    correlation: Floats

    @property
    def medians(self) -> tuple[float, float, float]:
        """Of error, amplitude and correlation over the channels that count; NaN: there is none.

        A channel of which silence is predicted counts, but has no correlation.
        """
        parts = (self.error, self.amplitude_percent, self.correlation)
        error, amplitude, correlation = (_median(one[self.counted]) for one in parts)
        return error, amplitude, correlation


def agreement(predicted: ArrayLike, measured: ArrayLike, noise_rms: ArrayLike) -> Agreement:
    """Return how well two fields agree, channel by channel.

    Each field is divided by the mean RMS of its channels first, as in the paper: what is compared
    is shape and distribution, not the strength of the actuator.

    Parameters
    ----------
    predicted, measured : (n_outputs, n_axes, n_times)
        At the same rate and from the same instant, see `aligned`.
    noise_rms : (n_outputs, n_axes) or a number
        Of the measurement, in its unit.

    Raises
    ------
    InvalidInputError
        Shapes differ, samples are not finite, or a field is silent.
    """
    ours = finite_array("predicted", predicted, "(n_outputs, n_axes, n_times)")
    theirs = finite_array("measured", measured, "(n_outputs, n_axes, n_times)")
    if ours.shape != theirs.shape or ours.ndim != 3 or not ours.size:
        raise InvalidInputError(
            f"predicted has shape {ours.shape}, measured {theirs.shape}; expected the same, "
            "(n_outputs, n_axes, n_times)"
        )
    noise = np.broadcast_to(finite_array("noise_rms", noise_rms), ours.shape[:2])
    measured_rms = _rms(theirs)
    counted = (measured_rms >= LEAST_OVER_NOISE * noise) & (measured_rms > 0.0)
    ours, theirs = (
        _divided(name, one) for name, one in (("predicted", ours), ("measured", theirs))
    )
    ours_rms, theirs_rms = _rms(ours), _rms(theirs)
    amplitude = np.full(counted.shape, np.nan)
    np.divide(100.0 * np.abs(ours_rms - theirs_rms), theirs_rms, out=amplitude, where=counted)
    error = np.where(counted, np.abs(ours - theirs).mean(axis=-1), np.nan)
    return Agreement(
        counted=counted,
        error=error,
        amplitude_percent=amplitude,
        correlation=np.where(counted, pearson(ours, theirs), np.nan),
    )


def _median(values: Floats) -> float:
    known = values[np.isfinite(values)]
    return float(np.median(known)) if known.size else np.nan


def pearson(one: Floats, other: Floats) -> Floats:
    """Pearson's r over the last axis; NaN where a signal does not change."""
    a, b = (x - x.mean(axis=-1, keepdims=True) for x in (one, other))
    size = np.sqrt(np.sum(a * a, axis=-1) * np.sum(b * b, axis=-1))
    whole = np.full(size.shape, np.nan)
    found: Floats = np.divide(np.sum(a * b, axis=-1), size, out=whole, where=size > 0.0)
    return found


def aligned(measured: ArrayLike, predicted: ArrayLike, most: int) -> tuple[Floats, int]:
    """Return the measured field shifted onto the predicted one, and by how many samples.

    By the lag at which the sum of the cross-correlations of all channels is largest; silence comes
    in at the end that opens, and what is left over is cut off.

    Parameters
    ----------
    measured, predicted : (n_outputs, n_axes, n_times)
        Lengths in time may differ.
    most
        Samples that it may be shifted by, to either side.

    Returns
    -------
    (n_outputs, n_axes, n_times of the predicted), and the shift; positive: it came too early.
    """
    theirs = finite_array("measured", measured, "(n_outputs, n_axes, n_times)")
    ours = finite_array("predicted", predicted, "(n_outputs, n_axes, n_times)")
    if theirs.ndim != 3 or ours.ndim != 3 or theirs.shape[:2] != ours.shape[:2]:
        raise InvalidInputError(
            f"measured has shape {theirs.shape}, predicted {ours.shape}; expected the same outputs "
            "and axes"
        )
    n_times = ours.shape[-1]
    n_fft = scipy.fft.next_fast_len(n_times + theirs.shape[-1], real=True)
    cross = scipy.fft.rfft(ours, n_fft) * np.conj(scipy.fft.rfft(theirs, n_fft))
    sums = scipy.fft.irfft(cross.sum(axis=(0, 1)), n_fft)
    # At others the two do not meet: a short response, a long search.
    lags = np.arange(-min(most, theirs.shape[-1] - 1), min(most, n_times - 1) + 1)
    shift = int(lags[np.argmax(sums[lags])])
    found = np.zeros(ours.shape)
    first = max(-shift, 0)
    piece = theirs[..., first : first + n_times - max(shift, 0)]
    found[..., max(shift, 0) : max(shift, 0) + piece.shape[-1]] = piece
    return found, shift


def _rms(field: Floats) -> Floats:
    rms: Floats = np.sqrt(np.mean(np.square(field), axis=-1))
    return rms


def _divided(name: str, field: Floats) -> Floats:
    mean = float(_rms(field).mean())
    if mean == 0.0:
        raise InvalidInputError(f"{name} is silent throughout, so there is nothing to compare")
    return field / mean
