"""The protocol of effects, and stretching in time without a change of frequencies.

`stretched_in_time` is WSOLA: overlapping pieces move to other times, each to where it continues
the one before best.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar, Protocol, runtime_checkable

import numpy as np
import scipy

from skinsource.base.conventions import Floats
from skinsource.signals.analysis.wave_speed import vertex
from skinsource.signals.sampling import values_between
from skinsource.specs.models import CheckedModel
from skinsource.specs.spec import SwitchSpec

#: Specification of the field `on`.
ON = SwitchSpec(label="On", hint="An effect that is off changes nothing")


@runtime_checkable
class Effect(Protocol):
    """A frozen dataclass that changes samples.

    Samples before and after the effect have an own time: sample k lies at ``k / rate - shift_s``,
    where ``shift_s`` is 0 up to less than a sample, because a clip can start between two samples.
    The signal is 0 before own time 0, and from its duration on.  ``title`` is the name for the
    user.
    """

    title: ClassVar[str]

    @property
    def on(self) -> bool:
        """Whether the effect is applied."""

    def length(self, duration_s: float) -> float:
        """Return the duration after the effect of a signal of ``duration_s``; 0 or more."""

    def shift_before(self, shift_s: float, duration_s: float, sample_rate_hz: float) -> float:
        """Return the shift of the samples before the effect for the shift ``shift_s`` after it.

        They differ if the effect moves own time 0: a part that begins at 10.3 samples and must lie
        on whole samples needs a signal that is drawn 0.7 samples later.

        Parameters
        ----------
        duration_s
            Duration of the signal before the effect.
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
            Samples before the effect, with the shift ``shift_before(shift_s, …)``.
        shift_s
            Shift of the returned samples.
        duration_s
            Duration of the signal before the effect; None: that of the samples.
        """


class TimedEffect(CheckedModel, ABC):
    """Base of effects, which get samples with their duration, and none without samples."""

    __slots__ = ()

    @abstractmethod
    def shift_before(self, shift_s: float, duration_s: float, sample_rate_hz: float) -> float:
        """Return the shift before the effect, see `Effect`."""

    def applied(
        self,
        samples: Floats,
        sample_rate_hz: float,
        shift_s: float = 0.0,
        duration_s: float | None = None,
    ) -> Floats:
        """Return the changed samples, (n_after,); ``samples`` stay as they are.

        Raises
        ------
        InvalidInputError
            They would take more than an hour.
        """
        if not samples.size:
            return samples
        before_s = self.shift_before(shift_s, 0.0, sample_rate_hz)
        own_s = own_duration_s(samples, sample_rate_hz, before_s, duration_s)
        return self._changed(samples, sample_rate_hz, shift_s, own_s)

    @abstractmethod
    def _changed(self, samples: Floats, rate_hz: float, shift_s: float, own_s: float) -> Floats:
        """Return the changed samples of a signal of ``own_s``."""


class KeepsTime(CheckedModel):
    """Base of effects that neither move nor stretch time."""

    __slots__ = ()

    def length(self, duration_s: float) -> float:
        """Return ``duration_s`` itself."""
        return duration_s

    def shift_before(self, shift_s: float, duration_s: float, sample_rate_hz: float) -> float:
        """Return ``shift_s`` itself."""
        return shift_s


def own_duration_s(
    samples: Floats, sample_rate_hz: float, shift_s: float, duration_s: float | None
) -> float:
    """Return ``duration_s``, or if it is None the duration of the samples.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.effects.own_duration_s(ss.sinusoid(100.0, 0.1), 1300.0, 0.0, None))
    0.1
    """
    if duration_s is not None:
        return duration_s
    return max(samples.size - (shift_s > 0.0), 0) / sample_rate_hz


# Pieces are compared at this rate, whatever the rate of the samples: at 1300 Hz a step of one
# sample would be almost half a turn of 600 Hz.
_RATE_HZ = 20_800.0
_STEP = 416  # 20 ms
_PIECE = 2 * _STEP
#: How far from its regular place a piece can be taken: half a turn of 25 Hz.
_SEARCH = 416
# How much better a piece at that distance has to fit than one at its regular place.
_DISTANCE_PENALTY = 0.02


def stretched_in_time(
    samples: Floats, sample_rate_hz: float, factor: float, times_s: Floats
) -> Floats:
    """Return the signal ``factor`` times as long, at own times of the result, (n_times,).

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
    """Return the signal with its pieces moved to other times, at the same rate, (n,)."""
    n = int(np.ceil(fine.size * factor))
    margin = _STEP + _SEARCH
    padded = np.concatenate((np.zeros(margin), fine, np.zeros(margin + 3 * _PIECE)))
    window = 0.5 * (1.0 - np.cos(2.0 * np.pi * np.arange(_PIECE) / _PIECE))
    # The first piece begins before the start, so that the start has two pieces as well.
    overlapped = np.zeros(n + 2 * _PIECE)
    # Pieces lie on samples; the next piece makes up for the rounding of the last one.
    source, lag = -_STEP, 0.0
    overlapped[:_PIECE] += window * padded[source + margin :][:_PIECE]
    for number in range(1, n // _STEP + 2):
        # The factor gives the regular place of the middle of a piece.
        place = min(int(np.rint(number * _STEP / factor)), fine.size) - _STEP
        continuation = padded[min(source + _STEP, fine.size) + margin :][:_PIECE]
        near = padded[place + margin - _SEARCH :][: _PIECE + 2 * _SEARCH]
        ideal = place + _best_offset(continuation, near) - lag
        source = int(np.clip(np.rint(ideal), place - _SEARCH, place + _SEARCH))
        lag = float(np.clip(source - ideal, -0.5, 0.5))
        start = number * _STEP
        overlapped[start : start + _PIECE] += window * padded[source + margin :][:_PIECE]
    return overlapped[_STEP : _STEP + n]


def _best_offset(continuation: Floats, near: Floats) -> float:
    """Return how far from the middle of ``near`` the best piece to continue with lies."""
    if not continuation.any():
        return 0.0
    similarity = scipy.signal.correlate(near, continuation, mode="valid", method="fft")
    energy = np.concatenate(([0.0], np.cumsum(near * near)))
    energy = energy[_PIECE:] - energy[:-_PIECE]
    far = np.abs(np.arange(similarity.size) - _SEARCH) / _SEARCH
    enough = energy > 1e-12 * energy.max(initial=0.0)
    score = np.where(enough, similarity / np.sqrt(np.where(enough, energy, 1.0)), -np.inf)
    score = score / np.sqrt(continuation @ continuation) - _DISTANCE_PENALTY * far
    best = int(np.argmax(score))
    three = score[max(best - 1, 0) : best + 2]
    beside = vertex(three) if three.size == 3 and np.isfinite(three).all() else 0.0
    return best - _SEARCH + beside
