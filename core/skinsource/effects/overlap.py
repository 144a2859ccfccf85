"""Another length with the same frequencies: pieces that overlap where they continue each other."""

import numpy as np
import scipy

from skinsource.arrays import Floats
from skinsource.sampling import values_between

# What is compared has this rate whatever that of the samples is: at 1300 Hz a piece could only be
# moved by whole samples, up to a third of a turn of 600 Hz.
_RATE_HZ = 20_800.0
_STEP = 416  # 20 ms
_PIECE = 2 * _STEP
#: How far from its place a piece may be taken: half a turn of 25 Hz.
_SEARCH = 416
# A piece further off has to continue better by this.
_FAR = 0.02


def stretched_in_time(
    samples: Floats, sample_rate_hz: float, factor: float, times_s: Floats
) -> Floats:
    """Samples ``factor`` times as long, at own times of the result, (n_times,).

    Parameters
    ----------
    samples : (n_before,)
        From own time 0 on.
    times_s : (n_times,)
        Rising.
    """
    ratio = sample_rate_hz / _RATE_HZ
    n = int(np.ceil(samples.size / ratio)) + 1
    fine = values_between(samples, np.arange(n, dtype=np.float64) * ratio, min(1.0, 1.0 / ratio))
    longer = _overlapped(fine, factor)
    places = times_s * _RATE_HZ
    return values_between(longer, places, min(1.0, ratio))


def _overlapped(fine: Floats, factor: float) -> Floats:
    """The signal with its pieces at other times, at the same rate, (n,)."""
    n = int(np.ceil(fine.size * factor))
    margin = _STEP + _SEARCH
    padded = np.concatenate((np.zeros(margin), fine, np.zeros(margin + 3 * _PIECE)))
    window = 0.5 * (1.0 - np.cos(2.0 * np.pi * np.arange(_PIECE) / _PIECE))
    # One piece begins before the start, so that the start itself is whole.
    found = np.zeros(n + 2 * _PIECE)
    # Pieces lie on samples; by how much the last one is late is made up for by the next.
    taken, late = -_STEP, 0.0
    found[:_PIECE] += window * padded[taken + margin :][:_PIECE]
    for number in range(1, n // _STEP + 2):
        # The middle of a piece lies where the factor says.
        place = min(int(np.rint(number * _STEP / factor)), fine.size) - _STEP
        wanted = padded[min(taken + _STEP, fine.size) + margin :][:_PIECE]
        near = padded[place + margin - _SEARCH :][: _PIECE + 2 * _SEARCH]
        ideal = place + _best(wanted, near) - late
        taken = int(np.clip(np.rint(ideal), place - _SEARCH, place + _SEARCH))
        late = float(np.clip(taken - ideal, -0.5, 0.5))
        start = number * _STEP
        found[start : start + _PIECE] += window * padded[taken + margin :][:_PIECE]
    return found[_STEP : _STEP + n]


def _best(wanted: Floats, near: Floats) -> float:
    """How far from the middle of ``near`` the piece lies that is most like ``wanted``."""
    if not wanted.any():
        return 0.0
    alike = scipy.signal.correlate(near, wanted, mode="valid", method="fft")
    energy = np.concatenate(([0.0], np.cumsum(near * near)))
    energy = energy[_PIECE:] - energy[:-_PIECE]
    far = np.abs(np.arange(alike.size) - _SEARCH) / _SEARCH
    enough = energy > 1e-12 * energy.max(initial=0.0)
    score = np.where(enough, alike / np.sqrt(np.where(enough, energy, 1.0)), -np.inf)
    score = score / np.sqrt(wanted @ wanted) - _FAR * far
    best = int(np.argmax(score))
    return best - _SEARCH + _top(score[max(best - 1, 0) : best + 2])


def _top(three: Floats) -> float:
    """Where the parabola through a largest value and its neighbours is highest, -0.5 to 0.5."""
    if three.size < 3 or not np.isfinite(three).all():
        return 0.0
    bend = three[0] - 2.0 * three[1] + three[2]
    return float(np.clip(0.5 * (three[0] - three[2]) / bend, -0.5, 0.5)) if bend < 0.0 else 0.0
