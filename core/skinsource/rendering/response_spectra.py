"""Spectra of impulse responses, by place and length, in bounded memory."""

import mmap
import sys
from collections import OrderedDict
from dataclasses import dataclass
from functools import cached_property
from math import prod
from weakref import ref

import numpy as np

from skinsource.arrays import Complexes, Floats
from skinsource.chain import LARGEST, first_unusable
from skinsource.errors import InvalidInputError
from skinsource.limb import Limb
from skinsource.rendering.budgets import RESPONSE_SPECTRA_BYTES
from skinsource.rendering.transforms import forward
from skinsource.scaling.calibration import per_probe_acceleration
from skinsource.scaling.response_scaling import Scaling

#: Taps at which responses are cut for bounds by energy: finely where most of it is.
SECTIONS = (0, 32, 64, 96, 128, 192, 256)
#: Bins of a band, over which responses, shorter than the transform, change little.
BAND_BINS = 8


@dataclass(frozen=True, eq=False)
class ResponseSpectrum:
    """Responses to one place, in time and in frequency.

    Attributes
    ----------
    taps : (n_outputs, 3 axes, n_taps)
        m/s².
    values : (n_outputs, 3 axes, n_fft // 2 + 1)
        Their spectra.
    """

    taps: Floats
    values: Complexes
    n_fft: int

    @cached_property
    def rows(self) -> Complexes:
        """The spectra, one row for each channel, (n_channels, n_bins)."""
        return self.values.reshape(-1, self.values.shape[-1])

    @cached_property
    def band_magnitudes(self) -> Floats:
        """Largest magnitude in each band of bins, (n_channels, n_bands), for bounds of samples.

        Divided by n_fft and doubled but for the ends, as in the inverse transform.
        """
        magnitudes = np.abs(self.rows)
        magnitudes[:, [0, -1]] *= 0.5
        # Bin by bin over all bands at once: quicker than band by band.
        bands = magnitudes[:, ::BAND_BINS].copy()
        for k in range(1, BAND_BINS):
            bins = magnitudes[:, k::BAND_BINS]
            reached = bands[:, : bins.shape[-1]]
            np.maximum(reached, bins, out=reached)
        bands *= 2.0 / self.n_fft
        return bands

    @cached_property
    def section_norms(self) -> Floats:
        """Root of the sum of squares of each section of each response, (n_channels, n_sections)."""
        squares = np.square(self.taps.reshape(-1, self.taps.shape[-1]))
        return np.sqrt(np.add.reduceat(squares, self._sections, axis=-1))

    def prepare_bounds(self) -> None:
        """Compute now what bounds of samples need."""
        for _ in (self.band_magnitudes, self.section_norms, self.absolute_sums, self.energies):
            pass

    @property
    def section_lengths(self) -> tuple[int, ...]:
        """Taps in each section."""
        ends = (*self._sections[1:], self.taps.shape[-1])
        return tuple(end - begin for begin, end in zip(self._sections, ends, strict=True))

    @property
    def _sections(self) -> tuple[int, ...]:
        return tuple(tap for tap in SECTIONS if tap < self.taps.shape[-1])

    @cached_property
    def energies(self) -> Floats:
        """Root of the sum of squares of each response, (n_channels,)."""
        return np.linalg.norm(self.taps.reshape(-1, self.taps.shape[-1]), axis=-1)

    @cached_property
    def absolute_sums(self) -> Floats:
        """Sum of magnitudes of each response, (n_channels,)."""
        return np.abs(self.taps.reshape(-1, self.taps.shape[-1])).sum(axis=-1)


class _Places:
    """Spectra at one length, made place by place.

    They lie in one piece of memory, which the system serves in large pages (a sum over twenty
    places is twice as fast then).
    """

    def __init__(self, limb: Limb, n_fft: int) -> None:
        self._n_fft = n_fft
        shape = limb.n_inputs, limb.n_outputs, limb.n_axes, n_fft // 2 + 1
        self._values = _room(shape)
        self._known: dict[int, ResponseSpectrum] = {}

    @property
    def held_bytes(self) -> int:
        return len(self._known) * self._values[0].nbytes

    def of(self, limb: Limb, location: int, scaling: Scaling) -> ResponseSpectrum:
        if location not in self._known:
            taps = scaled_taps(limb, location, scaling)
            values = self._values[location - 1]
            values[:] = forward(taps, self._n_fft)
            self._known[location] = ResponseSpectrum(taps, values, self._n_fft)
        return self._known[location]


