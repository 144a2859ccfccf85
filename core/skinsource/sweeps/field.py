"""Vibrations of one stimulus after another, which have some of their inputs in common.

What neighbours have in common is summed once.  The rest is added output by output, and its moments
are taken while it is still in the cache of the core: that is what the time of a sweep goes into.
"""

from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Complexes
from skinsource.job import Stop
from skinsource.rendering.drives import delayed
from skinsource.rendering.moments import Moments, moments_of
from skinsource.rendering.placed import Placed
from skinsource.rendering.responses import Responses
from skinsource.rendering.sums import add_up
from skinsource.rendering.total_spectrum import TotalSpectrum

# One thread has the cache to itself; smaller pieces cost more calls than they save.
_OUTPUTS_AT_ONCE = 36


@dataclass(frozen=True, slots=True, eq=False)
class Field:
    """The vibration of all outputs by one stimulus.

    Attributes
    ----------
    spectrum
        Its spectrum; what it holds lasts until the next one is made.
    moments
        Sums over time of products of axes.
    """

    spectrum: TotalSpectrum
    moments: Moments


class Common:
    """What the inputs that do not vary cause together; it is remembered."""

    def __init__(self) -> None:
        self._known: tuple[Responses, tuple[Placed, ...], Complexes | None] | None = None

    def spectrum(
        self, responses: Responses, moving: tuple[Placed, ...], stop: Stop
    ) -> Complexes | None:
        """Spectrum of all outputs, the same object for the same inputs; None for none."""
        known = self._known
        if known is None or known[0] != responses or not same(known[1], moving):
            values, drives = terms(responses, moving, stop)
            spectrum = None
            if values:
                spectrum = np.empty(values[0].shape, np.complex128)
                for part in _parts_of(len(spectrum)):
                    add_up([one[part] for one in values], drives, spectrum[part])
            known = self._known = responses, moving, spectrum
        return known[2]


class Fields:
    """Makes fields; remembers what the inputs that do not vary cause.

    Parameters
    ----------
    varying
        Ids of the inputs that vary from one stimulus to the next.  The sum is made in an order that
        follows from them alone, so that the last bit does not depend on what was made before.
    """

    def __init__(self, varying: frozenset[int]) -> None:
        self._varying = varying
        self._common = Common()
        self._room = np.empty((0, 0, 0), np.complex128)

    def of(
        self,
        responses: Responses,
        placed: tuple[Placed, ...],
        stop: Stop,
        *,
        products: bool,
    ) -> Field | None:
        """Return the field of voices; None where they are too long to be transformed at once.

        Parameters
        ----------
        products
            Whether the moments of different axes are wanted.
        """
        if responses.n_fft is None:
            return None
        moving = tuple(one for one in placed if one.moves)
        alone = tuple(one for one in moving if one.voice.id in self._varying)
        rest = tuple(one for one in moving if one.voice.id not in self._varying)
        common = self._common.spectrum(responses, rest, stop)
        values, drives = terms(responses, alone, stop)
        limb = responses.limb
        shape = limb.n_outputs, limb.n_axes, responses.n_fft // 2 + 1
        if self._room.shape != shape:
            self._room = np.empty(shape, np.complex128)
        parts = []
        for part in _parts_of(limb.n_outputs):
            total = self._room[part]
            if values:
                add_up([one[part] for one in values], drives, total)
                if common is not None:
                    total += common[part]
            else:
                total[...] = 0.0 if common is None else common[part]
            parts.append(moments_of(total, responses.n_fft, products=products))
        moments = Moments(
            np.concatenate([one.second for one in parts]),
            np.concatenate([one.first for one in parts]),
        )
        spectrum = TotalSpectrum(
            shape=shape,
            n_fft=responses.n_fft,
            others=self._room,
            response=None,
            drive=None,
            weight=0.0,
        )
        return Field(spectrum, moments)


def _parts_of(n_outputs: int) -> list[slice]:
    return [slice(low, low + _OUTPUTS_AT_ONCE) for low in range(0, n_outputs, _OUTPUTS_AT_ONCE)]


def same(left: tuple[Placed, ...], right: tuple[Placed, ...]) -> bool:
    """Whether inputs play the same, at the same place and time and as strong."""
    return len(left) == len(right) and all(
        a is b or (a.drive is b.drive and a.start == b.start and a.voice == b.voice)
        for a, b in zip(left, right, strict=True)
    )


def terms(
    responses: Responses, moving: tuple[Placed, ...], stop: Stop
) -> tuple[list[Complexes], list[Complexes]]:
    """Spectra of the responses, and of the drives with onset and weight, of some voices."""
    if responses.n_fft is None or not moving:
        return [], []
    to_places = responses.to(one.voice.location for one in moving)
    sounding = [one.sounding(to) for one, to in zip(moving, to_places, strict=True)]
    gains = responses.gains(sounding, stop)
    drives = [
        delayed(responses.drive_spectrum(one.voice.unit, one.drive), one.start, responses.n_fft)
        * (one.voice.amplitude * gain)
        for one, gain in zip(moving, gains, strict=True)
    ]
    return [to.values for to in to_places], drives
