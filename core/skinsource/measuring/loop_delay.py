"""How late a recording is behind what was played, told from the recording itself."""

from dataclasses import dataclass

import numpy as np
import scipy

from skinsource.arrays import Complexes, Floats

# Enough frequencies for the lowest, and so far above the highest that what is not known there
# turns the phase by next to nothing.
_LENGTH, _ABOVE = 2**17, 16.0
# Below and above what was measured a gain falls, or rises, by no more than this for each octave.
_STEEPEST = 3.0
# Of an octave, over which the slope at the upper end is told.
_END_OCTAVES = 0.5
# Of the largest power of the source: below, it is not divided by.
_LEAST_POWER = 1e-5


@dataclass(frozen=True, slots=True)
class ExcessDelay:
    """What of a phase no gain explains.

    Attributes
    ----------
    seconds
        Delay.
    inverted
        Whether the sign is turned over.
    misfit_rad
        Root mean square of what neither explains.
    """

    seconds: float
    inverted: bool
    misfit_rad: float


def coarse_delay(played: Floats, recorded: Floats, noise_power: Floats) -> int:
    """Samples by which ``recorded`` is behind ``played``: where its impulse response is largest.

    Parameters
    ----------
    played : (n_times,)
        What was sent, silence at its end.
    recorded : (n_recorded,)
        What came back; from the first sample of ``played`` on, and at least as long.
    noise_power : (n_frequencies,)
        Expected |rfft|² of noise in a recording of that length, from 0 to half the rate: what
        is not above it is left out.
    """
    length = scipy.fft.next_fast_len(played.size + recorded.size, real=True)
    sent, came = scipy.fft.rfft(played, length), scipy.fft.rfft(recorded, length)
    power = np.abs(sent) ** 2
    known = np.linspace(0.0, 1.0, noise_power.size)
    noise = np.interp(np.linspace(0.0, 1.0, power.size), known, noise_power)
    above = np.maximum(1.0 - noise / np.maximum(np.abs(came) ** 2, np.finfo(float).tiny), 0.0)
    swept = power > _LEAST_POWER * power.max()
    whitened = np.zeros(power.size, complex)
    whitened[swept] = (above * came * sent.conj())[swept] / power[swept]
    latest = recorded.size - played.size
    return int(np.argmax(np.abs(scipy.fft.irfft(whitened, length)[: latest + 1])))


def excess_delay(frequency_hz: Floats, response: Complexes) -> ExcessDelay:
    """The delay in a response, and its sign.

    An actuator is a system of minimum phase: its gain alone says its phase (Bode's relation).
    What is left of the phase is a straight line through 0, the delay, or through half a turn.

    Parameters
    ----------
    frequency_hz : (n,)
        Rising, so dense that the phase turns by less than half a turn from one to the next.
    response : (n,)
        As measured.
    """
    left = np.unwrap(np.angle(response) - minimum_phase(frequency_hz, np.abs(response)))
    # A line with an offset of its own first: it says which multiple of half a turn is meant.
    offset = np.polynomial.polynomial.polyfit(frequency_hz, left, 1)[0]
    half_turns = round(float(offset) / np.pi)
    left -= half_turns * np.pi
    slope = float(left @ frequency_hz / (frequency_hz @ frequency_hz))
    misfit = np.sqrt(np.mean((left - slope * frequency_hz) ** 2))
    return ExcessDelay(-slope / (2.0 * np.pi), half_turns % 2 == 1, float(misfit))


def minimum_phase(frequency_hz: Floats, gain: Floats) -> Floats:
    """Phase in rad, (n,), of the system of minimum phase that has these gains, (n,).

    Outside of what is known the gain goes on as steeply as it ends.
    """
    place, level = np.log(frequency_hz), np.log(gain)
    step_hz = _ABOVE * frequency_hz[-1] / (_LENGTH // 2)
    every_hz = np.arange(_LENGTH // 2 + 1) * step_hz
    # At 0 Hz the logarithm of a gain may be infinite: half a step above it is as good.
    every_hz[0] = 0.5 * step_hz
    wanted = np.log(every_hz)
    low, high = _slope(place, level, place[0], 1.0), _slope(place, level, place[-1], -1.0)
    levels = np.interp(wanted, place, level)
    levels += low * np.minimum(wanted - place[0], 0.0)
    levels += high * np.maximum(wanted - place[-1], 0.0)
    cepstrum = scipy.fft.irfft(levels, _LENGTH)
    cepstrum[1 : _LENGTH // 2] *= 2.0
    cepstrum[_LENGTH // 2 + 1 :] = 0.0
    found: Floats = np.interp(frequency_hz, every_hz, scipy.fft.rfft(cepstrum).imag)
    return found


def _slope(place: Floats, level: Floats, end: float, inwards: float) -> float:
    """How steeply a gain ends, in units of gain over frequency."""
    near = np.abs(place - end) <= _END_OCTAVES * np.log(2.0)
    if near.sum() < 2:
        return 0.0
    slope = float(np.polynomial.polynomial.polyfit(place[near], level[near], 1)[1])
    # Rising for ever, or out of nothing, it would not be a response.
    least, most = (0.0, _STEEPEST) if inwards > 0 else (-_STEEPEST, 0.0)
    return min(max(slope, least), most)
