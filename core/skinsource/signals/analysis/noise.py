"""Noise of the sensors in measured responses, and in predictions from them."""

from collections.abc import Mapping

import numpy as np

from skinsource.base.conventions import PRE_TRIGGER_DELAY_S, Floats, Indices
from skinsource.base.errors import InvalidInputError
from skinsource.signals.analysis.windows import Windows

#: Share of the time before the pulse that is noise alone: 30 of 52 ms in the published responses.
QUIET_SHARE = 0.58
# Fewest samples for an estimate: 8 are accurate within a quarter.
_FEWEST = 8
#: A level less than this above that of the noise is mostly noise.
LEAST_ABOVE_NOISE_DB = 6.0


def noise_rms(
    response: Floats, sample_rate_hz: float, pre_trigger_s: float = PRE_TRIGGER_DELAY_S
) -> Floats:
    """Return the RMS of the noise in measured responses, from before the pulse.

    Parameters
    ----------
    response : (..., n_taps)
        Responses to the measuring pulse, m/s².
    sample_rate_hz
        Their rate.
    pre_trigger_s
        Time from their first sample to the pulse.

    Returns
    -------
    (...,), m/s².  About 0.0062 in the published responses, on each axis; nearly white.  With 39
    samples its standard deviation is 11 %.

    Raises
    ------
    InvalidInputError
        There are too few samples before the pulse, see `tells_noise`, or none after it.
    """
    count = _n_quiet_samples(sample_rate_hz, pre_trigger_s)
    if not _FEWEST <= count < response.shape[-1]:
        raise InvalidInputError(
            f"response has shape {response.shape} with {count} samples before the pulse, expected "
            f"(..., n_taps) with {_FEWEST} or more of them and the response after them"
        )
    return _rms(response[..., :count])


def quiet_rms(quiet: Floats) -> Floats | None:
    """Return the RMS of samples before a stimulus, (...); None if there are too few."""
    return _rms(quiet) if quiet.shape[-1] >= _FEWEST else None


def _rms(data: Floats) -> Floats:
    return np.sqrt(np.mean(np.square(data), axis=-1))


def tells_noise(sample_rate_hz: float, pre_trigger_s: float) -> bool:
    """Whether there are enough samples before the pulse to estimate the noise."""
    return _n_quiet_samples(sample_rate_hz, pre_trigger_s) >= _FEWEST


def _n_quiet_samples(sample_rate_hz: float, pre_trigger_s: float) -> int:
    return round(QUIET_SHARE * pre_trigger_s * sample_rate_hz)


def predicted_noise_energy(
    energies: Mapping[int, float], noise: Mapping[int, Floats], n_taps: int
) -> Floats:
    """Return the energy of the noise of responses in a prediction from them.

    White noise of RMS sigma in the n taps of a response, convolved with a drive s, has the expected
    energy n sigma² sum s²; noises of different locations are independent and add up, drives of one
    location are summed before, because they are convolved with the same noise.

    Parameters
    ----------
    energies
        By input location: sum of squares of all drives there together, scaled as the response.
    noise
        By input location: `noise_rms`, (n_outputs, n_axes).
    n_taps
        Length of the responses.

    Returns
    -------
    (n_outputs, n_axes), sum of squares, m²/s⁴.
    """
    parts = [n_taps * each * np.square(noise[location]) for location, each in energies.items()]
    return np.sum(parts, axis=0)


def windowed_noise_energy(
    drives: Mapping[int, Floats], noise: Mapping[int, Floats], n_taps: int, windows: Windows
) -> Floats:
    """Return the energy of the noise of responses within windows of a prediction.

    It is the part of `predicted_noise_energy` in each window: at an instant the noise has the
    variance sigma² times the energy that was played during the n taps up to it.  ``drives`` are the
    sums of all drives at each location, (n_times,).

    Returns
    -------
    (n_windows, n_outputs, n_axes), sum of squares, m²/s⁴.
    """
    edges = windows.first_sample + windows.window_samples * np.arange(windows.count + 1)
    energy = np.zeros((windows.count, *next(iter(noise.values())).shape))
    for location, drive in drives.items():
        until = _energy_sum_until(drive, edges) - _energy_sum_until(drive, edges - n_taps)
        # Where nothing is played, rounding may make this slightly negative.
        energy += np.maximum(np.diff(until), 0.0)[:, None, None] * np.square(noise[location])
    return energy


def _energy_sum_until(drive: Floats, instants: Indices) -> Floats:
    """Return the sum, over all samples before each instant, of the energy up to that sample."""
    energy = np.cumsum(np.square(drive))
    summed = np.concatenate([[0.0], np.cumsum(energy)])
    after = np.maximum(instants - drive.size, 0) * energy[-1]
    return summed[np.clip(instants, 0, drive.size)] + after
