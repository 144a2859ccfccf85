"""Vibrations of one stimulus after another, which have some of their inputs in common.

What neighbours have in common is summed once.  The rest is added output by output, and its moments
are taken while it is still in the cache of the core: that is what the time of a sweep goes into.
"""

from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from skinsource.base.arrays import Booleans, Complexes, Floats
from skinsource.base.job import Stop
from skinsource.engine.drives import delayed
from skinsource.engine.gains import Placed, Responses
from skinsource.engine.moments import Moments, moments_of, pairs
from skinsource.engine.spectra import TotalSpectrum
from skinsource.engine.transforms import add_up
from skinsource.studies.sweeps.metrics import PreparedStimulus, Preparing

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
        if known is None or known[0] != responses or not same_voices(known[1], moving):
            values, drives = terms(responses, moving, stop)
            spectrum = None
            if values:
                spectrum = np.empty(values[0].shape, np.complex128)
                for part in _parts_of(len(spectrum)):
                    add_up([response[part] for response in values], drives, spectrum[part])
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
        moving = tuple(placed_voice for placed_voice in placed if placed_voice.moves)
        alone = tuple(
            placed_voice for placed_voice in moving if placed_voice.voice.id in self._varying
        )
        rest = tuple(
            placed_voice for placed_voice in moving if placed_voice.voice.id not in self._varying
        )
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
                add_up([response[part] for response in values], drives, total)
                if common is not None:
                    total += common[part]
            else:
                total[...] = 0.0 if common is None else common[part]
            parts.append(moments_of(total, responses.n_fft, products=products))
        moments = Moments(
            np.concatenate([part.second for part in parts]),
            np.concatenate([part.first for part in parts]),
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


def same_voices(left: tuple[Placed, ...], right: tuple[Placed, ...]) -> bool:
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
    to_places = responses.to(placed_voice.voice.location for placed_voice in moving)
    sounding = [
        placed_voice.sounding(to) for placed_voice, to in zip(moving, to_places, strict=True)
    ]
    gains = responses.gains(sounding, stop)
    drives = [
        delayed(
            responses.drive_spectrum(placed_voice.voice.unit, placed_voice.drive),
            placed_voice.start,
            responses.n_fft,
        )
        * (placed_voice.voice.amplitude * gain)
        for placed_voice, gain in zip(moving, gains, strict=True)
    ]
    return [to.values for to in to_places], drives


# Matrices from the spectra of drives to moments of what they cause together.
#
# The vibration by some drives is their sum, each times a response; its second moments are sums over
# pairs of drives of a product of their spectra, times a product of responses.  The products of
# responses are matrices that stay while drives change, and many stimuli are the columns that they
# are multiplied with: the responses are read once for all of them.

# Larger products are shared out among the threads of the linear algebra library, which wait for
# each other without sleeping; and the order of a sum would be a matter of their number.
_NUMBERS_AT_ONCE = 2**18
# Few whole rows at a time are quicker than parts of many: what they are multiplied with stays in
# the cache.  The library takes rows by so many.
_ROWS = 8


class Products:
    """Products of responses, which are made when they are asked for and stay for the next ones.

    Attributes
    ----------
    pairs
        Axes of each product: of each axis with itself, then of different ones.

    Parameters
    ----------
    n_fft
        Length of the transforms.
    n_axes
        Of each output.
    products
        Whether products of different axes are wanted.
    """

    def __init__(self, n_fft: int, n_axes: int, *, products: bool) -> None:
        self.n_axes = n_axes
        squares = tuple((axis, axis) for axis in range(n_axes))
        self.pairs = (*squares, *(pairs(n_axes) if products else ()))
        self._weights = np.full(n_fft // 2 + 1, 2.0 / n_fft)
        self._weights[[0, -1]] *= 0.5
        self._known: dict[Hashable, Floats] = {}

    def n_bytes(self, n_own: int, n_pairs: int, values: Complexes) -> int:
        """What so many matrices take, for responses such as ``values``."""
        return (n_own + 2 * n_pairs) * len(self.pairs) * len(values) * values.shape[-1] * 8

    def own(self, key: Hashable, values: Complexes) -> Floats:
        """Of responses with themselves, (n_products, n_outputs, n_bins), for powers of a drive.

        Parameters
        ----------
        key
            What tells ``values`` from others.
        values : (n_outputs, n_axes, n_bins)
            Spectra of responses.
        """
        known = self._known.get(key)
        if known is None:
            known = np.empty((len(self.pairs), len(values), values.shape[-1]))
            for k, (a, b) in enumerate(self.pairs):
                left, right = values[:, a], values[:, b]
                known[k] = (left.real * right.real + left.imag * right.imag) * self._weights
            self._known[key] = known
        return known

    def between(self, keys: tuple[Hashable, Hashable], left: Complexes, right: Complexes) -> Floats:
        """Of two responses, (n_products, n_outputs, 2 n_bins).

        For products of the left drive and the conjugate of the right one, real and imaginary parts
        in turn: what the two cause together beside what each causes alone.
        """
        known = self._known.get(keys)
        if known is None:
            made = np.empty((len(self.pairs), len(left), left.shape[-1]), np.complex128)
            conjugate = left.conj()
            for k, (a, b) in enumerate(self.pairs):
                np.multiply(conjugate[:, a], right[:, b], out=made[k])
                made[k] += right[:, a] * conjugate[:, b]
                made[k] *= self._weights
            known = self._known[keys] = made.view(np.float64)
        return known

    def forget_all_but(self, keys: Iterable[Hashable]) -> None:
        """Keep only these matrices."""
        wanted = set(keys)
        self._known = {key: matrix for key, matrix in self._known.items() if key in wanted}


def multiplied(matrix: Floats, columns: Floats) -> Floats:
    """Sums over the last axis, (n_columns, n_products, n_outputs), by one thread.

    Parameters
    ----------
    matrix : (n_products, n_outputs, n)
    columns : (n_columns, n)
        Each sum is the same whatever stands in the other columns.
    """
    n_columns, n = columns.shape
    rows = matrix.reshape(-1, n)
    sums = np.zeros((n_columns, len(rows)))
    step = min(max(_NUMBERS_AT_ONCE // (n_columns * _ROWS), 1), n)
    at_once = _ROWS * max(_NUMBERS_AT_ONCE // (n_columns * _ROWS * step), 1)
    for low in range(0, n, step):
        part = columns[:, low : low + step]
        for row in range(0, len(rows), at_once):
            sums[:, row : row + at_once] += part @ rows[row : row + at_once, low : low + step].T
    return sums.reshape(n_columns, *matrix.shape[:2])


# Vibrations of many stimuli which differ in what some inputs play, and in nothing else.

#: Fewer are not worth the matrices.
_LEAST_STIMULI = 4
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
            responses = values[chosen]
            total += responses if drives is None else responses * drives[stimuli][:, None]
        return total


class Batch:
    """Makes the vibrations of several stimuli at once; what they have in common is remembered."""

    def __init__(self, preparing: Preparing) -> None:
        self._preparing = preparing
        self._common = Common()
        self._common_now: Complexes | None = None
        self._common_moments: Moments | None = None
        self._responses: Responses | None = None
        self._products: Products | None = None

    def of(
        self, stimuli: Sequence[PreparedStimulus | None], stop: Stop, *, products: bool
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
        there = [stimulus for stimulus in stimuli if stimulus is not None]
        if len(there) < _LEAST_STIMULI or not all(
            _has_same_responses(stimulus, there[0]) for stimulus in there
        ):
            return None
        split = _split(there)
        n_fft = there[0].n_fft(max(stimulus.response_samples for stimulus in there))
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
        for row, stimulus in enumerate(stimuli):
            varying = (
                [each for each in stimulus.moving if each.voice.id in places] if stimulus else []
            )
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
        totals = np.zeros((n_stimuli, len(made.pairs), len(values)))
        n_axes = made.n_axes
        size = np.zeros((n_stimuli, n_axes, len(values)))
        first = np.zeros((n_stimuli, len(values), n_axes))
        for source in sources:
            if source.drives is None:
                alone = self._common_moments
                if alone is None:
                    alone = moments_of(source.values, n_fft, products=len(made.pairs) > n_axes)
                    self._common_moments = alone
                second = np.stack([alone.second[:, a, b] for a, b in made.pairs])[None]
                first += alone.first
            else:
                power = np.square(source.drives.real) + np.square(source.drives.imag)
                second = multiplied(made.own(source.key, source.values), power)
                first += source.drives[:, 0].real[:, None, None] * source.values[:, :, 0].real
            totals += second
            size += np.sqrt(np.maximum(second[:, :n_axes], 0.0))
        for left, right in combinations(sources, 2):
            matrix = made.between((left.key, right.key), left.values, right.values)
            totals += multiplied(matrix, left.with_conjugate_of(right).view(np.float64))
        second = _symmetric(totals, made.pairs, n_axes)
        moments = Moments(second.reshape(-1, n_axes, n_axes), first.reshape(-1, n_axes))
        vibrations = Vibrations(
            moments, n_fft, tuple((source.values, source.drives) for source in sources)
        )
        lost: Booleans = np.any(totals[:, :n_axes] < _CANCELLED * np.square(size), axis=1)
        _repair(vibrations, lost, products=len(made.pairs) > n_axes)
        return vibrations

    def _forget(self, made: Products, sources: "list[_Source]") -> None:
        """Leave no more matrices than are in use."""
        common = sources[0].values if sources[0].drives is None else None
        keys: list[Hashable] = [source.key for source in sources]
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


def _has_same_responses(stimulus: PreparedStimulus, other: PreparedStimulus) -> bool:
    """Whether responses are the same; a limb behind other actuators is another one."""
    return stimulus.limb is other.limb and stimulus.design.scaling == other.design.scaling


def _split(stimuli: list[PreparedStimulus]) -> tuple[tuple[Placed, ...], dict[int, int]] | None:
    """Inputs that all stimuli have alike, and the places of the others by id; None: they move."""
    by_id = [{each.voice.id: each for each in stimulus.moving} for stimulus in stimuli]
    fixed, places = [], {}
    for id in dict.fromkeys(id for by_number in by_id for id in by_number):
        variants = [placed_by_id[id] for placed_by_id in by_id if id in placed_by_id]
        if len(variants) == len(stimuli) and all(
            same_voices((variants[0],), (variant,)) for variant in variants[1:]
        ):
            fixed.append(variants[0])
        elif len({variant.voice.location for variant in variants}) > 1:
            return None
        else:
            places[id] = variants[0].voice.location
    return tuple(fixed), places


def _symmetric(totals: Floats, pairs: tuple[tuple[int, int], ...], n_axes: int) -> Floats:
    """Matrices of second moments, (n_stimuli, n_outputs, n_axes, n_axes)."""
    second = np.zeros((len(totals), totals.shape[-1], n_axes, n_axes))
    for k, (a, b) in enumerate(pairs):
        second[:, :, a, b] = second[:, :, b, a] = totals[:, k]
    return second


def _repair(vibrations: Vibrations, lost: Booleans, *, products: bool) -> None:
    """Take moments from the vibration itself where digits were lost, (n_stimuli, n_outputs)."""
    stimuli, outputs = np.nonzero(lost)
    if len(stimuli):
        every_axis = tuple(range(vibrations.moments.first.shape[1]))
        spectra = vibrations.rows(stimuli, outputs, every_axis)
        again = moments_of(spectra, vibrations.n_fft, products=products)
        which = stimuli * lost.shape[1] + outputs
        vibrations.moments.second[which] = again.second
        vibrations.moments.first[which] = again.first
