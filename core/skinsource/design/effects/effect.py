"""What every effect can do."""

from typing import ClassVar, Protocol, runtime_checkable

import numpy as np
import scipy

from skinsource.base.arrays import Floats
from skinsource.signals.sampling import values_between
from skinsource.specs.spec import SwitchSpec

#: Specification of the field `on`.
ON = SwitchSpec(label="On", hint="An effect that is off changes nothing")


@runtime_checkable
class Effect(Protocol):
    """A frozen dataclass that changes samples.

    Sample k of what it takes and of what it gives lies at the own time ``k / rate - shift_s``,
    with a ``shift_s`` of 0 to less than a sample: a clip that does not start on a sample is drawn
    at its own instants.  What plays is 0 before own time 0, and from its duration on.

    Attributes
    ----------
    title
        What a user calls it.
    """

    title: ClassVar[str]

    @property
    def on(self) -> bool:
        """Whether it takes part."""

    def length(self, duration_s: float) -> float:
        """How long it plays what plays ``duration_s``; 0 or more."""

    def shift_before(self, shift_s: float, duration_s: float, sample_rate_hz: float) -> float:
        """Shift of the samples that it takes, so that what it gives has the shift ``shift_s``.

        They differ where own time 0 is not kept: what begins at 10.3 samples of something is, on
        whole samples of its own, something drawn 0.7 samples later.

        Parameters
        ----------
        duration_s
            How long plays what it takes.
        """

    def applied(
        self,
        samples: Floats,
        sample_rate_hz: float,
        shift_s: float = 0.0,
        duration_s: float | None = None,
    ) -> Floats:
        """Return the changed samples, (n_after,); ``samples`` stay as they are.

        Parameters
        ----------
        samples : (n_times,)
            What it is applied to, drawn at ``shift_before(shift_s, …)``.
        shift_s
            Shift of what is returned.
        duration_s
            How long plays what it is applied to; None: as long as there are samples.
        """


class KeepsTime:
    """What effects share that neither move nor stretch time."""

    __slots__ = ()

    def length(self, duration_s: float) -> float:
        """How long it plays what plays ``duration_s``: as long."""
        return duration_s

    def shift_before(self, shift_s: float, duration_s: float, sample_rate_hz: float) -> float:
        """Shift of the samples that it takes: the same."""
        del duration_s, sample_rate_hz
        return shift_s


def own_duration_s(
    samples: Floats, sample_rate_hz: float, shift_s: float, duration_s: float | None
) -> float:
    """Return ``duration_s``; where there is none, that of the samples."""
    if duration_s is not None:
        return duration_s
    return max(samples.size - (shift_s > 0.0), 0) / sample_rate_hz


# Another length with the same frequencies: pieces that overlap where they continue each other.

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
    overlapped = np.zeros(n + 2 * _PIECE)
    # Pieces lie on samples; by how much the last one is late is made up for by the next.
    source, lag = -_STEP, 0.0
    overlapped[:_PIECE] += window * padded[source + margin :][:_PIECE]
    for number in range(1, n // _STEP + 2):
        # The middle of a piece lies where the factor says.
        place = min(int(np.rint(number * _STEP / factor)), fine.size) - _STEP
        continuation = padded[min(source + _STEP, fine.size) + margin :][:_PIECE]
        near = padded[place + margin - _SEARCH :][: _PIECE + 2 * _SEARCH]
        ideal = place + _best(continuation, near) - lag
        source = int(np.clip(np.rint(ideal), place - _SEARCH, place + _SEARCH))
        lag = float(np.clip(source - ideal, -0.5, 0.5))
        start = number * _STEP
        overlapped[start : start + _PIECE] += window * padded[source + margin :][:_PIECE]
    return overlapped[_STEP : _STEP + n]


def _best(continuation: Floats, near: Floats) -> float:
    """How far from the middle of ``near`` the piece lies that is most like ``wanted``."""
    if not continuation.any():
        return 0.0
    similarity = scipy.signal.correlate(near, continuation, mode="valid", method="fft")
    energy = np.concatenate(([0.0], np.cumsum(near * near)))
    energy = energy[_PIECE:] - energy[:-_PIECE]
    far = np.abs(np.arange(similarity.size) - _SEARCH) / _SEARCH
    enough = energy > 1e-12 * energy.max(initial=0.0)
    score = np.where(enough, similarity / np.sqrt(np.where(enough, energy, 1.0)), -np.inf)
    score = score / np.sqrt(continuation @ continuation) - _FAR * far
    best = int(np.argmax(score))
    return best - _SEARCH + _top(score[max(best - 1, 0) : best + 2])


def _top(three: Floats) -> float:
    """Where the parabola through a largest value and its neighbours is highest, -0.5 to 0.5."""
    if three.size < 3 or not np.isfinite(three).all():
        return 0.0
    bend = three[0] - 2.0 * three[1] + three[2]
    return float(np.clip(0.5 * (three[0] - three[2]) / bend, -0.5, 0.5)) if bend < 0.0 else 0.0
