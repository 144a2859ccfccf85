"""Vibrations of the stimuli of a batch, which have some of their inputs in common.

The common inputs are summed once.  The others are added output by output, and their moments are
computed while they are in the cache of the core: most of the time of a sweep goes into this.

Many stimuli are computed by matrices.  The vibration by some drives is their sum, each times a
response; its second moments are sums over pairs of drives of a product of their spectra, times a
product of responses.  The products of responses are matrices that stay while drives change, and the
stimuli are the columns that they are multiplied with: the responses are read once for all of them.
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

# So many outputs fit into the cache of one thread; smaller pieces cost more calls than they save.
_OUTPUTS_AT_ONCE = 36


@dataclass(frozen=True, slots=True, eq=False)
class Field:
    """The vibration of all outputs by one stimulus.

    Attributes
    ----------
    spectrum
        Its spectrum; the next field overwrites its values.
    moments
        Sums over time of products of axes.
    """

    spectrum: TotalSpectrum
    moments: Moments


class Common:
    """Computes the vibration by the inputs that do not vary, and caches it."""

    def __init__(self) -> None:
        self._cached: tuple[Responses, tuple[Placed, ...], Complexes | None] | None = None

    def spectrum(
        self, responses: Responses, moving: tuple[Placed, ...], stop: Stop
    ) -> Complexes | None:
        """Return the spectrum of all outputs, the same object for the same inputs; None: none."""
        cached = self._cached
        if cached is None or cached[0] != responses or not same_voices(cached[1], moving):
            values, drives = terms(responses, moving, stop)
            spectrum = None
            if values:
                spectrum = np.empty(values[0].shape, np.complex128)
                for part in _parts_of(len(spectrum)):
                    add_up([response[part] for response in values], drives, spectrum[part])
            cached = self._cached = responses, moving, spectrum
        return cached[2]


class Fields:
    """Computes fields; caches the vibration by the inputs that do not vary.

    Parameters
    ----------
    varying
        Ids of the inputs that vary from one stimulus to the next.  The order of the sum follows
        from them alone, so that the last bit does not depend on earlier stimuli.
    """

    def __init__(self, varying: frozenset[int]) -> None:
        self._varying = varying
        self._common = Common()
        self._buffer = np.empty((0, 0, 0), np.complex128)

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
            Whether the moments of different axes are needed.
        """
        if responses.n_fft is None:
            return None
        moving = tuple(placed_voice for placed_voice in placed if placed_voice.moves)
        varying = tuple(
            placed_voice for placed_voice in moving if placed_voice.voice.id in self._varying
        )
        rest = tuple(
            placed_voice for placed_voice in moving if placed_voice.voice.id not in self._varying
        )
        common = self._common.spectrum(responses, rest, stop)
        values, drives = terms(responses, varying, stop)
        limb = responses.limb
        shape = limb.n_outputs, limb.n_axes, responses.n_fft // 2 + 1
        if self._buffer.shape != shape:
            self._buffer = np.empty(shape, np.complex128)
        parts = []
        for part in _parts_of(limb.n_outputs):
            total = self._buffer[part]
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
            others=self._buffer,
            response=None,
            drive=None,
            weight=0.0,
        )
        return Field(spectrum, moments)


def _parts_of(n_outputs: int) -> list[slice]:
    return [slice(low, low + _OUTPUTS_AT_ONCE) for low in range(0, n_outputs, _OUTPUTS_AT_ONCE)]


def same_voices(left: tuple[Placed, ...], right: tuple[Placed, ...]) -> bool:
    """Return whether inputs play the same at the same place and time, with the same strength."""
    return len(left) == len(right) and all(
        a is b or (a.drive is b.drive and a.start == b.start and a.voice == b.voice)
        for a, b in zip(left, right, strict=True)
    )


def terms(
    responses: Responses, moving: tuple[Placed, ...], stop: Stop
) -> tuple[list[Complexes], list[Complexes]]:
    """Return spectra of the responses, and of the drives with onset and weight, of voices."""
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


# The linear algebra library shares larger products out among threads, which wait for each other
# without sleeping; and the order of a sum would depend on their number.
_NUMBERS_AT_ONCE = 2**18
# The library takes so many rows at a time.  A few whole rows are faster than parts of many: the
# columns stay in the cache.
_ROWS = 8


