"""Vibrations of many stimuli which differ in what some inputs play, and in nothing else."""

from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from skinsource.arrays import Booleans, Complexes, Floats
from skinsource.job import Stop
from skinsource.rendering.moments import Moments, moments_of
from skinsource.rendering.placed import Placed
from skinsource.rendering.responses import Responses
from skinsource.sweeps.field import Common, same, terms
from skinsource.sweeps.prepared import Prepared, Preparing
from skinsource.sweeps.products import Products, multiplied

#: Fewer are not worth the matrices.
_FEWEST = 4
#: Matrices for so many numbers at a frequency; more are slower than to add up the vibrations.
_MOST_NUMBERS = 16
_MOST_BYTES = 256 * 2**20
#: Below this share of what its terms could be, the energy of an axis has lost digits: above it the
#: rounding of the terms keeps a level right to 1e-12.  It is then taken from the sum.
_CANCELLED = 1e-3
#: What inputs that stay as they are count as among those that vary.
_ALL_COMMON = 0


@dataclass(frozen=True, slots=True, eq=False)
class Vibrations:
    """The vibrations of all outputs by each of several stimuli.

    Attributes
    ----------
    moments
        Of all outputs of the first stimulus, then of those of the next one.
    n_fft
        Length of the transforms.
    sources
        Spectra of responses, (n_outputs, n_axes, n_bins), and of the drives of each stimulus,
        (n_stimuli, n_bins); None: no drive, the responses are the vibration.
    """

    moments: Moments
    n_fft: int
    sources: tuple[tuple[Complexes, Complexes | None], ...]

    def rows(self, stimuli: np.ndarray, outputs: np.ndarray, axes: tuple[int, ...]) -> Complexes:
        """Spectra of some outputs, each of one stimulus, both from 0: (n, n_axes, n_bins)."""
        total = np.zeros((len(outputs), len(axes), self.n_fft // 2 + 1), np.complex128)
        chosen = np.ix_(outputs, np.array(axes))
        for values, drives in self.sources:
            found = values[chosen]
            total += found if drives is None else found * drives[stimuli][:, None]
        return total


class Together:
    """Makes the vibrations of several stimuli at once; what they have in common is remembered."""

    def __init__(self, preparing: Preparing) -> None:
        self._preparing = preparing
        self._common = Common()
        self._common_now: Complexes | None = None
        self._common_moments: Moments | None = None
        self._responses: Responses | None = None
        self._products: Products | None = None

    def of(
        self, stimuli: Sequence[Prepared | None], stop: Stop, *, products: bool
    ) -> Vibrations | None:
        """Vibrations by ``stimuli``; None where they have too little in common.

        That, and every number, depends on nothing but the stimuli and their order.

        Parameters
        ----------
        stimuli
            None: one that cannot be; its numbers mean nothing.
        products
            Whether moments of different axes are wanted.
        """
        there = [one for one in stimuli if one is not None]
        if len(there) < _FEWEST or not all(_moves_as(one, there[0]) for one in there):
            return None
        split = _split(there)
        n_fft = there[0].n_fft(max(one.response_samples for one in there))
        if split is None or n_fft is None:
            return None
        fixed, places = split
        n_sources = len(places) + bool(fixed)
        if len(places) * (len(places) + 2 * bool(fixed)) > _MOST_NUMBERS or not n_sources:
            return None
        responses = self._preparing.responses(there[0], n_fft)
        self._begin(responses, products=products)
        common = self._common.spectrum(responses, fixed, stop)
        drives = {
            id: np.zeros((len(stimuli), n_fft // 2 + 1), np.complex128) for id in sorted(places)
        }
        for row, one in enumerate(stimuli):
            varying = [each for each in one.moving if each.voice.id in places] if one else []
            _, spectra = terms(responses, tuple(varying), stop)
            for each, spectrum in zip(varying, spectra, strict=True):
                drives[each.voice.id][row] = spectrum
        sources: list[_Source] = []
        if common is not None:
            sources.append(_Source(_ALL_COMMON, common, None))
        for id, (to,) in ((id, responses.to([places[id]])) for id in drives):
            sources.append(_Source(places[id], to.values, drives[id]))
        return self._vibrations(sources, len(stimuli), n_fft)

    def _begin(self, responses: Responses, *, products: bool) -> None:
        """Forget what was made of other responses."""
        if self._responses != responses or self._products is None:
            self._responses = responses
            self._products = Products(
                responses.n_fft or 0, responses.limb.n_axes, products=products
            )
            self._common_now = None

    def _vibrations(
        self, sources: "list[_Source]", n_stimuli: int, n_fft: int
    ) -> Vibrations | None:
        made = self._products
        values = sources[0].values
        n_pairs = len(sources) * (len(sources) - 1) // 2
        if made is None or made.n_bytes(len(sources), n_pairs, values) > _MOST_BYTES:
            return None
        self._forget(made, sources)
        found = np.zeros((n_stimuli, len(made.pairs), len(values)))
        n_axes = made.n_axes
        size = np.zeros((n_stimuli, n_axes, len(values)))
        first = np.zeros((n_stimuli, len(values), n_axes))
        for one in sources:
            if one.drives is None:
                alone = self._common_moments
                if alone is None:
                    alone = moments_of(one.values, n_fft, products=len(made.pairs) > n_axes)
                    self._common_moments = alone
                second = np.stack([alone.second[:, a, b] for a, b in made.pairs])[None]
                first += alone.first
            else:
                power = np.square(one.drives.real) + np.square(one.drives.imag)
                second = multiplied(made.own(one.key, one.values), power)
                first += one.drives[:, 0].real[:, None, None] * one.values[:, :, 0].real
            found += second
            size += np.sqrt(np.maximum(second[:, :n_axes], 0.0))
        for left, right in combinations(sources, 2):
            matrix = made.between((left.key, right.key), left.values, right.values)
            found += multiplied(matrix, left.with_conjugate_of(right).view(np.float64))
        second = _filled(found, made.pairs, n_axes)
        moments = Moments(second.reshape(-1, n_axes, n_axes), first.reshape(-1, n_axes))
        vibrations = Vibrations(moments, n_fft, tuple((one.values, one.drives) for one in sources))
        lost: Booleans = np.any(found[:, :n_axes] < _CANCELLED * np.square(size), axis=1)
        _mend(vibrations, lost, products=len(made.pairs) > n_axes)
        return vibrations

    def _forget(self, made: Products, sources: "list[_Source]") -> None:
        """Leave no more matrices than are in use."""
        common = sources[0].values if sources[0].drives is None else None
        keys: list[Hashable] = [one.key for one in sources]
        keys += [(a.key, b.key) for a, b in combinations(sources, 2)]
        if common is not self._common_now:
            keys = [key for key in keys if not isinstance(key, tuple) or key[0] != _ALL_COMMON]
            self._common_now, self._common_moments = common, None
        made.forget_all_but(keys)


@dataclass(frozen=True, slots=True, eq=False)
class _Source:
    """Responses to a place, the number of the place, and one drive for each stimulus."""

    key: int
    values: Complexes
    drives: Complexes | None

    def with_conjugate_of(self, other: "_Source") -> Complexes:
        """Products of the drives of each stimulus, (n_stimuli, n_bins)."""
        if other.drives is None:
            raise ValueError("what is in common comes first")
        conjugates = other.drives.conj()
        return conjugates if self.drives is None else self.drives * conjugates


def _moves_as(one: Prepared, other: Prepared) -> bool:
    """Whether responses are the same; a limb behind other actuators is another one."""
    return one.limb is other.limb and one.design.scaling == other.design.scaling


def _split(stimuli: list[Prepared]) -> tuple[tuple[Placed, ...], dict[int, int]] | None:
    """Inputs that all stimuli have alike, and the places of the others by id; None: they move."""
    by_id = [{each.voice.id: each for each in one.moving} for one in stimuli]
    fixed, places = [], {}
    for id in dict.fromkeys(id for one in by_id for id in one):
        found = [one[id] for one in by_id if id in one]
        if len(found) == len(stimuli) and all(same((found[0],), (one,)) for one in found[1:]):
            fixed.append(found[0])
        elif len({one.voice.location for one in found}) > 1:
            return None
        else:
            places[id] = found[0].voice.location
    return tuple(fixed), places


def _filled(found: Floats, pairs: tuple[tuple[int, int], ...], n_axes: int) -> Floats:
    """Matrices of second moments, (n_stimuli, n_outputs, n_axes, n_axes)."""
    second = np.zeros((len(found), found.shape[-1], n_axes, n_axes))
    for k, (a, b) in enumerate(pairs):
        second[:, :, a, b] = second[:, :, b, a] = found[:, k]
    return second


def _mend(vibrations: Vibrations, lost: Booleans, *, products: bool) -> None:
    """Take moments from the vibration itself where digits were lost, (n_stimuli, n_outputs)."""
    stimuli, outputs = np.nonzero(lost)
    if len(stimuli):
        every_axis = tuple(range(vibrations.moments.first.shape[1]))
        spectra = vibrations.rows(stimuli, outputs, every_axis)
        again = moments_of(spectra, vibrations.n_fft, products=products)
        which = stimuli * lost.shape[1] + outputs
        vibrations.moments.second[which] = again.second
        vibrations.moments.first[which] = again.first
