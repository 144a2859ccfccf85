"""The response of an actuator from sweeps that were recorded several times, late, and in noise."""

from dataclasses import dataclass, replace

import numpy as np
import scipy

from skinsource.arrays import Complexes, Floats
from skinsource.errors import InvalidInputError
from skinsource.measuring.bands import Bands
from skinsource.measuring.loop_delay import ExcessDelay, coarse_delay, excess_delay

#: A point whose error, relative to its gain, may be larger than this is left out.
MOST_ERROR = 0.1
#: Fewer points are no response.
FEWEST = 12
# A delay is told from points that are less exact, and from above the band that is wanted.
_MOST_ERROR_OF_DELAY = 0.3
_ROUNDS = 4
_TURN = 2j * np.pi


@dataclass(frozen=True, slots=True, eq=False)
class Sweeps:
    """What was played, and what was recorded of it.

    Attributes
    ----------
    voltage : (n_times,)
        In V at the actuator: one sweep, and silence until the next.
    recorded : (n_repeats, n_recorded)
        From the first sample of each sweep on, longer than ``voltage`` by the longest delay that
        is looked for; in m/s², or whatever unit the response shall have.
    noise : (n_noise,)
        The same while nothing was played.
    sample_rate_hz
        Of all of them.
    """

    voltage: Floats
    recorded: Floats
    noise: Floats
    sample_rate_hz: int


@dataclass(frozen=True, slots=True, eq=False)
class AveragedResponse:
    """A response with its error.

    Attributes
    ----------
    frequency_hz, response, error : (n_points,)
        Where something was heard above the noise: Hz, m/s² per V without the delay, and the
        standard error relative to the gain, from the noise or from how far the sweeps differ,
        whichever is larger.
    n_left_out
        Points of the band that the noise covers.
    delay
        What was taken out.
    """

    frequency_hz: Floats
    response: Complexes
    error: Floats
    n_left_out: int
    delay: ExcessDelay


def averaged_response(
    sweeps: Sweeps,
    band_hz: tuple[float, float],
    delay_band_hz: tuple[float, float],
    known_delay: ExcessDelay | None = None,
) -> AveragedResponse:
    """The mean response over all repeats.

    Parameters
    ----------
    sweeps
        What was recorded.
    band_hz
        Lowest and highest frequency that are wanted.
    delay_band_hz
        Within it the delay is told: the wider, the better.
    known_delay
        Where the delay is known from elsewhere, as from a wire from output to input.

    Raises
    ------
    InvalidInputError
        Next to nothing of the sweep is above the noise.
    """
    delay = known_delay or delay_of(sweeps, delay_band_hz)
    shift = max(round(delay.seconds * sweeps.sample_rate_hz), 0)
    hz, response, error = _points(sweeps, shift, band_hz)
    heard = error <= MOST_ERROR
    if heard.sum() < FEWEST:
        raise InvalidInputError(_nothing_heard(error))
    rest_s = delay.seconds - shift / sweeps.sample_rate_hz
    return AveragedResponse(
        frequency_hz=hz[heard],
        response=response[heard] * np.exp(_TURN * hz[heard] * rest_s),
        error=error[heard],
        n_left_out=int((~heard).sum()),
        delay=delay,
    )


def delay_of(sweeps: Sweeps, band_hz: tuple[float, float]) -> ExcessDelay:
    """From the sweep to its recording.

    Raises
    ------
    InvalidInputError
        Next to nothing of the sweep is above the noise.
    """
    rate_hz = sweeps.sample_rate_hz
    first = sweeps.recorded[0]
    shift = coarse_delay(sweeps.voltage, first, _noise_power(sweeps, first.size))
    latest = first.size - sweeps.voltage.size
    found = ExcessDelay(0.0, False, 0.0)
    for _ in range(_ROUNDS):
        hz, response, error = _points(sweeps, shift, band_hz)
        heard = error <= _MOST_ERROR_OF_DELAY
        if heard.sum() < FEWEST:
            raise InvalidInputError(_nothing_heard(error))
        found = excess_delay(hz[heard], response[heard])
        found = replace(found, seconds=found.seconds + shift / rate_hz)
        nearest = min(max(round(found.seconds * rate_hz), 0), latest)
        if nearest == shift:
            break
        shift = nearest
    return found


def _points(
    sweeps: Sweeps, shift: int, band_hz: tuple[float, float]
) -> tuple[Floats, Complexes, Floats]:
    """Frequencies, responses with what is left of the delay, and their relative errors."""
    n = sweeps.voltage.size
    late = sweeps.recorded[:, shift : shift + n]
    # Silence behind, so that what rings does not come round to the beginning.
    length = scipy.fft.next_fast_len(2 * n, real=True)
    sent, came = scipy.fft.rfft(sweeps.voltage, length), scipy.fft.rfft(late, length)
    bands = Bands.between(band_hz, sweeps.sample_rate_hz / length, sent.size)
    power = bands.sums(np.abs(sent) ** 2)
    each = bands.sums(sent.conj() * came) / power
    mean = each.mean(axis=0)
    # What noise adds to the sum over a band; padded spectra are smooth, and their neighbours
    # have half of their noise in common.
    noise = bands.sums(_noise_power(sweeps, n, length)) / bands.counts
    variance = noise * (length / n) / (power * len(each))
    if len(each) > 1:
        variance = np.maximum(variance, each.var(axis=0, ddof=1) / len(each))
    gain = np.abs(mean)
    error = np.full(gain.size, np.inf)
    np.divide(np.sqrt(variance), gain, out=error, where=gain > 0.0)
    return bands.centre_hz, mean, error


def _noise_power(sweeps: Sweeps, n: int, length: int | None = None) -> Floats:
    """Expected |rfft|² of the noise in ``n`` samples, at the frequencies of ``length``."""
    noise = sweeps.noise
    length = scipy.fft.next_fast_len(2 * n, real=True) if length is None else length
    # Parts of an eighth, so that single frequencies are not mistaken for their mean.
    part = max(noise.size // 8, 1)
    hz, density = scipy.signal.welch(noise, 1.0, nperseg=part, detrend="constant")
    wanted = np.arange(length // 2 + 1) / length
    found: Floats = np.interp(wanted, hz, density) * (n / 2.0)
    return found


def _nothing_heard(error: Floats) -> str:
    best = float(error.min(initial=np.inf))
    known = f"; the best point is uncertain by {100.0 * best:.0f} %" if np.isfinite(best) else ""
    return (
        f"next to nothing of the sweep is above the noise of the input{known}. Is the amplifier "
        "on, and the sensor in its place and wired to that input? Raise the level if they are"
    )