class Products:
    """Products of responses, computed on demand and cached for the next stimuli.

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
        Whether products of different axes are needed.
    """

    def __init__(self, n_fft: int, n_axes: int, *, products: bool) -> None:
        self.n_axes = n_axes
        squares = tuple((axis, axis) for axis in range(n_axes))
        self.pairs = (*squares, *(pairs(n_axes) if products else ()))
        self._weights = np.full(n_fft // 2 + 1, 2.0 / n_fft)
        self._weights[[0, -1]] *= 0.5
        self._cached: dict[Hashable, Floats] = {}

    def n_bytes(self, n_own: int, n_pairs: int, values: Complexes) -> int:
        """Return the bytes of so many matrices, for responses such as ``values``."""
        return (n_own + 2 * n_pairs) * len(self.pairs) * len(values) * values.shape[-1] * 8

    def own(self, key: Hashable, values: Complexes) -> Floats:
        """Return products of responses with themselves, (n_products, n_outputs, n_bins).

        They are multiplied with the power of a drive.

        Parameters
        ----------
        key
            Identifies ``values``.
        values : (n_outputs, n_axes, n_bins)
            Spectra of responses.
        """
        product = self._cached.get(key)
        if product is None:
            product = np.empty((len(self.pairs), len(values), values.shape[-1]))
            for k, (a, b) in enumerate(self.pairs):
                left, right = values[:, a], values[:, b]
                product[k] = (left.real * right.real + left.imag * right.imag) * self._weights
            self._cached[key] = product
        return product

    def between(self, keys: tuple[Hashable, Hashable], left: Complexes, right: Complexes) -> Floats:
        """Return products of two responses, (n_products, n_outputs, 2 n_bins).

        They are multiplied with the left drive times the conjugate of the right one, real and
        imaginary parts in turn, and give the interaction of the two.
        """
        product = self._cached.get(keys)
        if product is None:
            values = np.empty((len(self.pairs), len(left), left.shape[-1]), np.complex128)
            conjugate = left.conj()
            for k, (a, b) in enumerate(self.pairs):
                np.multiply(conjugate[:, a], right[:, b], out=values[k])
                values[k] += right[:, a] * conjugate[:, b]
                values[k] *= self._weights
            product = self._cached[keys] = values.view(np.float64)
        return product

    def forget_all_but(self, keys: Iterable[Hashable]) -> None:
        """Delete all other matrices."""
        needed = set(keys)
        self._cached = {key: matrix for key, matrix in self._cached.items() if key in needed}


def multiplied(matrix: Floats, columns: Floats) -> Floats:
    """Return sums over the last axis, (n_columns, n_products, n_outputs), with one thread.

    Parameters
    ----------
    matrix : (n_products, n_outputs, n)
    columns : (n_columns, n)
        A sum does not depend on the other columns.
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


#: With fewer stimuli the matrices take longer than they save.
_LEAST_STIMULI = 4
#: Largest size of the matrices at a frequency; above it, adding up the vibrations is faster.
_MOST_NUMBERS = 16
_MOST_BYTES = 256 * 2**20
#: Below this share of the sum of its terms, the energy of an axis has lost digits and is computed
#: from the vibration itself: above it a level is right to 1e-12.
_CANCELLED = 1e-3
#: The key of the common inputs, among the places of those that vary.
_ALL_COMMON = 0


@dataclass(frozen=True, slots=True, eq=False)
class Vibrations:
    """The vibrations of all outputs by each of several stimuli.

    Attributes
    ----------
    moments
        Moments of all outputs of the first stimulus, then of those of the next one.
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
        """Return spectra of outputs, each of a stimulus, both from 0: (n, n_axes, n_bins)."""
        total = np.zeros((len(outputs), len(axes), self.n_fft // 2 + 1), np.complex128)
        chosen = np.ix_(outputs, np.array(axes))
        for values, drives in self.sources:
            responses = values[chosen]
            total += responses if drives is None else responses * drives[stimuli][:, None]
        return total


class Batch:
    """Computes the vibrations of several stimuli at once; caches what they have in common."""

    def __init__(self, preparing: Preparing) -> None:
        self._preparing = preparing
        self._common = Common()
        self._common_spectrum: Complexes | None = None
        self._common_moments: Moments | None = None
        self._responses: Responses | None = None
        self._products: Products | None = None

    def of(
        self, stimuli: Sequence[PreparedStimulus | None], stop: Stop, *, products: bool
    ) -> Vibrations | None:
        """Return the vibrations by ``stimuli``; None: they have too little in common.

        The result depends on nothing but the stimuli and their order.

        Parameters
        ----------
        stimuli
            None: an invalid one; its numbers mean nothing.
        products
            Whether moments of different axes are needed.
        """
        valid = [stimulus for stimulus in stimuli if stimulus is not None]
        if len(valid) < _LEAST_STIMULI or not all(
            _has_same_responses(stimulus, valid[0]) for stimulus in valid
        ):
            return None
        split = _split(valid)
        n_fft = valid[0].n_fft(max(stimulus.response_samples for stimulus in valid))
        if split is None or n_fft is None:
            return None
        fixed, places = split
        n_sources = len(places) + bool(fixed)
        if len(places) * (len(places) + 2 * bool(fixed)) > _MOST_NUMBERS or not n_sources:
            return None
        responses = self._preparing.responses(valid[0], n_fft)
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
        """Delete what was computed from other responses."""
        if self._responses != responses or self._products is None:
            self._responses = responses
            self._products = Products(
                responses.n_fft or 0, responses.limb.n_axes, products=products
            )
            self._common_spectrum = None

    def _vibrations(
        self, sources: "list[_Source]", n_stimuli: int, n_fft: int
    ) -> Vibrations | None:
        products = self._products
        values = sources[0].values
        n_pairs = len(sources) * (len(sources) - 1) // 2
        if products is None or products.n_bytes(len(sources), n_pairs, values) > _MOST_BYTES:
            return None
        self._forget(products, sources)
        totals = np.zeros((n_stimuli, len(products.pairs), len(values)))
        n_axes = products.n_axes
        with_products = len(products.pairs) > n_axes
        size = np.zeros((n_stimuli, n_axes, len(values)))
        first = np.zeros((n_stimuli, len(values), n_axes))
        for source in sources:
            if source.drives is None:
                common = self._common_moments
                if common is None:
                    common = moments_of(source.values, n_fft, products=with_products)
                    self._common_moments = common
                second = np.stack([common.second[:, a, b] for a, b in products.pairs])[None]
                first += common.first
            else:
                power = np.square(source.drives.real) + np.square(source.drives.imag)
                second = multiplied(products.own(source.key, source.values), power)
                first += source.drives[:, 0].real[:, None, None] * source.values[:, :, 0].real
            totals += second
            size += np.sqrt(np.maximum(second[:, :n_axes], 0.0))
        for left, right in combinations(sources, 2):
            matrix = products.between((left.key, right.key), left.values, right.values)
            totals += multiplied(matrix, left.with_conjugate_of(right).view(np.float64))
        second = _symmetric(totals, products.pairs, n_axes)
        moments = Moments(second.reshape(-1, n_axes, n_axes), first.reshape(-1, n_axes))
        vibrations = Vibrations(
            moments, n_fft, tuple((source.values, source.drives) for source in sources)
        )
        lost: Booleans = np.any(totals[:, :n_axes] < _CANCELLED * np.square(size), axis=1)
        _repair(vibrations, lost, products=with_products)
        return vibrations

    def _forget(self, products: Products, sources: "list[_Source]") -> None:
        """Delete the matrices that are not in use."""
        common = sources[0].values if sources[0].drives is None else None
        keys: list[Hashable] = [source.key for source in sources]
        keys += [(a.key, b.key) for a, b in combinations(sources, 2)]
        if common is not self._common_spectrum:
            keys = [key for key in keys if not isinstance(key, tuple) or key[0] != _ALL_COMMON]
            self._common_spectrum, self._common_moments = common, None
        products.forget_all_but(keys)


@dataclass(frozen=True, slots=True, eq=False)
class _Source:
    """Responses to a place, the number of the place, and one drive for each stimulus."""

    key: int
    values: Complexes
    drives: Complexes | None

    def with_conjugate_of(self, other: "_Source") -> Complexes:
        """Products of the drives of each stimulus, (n_stimuli, n_bins)."""
        if other.drives is None:
            raise ValueError("the common inputs come first")
        conjugates = other.drives.conj()
        return conjugates if self.drives is None else self.drives * conjugates


def _has_same_responses(stimulus: PreparedStimulus, other: PreparedStimulus) -> bool:
    """Return whether responses are the same; a limb behind other actuators is another limb."""
    return stimulus.limb is other.limb and stimulus.design.scaling == other.design.scaling


def _split(stimuli: list[PreparedStimulus]) -> tuple[tuple[Placed, ...], dict[int, int]] | None:
    """Return common inputs, and the places of the others by id; None: a place differs."""
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
    """Return matrices of second moments, (n_stimuli, n_outputs, n_axes, n_axes)."""
    second = np.zeros((len(totals), totals.shape[-1], n_axes, n_axes))
    for k, (a, b) in enumerate(pairs):
        second[:, :, a, b] = second[:, :, b, a] = totals[:, k]
    return second


def _repair(vibrations: Vibrations, lost: Booleans, *, products: bool) -> None:
    """Compute moments from the vibration itself where digits were ``lost``.

    ``lost``: (n_stimuli, n_outputs).
    """
    stimuli, outputs = np.nonzero(lost)
    if len(stimuli):
        every_axis = tuple(range(vibrations.moments.first.shape[1]))
        spectra = vibrations.rows(stimuli, outputs, every_axis)
        again = moments_of(spectra, vibrations.n_fft, products=products)
        which = stimuli * lost.shape[1] + outputs
        vibrations.moments.second[which] = again.second
        vibrations.moments.first[which] = again.first