def _room(shape: tuple[int, ...]) -> Complexes:
    """Memory that is served when it is touched; what never is takes none.

    It comes from the system directly: memory that was in use before is all there, touched or not.
    """
    memory = mmap.mmap(-1, prod(shape) * np.dtype(np.complex128).itemsize)
    if sys.platform == "linux":
        memory.madvise(mmap.MADV_HUGEPAGE)
    return np.frombuffer(memory, np.complex128).reshape(shape)


@dataclass(frozen=True, slots=True, eq=False)
class Stack:
    """Spectra of the responses to some places, frequency by frequency, for matrix products.

    Attributes
    ----------
    values : (n_fft // 2 + 1, n_places, n_channels)
        The spectra.
    responses
        The same, place by place.
    """

    values: Complexes
    responses: dict[int, ResponseSpectrum]

    @property
    def held_bytes(self) -> int:
        """What the spectra take in memory."""
        return self.values.nbytes


# Limb, whether calibrated, length, and the places of a stack.
_Key = tuple[ref[Limb], bool, int, tuple[int, ...]]


class ResponseSpectra:
    """Spectra by limb, place, scaling and length; the least recently used lengths go first."""

    def __init__(self, budget_bytes: int = RESPONSE_SPECTRA_BYTES) -> None:
        self._budget_bytes = budget_bytes
        self._held: OrderedDict[_Key, _Places | Stack] = OrderedDict()

    @property
    def held_bytes(self) -> int:
        """What the spectra take in memory."""
        return sum(one.held_bytes for one in self._held.values())

    def of(self, limb: Limb, location: int, scaling: Scaling, n_fft: int) -> ResponseSpectrum:
        """Responses to ``location``; under ``"probe"`` scaling the calibrated ones."""
        # A limb is the object, not the name: after a reinstall the name means other data.  What is
        # remembered of it does not keep all its responses in memory.
        key: _Key = ref(limb), scaling == "probe", n_fft, ()
        places = self._held.get(key)
        if not isinstance(places, _Places):
            places = _Places(limb, n_fft)
        response = places.of(limb, location, scaling)
        self._keep(key, places)
        return response

    def stack(self, limb: Limb, places: tuple[int, ...], scaling: Scaling, n_fft: int) -> Stack:
        """Responses to ``places`` for matrix products."""
        key: _Key = ref(limb), scaling == "probe", n_fft, places
        stack = self._held.get(key)
        if not isinstance(stack, Stack):
            stack = _stack(limb, places, scaling, n_fft)
        self._keep(key, stack)
        return stack

    def _keep(self, key: _Key, latest: _Places | Stack) -> None:
        self._forget_lost_limbs()
        self._held[key] = latest
        self._held.move_to_end(key)
        while len(self._held) > 1 and self.held_bytes > self._budget_bytes:
            self._held.popitem(last=False)

    def _forget_lost_limbs(self) -> None:
        """Nobody can ask for spectra of a limb that is gone."""
        for key in [key for key in self._held if key[0]() is None]:
            del self._held[key]


def scaled_taps(limb: Limb, location: int, scaling: Scaling) -> Floats:
    """Responses to ``location``, (n_outputs, 3, n_taps); refused where one is no usable number."""
    taps = limb.response_to(location)
    bad = first_unusable(taps)
    if bad is not None:
        output, axis, tap = bad
        raise InvalidInputError(
            f"{limb.name}: in the response to input location {location}, output {output + 1}, axis "
            f"{'xyz'[axis]}, tap {tap} is {taps[bad]}, expected a finite number of at most "
            f"{LARGEST:g}. Install or load the limb again."
        )
    return per_probe_acceleration(taps, limb.sample_rate_hz) if scaling == "probe" else taps


def _stack(limb: Limb, places: tuple[int, ...], scaling: Scaling, n_fft: int) -> Stack:
    n_bins, n_channels = n_fft // 2 + 1, limb.n_outputs * limb.n_axes
    values = np.empty((n_bins, len(places), n_channels), np.complex128)
    responses = {}
    for row, place in enumerate(places):
        taps = scaled_taps(limb, place, scaling)
        values[:, row] = forward(taps.reshape(n_channels, -1), n_fft).T
        by_channel = values[:, row].T.reshape(limb.n_outputs, limb.n_axes, n_bins)
        responses[place] = ResponseSpectrum(taps, by_channel, n_fft)
    return Stack(values, responses)
