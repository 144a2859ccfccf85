"""Checks that a linear model rests on: output in proportion to input, and sums of inputs."""

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.analysis.bands import band_rms
from skinsource.arguments import finite_array, positive_number
from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.limb import BAND_HZ, Band
from skinsource.validation.agreement import pearson


def linear_fit(
    levels: ArrayLike,
    responses: ArrayLike,
    sample_rate_hz: float,
    band_hz: Band | None = BAND_HZ,
) -> tuple[Floats, Floats]:
    """Return how well output is in proportion to input, by frequency.

    In each bin of 2 Hz within the measured band the RMS of the output, see `band_rms`, is fitted
    with a straight line over the level of the input.

    Parameters
    ----------
    levels : (n_levels,)
        Of the input, three or more different ones.
    responses : (n_levels, n_channels, n_times)
        To the same stimulus at these levels.
    sample_rate_hz
        Their rate.
    band_hz
        The measured band; None: it is not known, and all frequencies count.

    Returns
    -------
    frequency_hz : (n_bins,)
        Middles of the bins that hold a frequency.
    adjusted_r2 : (n_channels, n_bins)
        1 for a straight line; NaN where nothing is heard.

    Raises
    ------
    InvalidInputError
        Shapes that do not fit, or too few levels.
    """
    x = finite_array("levels", levels, "(n_levels,)")
    data = finite_array("responses", responses, "(n_levels, n_channels, n_times)")
    rate = positive_number("sample_rate_hz", sample_rate_hz)
    if x.ndim != 1 or data.ndim != 3 or len(x) != len(data) or np.unique(x).size < 3:
        raise InvalidInputError(
            f"levels has shape {x.shape}, responses {data.shape}; expected three or more different "
            "levels and (n_levels, n_channels, n_times)"
        )
    middles, y = band_rms(scipy.fft.rfft(data), data.shape[-1], rate, band_hz)
    return middles, straight_lines(x[:, None, None], y)[2]


def superposition_correlation(separate: ArrayLike, joint: ArrayLike) -> Floats:
    """Return Pearson's r between the sum of separate responses and the joint one, (n_channels,).

    Parameters
    ----------
    separate : (n_inputs, n_channels, n_times)
        Responses to each input alone.
    joint : (n_channels, n_times)
        To all together.
    """
    parts = finite_array("separate", separate, "(n_inputs, n_channels, n_times)")
    whole = finite_array("joint", joint, "(n_channels, n_times)")
    if parts.ndim != 3 or parts.shape[1:] != whole.shape:
        raise InvalidInputError(
            f"separate has shape {parts.shape}, joint {whole.shape}; expected (n_inputs, "
            "n_channels, n_times) and (n_channels, n_times)"
        )
    return pearson(parts.sum(axis=0), whole)


def straight_lines(x: Floats, y: Floats) -> tuple[Floats, Floats, Floats]:
    """Slopes, offsets and adjusted R² of straight lines over the first axis, by least squares.

    Parameters
    ----------
    x, y : (n, ...)
        Shapes that broadcast, with three levels or more; ``y`` has the whole one.

    Returns
    -------
    (...,) each; R² is NaN where ``y`` does not change.
    """
    n = len(x)
    away, rest = x - x.mean(axis=0), y - y.mean(axis=0)
    slope = np.sum(away * rest, axis=0) / np.sum(away**2, axis=0)
    left = np.sum(np.square(rest - slope * away), axis=0)
    total = np.sum(np.square(rest), axis=0)
    # The mean of equal levels may be rounded: what is left of them then is no change.
    rounding = n * np.square(np.finfo(np.float64).eps * np.abs(y).max(axis=0))
    share = np.divide(left, total, out=np.full(total.shape, np.nan), where=total > rounding)
    return slope, y.mean(axis=0) - slope * x.mean(axis=0), 1.0 - share * (n - 1) / (n - 2)
