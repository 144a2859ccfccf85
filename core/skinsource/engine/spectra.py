"""Spectra of impulse responses, in bounded memory; of all voices together; behind actuators."""

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise
from math import prod
from threading import Lock
from typing import Any
from weakref import WeakKeyDictionary, WeakValueDictionary

import numpy as np
import scipy
from numpy.typing import NDArray

from skinsource.actuators.actuation import Actuation, transfers_of
from skinsource.base.conventions import Complexes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.work import tally
from skinsource.design.signal_path import LARGEST, first_unusable
from skinsource.engine.memory import (
    EXACT_SPECTRA_BYTES,
    RESPONSE_SPECTRA_BYTES,
    Memory,
    untouched_array,
)
from skinsource.engine.transforms import Channel, driven, forward, parts_of, run_on_two_threads
from skinsource.limbs.limb import Limb, limb_like
from skinsource.limbs.scaling import Scaling, per_probe_acceleration

#: Taps at which responses are cut for bounds by energy: short sections where most energy is.
SECTIONS = (0, 32, 64, 96, 128, 192, 256)
#: Bins of a band: responses are shorter than the transform, and change little over so many bins.
BAND_BINS = 8


@dataclass(frozen=True, eq=False)
class Response:
    """Responses to one location, which are transformed each time that spectra are used.

    Attributes
    ----------
    taps : (n_outputs, n_axes, n_taps)
        m/s².
    n_fft
        Length of the transforms.
    """

    taps: Floats
    n_fft: int

    def driven(self, outputs: slice, drive: Complexes, out: Complexes | None = None) -> Complexes:
        """Return the spectra of some outputs, (n, n_axes, n_bins), times that of a drive.

        They are written to ``out`` where it is given, else to a new array.
        """
        # In this thread; the caller counts.
        spectra = scipy.fft.rfft(self.taps[outputs], self.n_fft)
        return np.multiply(spectra, drive, out=spectra if out is None else out)

    @cached_property
    def norms(self) -> Floats:
        """Root of the sum of squares of each response, (n_outputs, n_axes)."""
        return np.sqrt(np.vecdot(self.taps, self.taps))


@dataclass(frozen=True, eq=False)
class ResponseSpectrum(Response):
    """Responses to one location, with their spectra.

    Attributes
    ----------
    values : (n_outputs, n_axes, n_fft // 2 + 1)
        The spectra.
    """

    values: Complexes

    def driven(self, outputs: slice, drive: Complexes, out: Complexes | None = None) -> Complexes:
        """Return the spectra of some outputs, (n, n_axes, n_bins), times that of a drive."""
        return np.multiply(self.values[outputs], drive, out=out)

    @cached_property
    def rows(self) -> Complexes:
        """Spectra with a row for each channel, (n_channels, n_bins)."""
        return self.values.reshape(-1, self.values.shape[-1])

    @cached_property
    def band_magnitudes(self) -> Floats:
        """Largest magnitude in each band of bins, (n_channels, n_bands), for bounds of samples.

        They are divided by n_fft, and doubled but for the ends, as in the inverse transform.
        """
        magnitudes = np.abs(self.rows)
        magnitudes[:, [0, -1]] *= 0.5
        # All bands at once, bin by bin, are quicker than band by band.
        bands = magnitudes[:, ::BAND_BINS].copy()
        for k in range(1, BAND_BINS):
            bins = magnitudes[:, k::BAND_BINS]
            reached = bands[:, : bins.shape[-1]]
            np.maximum(reached, bins, out=reached)
        bands *= 2.0 / self.n_fft
        return bands

    @cached_property
    def section_lengths(self) -> tuple[int, ...]:
        """Taps in each section of a response."""
        n_taps = self.taps.shape[-1]
        return tuple(b - a for a, b in pairwise((*(n for n in SECTIONS if n < n_taps), n_taps)))

    @cached_property
    def section_norms(self) -> Floats:
        """Root of the sum of squares of each section, (n_channels, n_sections)."""
        squares = np.square(self.taps.reshape(len(self.rows), -1))
        begins = np.cumsum((0, *self.section_lengths[:-1]))
        return np.sqrt(np.add.reduceat(squares, begins, axis=-1))


# A second thread pays from about a millisecond of work on.
_SUMS_WORTH_A_THREAD = 10**6


def superpose(
    responses: Sequence[Response], drives: Sequence[Complexes], vibration: NDArray[Any]
) -> None:
    """Add up the vibrations by some drives: responses times drives, frequency by frequency.

    Some outputs at a time: they stay in the cache of a core.  Results have the same bits with one
    thread or two.

    Parameters
    ----------
    responses
        To the location of each drive; at least one.
    drives : (n_bins,) each
        Spectra with their gains.
    vibration : (n_outputs, n_axes, n_bins) or (n_outputs, n_axes, n_times)
        Where the sum is written: its spectra into complex numbers, its samples into real ones.
    """
    n_outputs, n_axes, _ = vibration.shape
    n_bins, n_fft, in_time = drives[0].size, responses[0].n_fft, vibration.dtype.kind == "f"
    # Several drives need a second array.
    parts = parts_of(n_outputs, n_axes * n_bins * min(len(drives), 2))
    # Rows in one piece are multiplied faster than row by row.
    tiled = [np.tile(drive, (parts[0].stop, n_axes, 1)) for drive in drives]

    def compute(part: slice) -> None:
        played = [drive[: part.stop - part.start] for drive in tiled]
        total = responses[0].driven(part, played[0], None if in_time else vibration[part])
        buffer = np.empty_like(total)
        for response, drive in zip(responses[1:], played[1:], strict=True):
            total += response.driven(part, drive, buffer)
        if in_time:
            vibration[part] = scipy.fft.irfft(total, n_fft)[..., : vibration.shape[-1]]

    tasks = [partial(compute, part) for part in parts]
    work = len(drives) * n_outputs * n_axes * n_bins
    # For a single drive, a second thread gains little, and costs where no processor is free.
    if len(drives) > 1 and (in_time or work >= _SUMS_WORTH_A_THREAD):
        run_on_two_threads(tasks)
    else:
        for task in tasks:
            task()
    if in_time:
        tally(inverse_transforms=n_outputs * n_axes)


def _transform(response: ResponseSpectrum) -> None:
    n_outputs, n_axes, n_taps = response.taps.shape
    for part in parts_of(n_outputs, n_axes * n_taps):
        response.values[part] = scipy.fft.rfft(response.taps[part], response.n_fft)


@dataclass(frozen=True, slots=True, eq=False)
class Stack:
    """Spectra of the responses to some locations, frequency by frequency, for matrix products.

    Attributes
    ----------
    values : (n_fft // 2 + 1, n_locations, n_channels)
        The spectra.
    responses
        The same, by location.
    """

    values: Complexes
    responses: dict[int, ResponseSpectrum]


# Length of the transforms, whether responses are calibrated, and the location, or those of a stack.
_Key = tuple[int, bool, int | tuple[int, ...]]
# Far more than anybody requests in turn.
_MOST_REQUESTED = 10_000


class ResponseSpectra:
    """Spectra of responses by limb, location, scaling and length, for all threads.

    Spectra of a limb are dropped together with it; of the others, the least recently used go first.

    Parameters
    ----------
    budget_bytes
        Memory that all spectra together may take.
    """

    def __init__(self, budget_bytes: int = RESPONSE_SPECTRA_BYTES) -> None:
        self._budget_bytes = budget_bytes
        self._lock = Lock()
        # Limbs, and the spectra of each, are in order of use, the latest last.
        self._cached: WeakKeyDictionary[Limb, dict[_Key, ResponseSpectrum | Stack]] = (
            WeakKeyDictionary()
        )
        self._requested: WeakKeyDictionary[Limb, set[_Key]] = WeakKeyDictionary()

    def of(
        self, limb: Limb, locations: Sequence[int], scaling: Scaling, n_fft: int
    ) -> list[ResponseSpectrum]:
        """Return the responses to each of ``locations``; those not remembered are transformed.

        Under ``"probe"`` scaling they are the calibrated ones.
        """
        with self._lock:
            known = self._latest(limb)
            keys: dict[int, _Key] = {each: (n_fft, scaling == "probe", each) for each in locations}
            found: dict[int, Any] = {
                each: known.pop(key) for each, key in keys.items() if key in known
            }
            known |= {keys[each]: spectrum for each, spectrum in found.items()}
            taps = {each: scaled_taps(limb, each, scaling) for each in keys if each not in found}
            shape = limb.n_outputs, limb.n_axes, n_fft // 2 + 1
            each_bytes = 16 * prod(shape)
            kept = list(taps)[: max(self._budget_bytes // each_bytes - len(found), 0)]
            # What has no room goes first: old and new ones together would be twice as much.
            self._make_room(len(kept) * each_bytes)
            added = {
                location: ResponseSpectrum(samples, n_fft, untouched_array(shape))
                for location, samples in taps.items()
            }
            run_on_two_threads(partial(_transform, response) for response in added.values())
            tally(forward_transforms=len(added) * prod(shape[:2]))
            known |= {keys[each]: added[each] for each in kept}
            found |= added
            return [found[each] for each in locations]

    def of_one(self, limb: Limb, location: int, scaling: Scaling, n_fft: int) -> Response:
        """Return the responses to ``location``; spectra are remembered from the second time on.

        Whoever predicts once does not pay for remembered spectra.
        """
        key: _Key = n_fft, scaling == "probe", location
        with self._lock:
            requested = self._requested.setdefault(limb, set())
            if key not in self._cached.get(limb, {}) and key not in requested:
                if len(requested) >= _MOST_REQUESTED:
                    requested.clear()
                requested.add(key)
                tally(forward_transforms=limb.n_outputs * limb.n_axes)
                return Response(scaled_taps(limb, location, scaling), n_fft)
        return self.of(limb, [location], scaling, n_fft)[0]

    def stack(self, limb: Limb, locations: tuple[int, ...], scaling: Scaling, n_fft: int) -> Stack:
        """Return the responses to ``locations`` for matrix products."""
        key: _Key = n_fft, scaling == "probe", locations
        with self._lock:
            known = self._latest(limb)
            stack = known.pop(key, None)
            if not isinstance(stack, Stack):
                stack = _stack(limb, locations, scaling, n_fft)
                self._make_room(stack.values.nbytes)
            known[key] = stack
            return stack

    def _latest(self, limb: Limb) -> dict[_Key, ResponseSpectrum | Stack]:
        """Return what is remembered of a limb, which becomes the latest."""
        self._cached[limb] = known = self._cached.pop(limb, {})
        return known

    def _make_room(self, coming_bytes: int) -> None:
        excess = self._sum() + coming_bytes - self._budget_bytes
        for known in list(self._cached.values()):
            for oldest in list(known):
                if excess <= 0:
                    return
                excess -= known.pop(oldest).values.nbytes

    def _sum(self) -> int:
        known = list(self._cached.values())
        return sum(spectra.values.nbytes for of_limb in known for spectra in of_limb.values())


#: Of all engines of the process: each has its own limbs, and so its own spectra.
RESPONSE_SPECTRA = ResponseSpectra()
# Spectra of all lengths hold the same responses.
_CALIBRATED: WeakKeyDictionary[Limb, WeakValueDictionary[int, Floats]] = WeakKeyDictionary()


def scaled_taps(limb: Limb, location: int, scaling: Scaling) -> Floats:
    """Return the responses to ``location``, (n_outputs, n_axes, n_taps), m/s².

    Raises
    ------
    InvalidInputError
        A sample of them is not usable.
    """
    taps = limb.response_to(location)
    # Written so that NaN, too, is checked further.
    bad = None if limb.largest_response_to(location) <= LARGEST else first_unusable(taps)
    if bad is not None:
        output, axis, tap = bad
        raise InvalidInputError(
            f"{limb.name}: in the response to input location {location}, output {output + 1}, axis "
            f"{limb.axes[axis]}, tap {tap} is {taps[bad]}, expected a finite number of at most "
            f"{LARGEST:g}. Install or load the limb again."
        )
    if scaling != "probe" or limb.per_unit_drive:
        return taps
    calibrated = _CALIBRATED.setdefault(limb, WeakValueDictionary())
    scaled = calibrated.get(location)
    if scaled is None:
        scaled = calibrated[location] = per_probe_acceleration(taps, limb.sample_rate_hz)
    return scaled


def _stack(limb: Limb, locations: tuple[int, ...], scaling: Scaling, n_fft: int) -> Stack:
    n_bins, n_channels = n_fft // 2 + 1, limb.n_outputs * limb.n_axes
    values = np.empty((n_bins, len(locations), n_channels), np.complex128)
    responses = {}
    for row, location in enumerate(locations):
        taps = scaled_taps(limb, location, scaling)
        values[:, row] = forward(taps.reshape(n_channels, -1), n_fft).T
        by_channel = values[:, row].T.reshape(limb.n_outputs, limb.n_axes, n_bins)
        responses[location] = ResponseSpectrum(taps, n_fft, by_channel)
    return Stack(values, responses)


class ExactSpectra:
    """Spectra of single responses over exactly the samples of a vibration, in bounded memory.

    Upstream takes spectra at that length too, which is seldom a fast one (1821 = 3 x 607).  The
    spectrum of a convolution is the product of those of drive and response; those of responses stay
    when the drive changes, so that only the drive is transformed again.
    """

    def __init__(self) -> None:
        self._known = Memory[Complexes](EXACT_SPECTRA_BYTES, lambda spectrum: spectrum.nbytes)

    def of(
        self, samples: Floats, taps: Floats, name: Hashable, n_times: int
    ) -> Callable[[list[Channel]], Complexes]:
        """Return a function from channels to spectra, (n_channels, n_times // 2 + 1).

        Parameters
        ----------
        samples
            The drive; its vibration ends within ``n_times``.
        taps : (n_outputs, 3 axes, n_taps)
            Responses to the location of the drive.
        name
            Key of the responses.
        """

        def spectra(channels: list[Channel]) -> Complexes:
            drive = forward(samples, n_times)
            return driven(self._responses(taps, name, n_times, channels), drive)

        return spectra

    def _responses(
        self, taps: Floats, name: Hashable, n_times: int, channels: list[Channel]
    ) -> list[Complexes]:
        keys = [(name, n_times, channel) for channel in channels]
        found = {key: self._known.find(key) for key in keys}
        spectra = {key: spectrum for key, spectrum in found.items() if spectrum is not None}
        missing = [key for key in keys if key not in spectra]
        if missing:
            rows = np.array([taps[output - 1, axis] for _, _, (output, axis) in missing])
            for key, spectrum in zip(missing, forward(rows, n_times), strict=True):
                spectra[key] = spectrum
                self._known.add(key, spectrum)
        return [spectra[key] for key in keys]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TotalSpectrum:
    """Spectrum of the vibration by all voices, summed for the rows that are requested.

    Attributes
    ----------
    shape
        Outputs, axes, and bins.
    n_fft
        Length of the transforms.
    others : (n_outputs, n_axes, n_bins) or None
        Vibration by all voices but the edited one; None where they move nothing.
    response, drive, weight
        Responses to the location of the edited voice, the spectrum of its drive, (n_bins,), with
        its onset, and the factor of both; None where no voice is edited.
    """

    shape: tuple[int, int, int]
    n_fft: int
    others: Complexes | None
    response: ResponseSpectrum | None
    drive: Complexes | None
    weight: float

    def times(self, weights: Floats) -> "TotalSpectrum":
        """Return the spectrum after a filter with the frequency response ``weights``, (n_bins,)."""
        return replace(
            self,
            others=None if self.others is None else self.others * weights,
            drive=None if self.drive is None else self.drive * weights,
        )

    def rows(self, outputs: np.ndarray, axes: tuple[int, ...]) -> Complexes:
        """Return spectra of some outputs, counted from 0, and axes, (n, n_axes, n_bins)."""
        rows = np.ix_(outputs, np.array(axes))
        if self.others is None:
            total = np.zeros((len(outputs), len(axes), self.shape[-1]), np.complex128)
        else:
            total = self.others[rows]
        if self.response is not None and self.drive is not None and self.weight != 0.0:
            total += self.response.values[rows] * (self.drive * self.weight)
        return total


def actuated_limb(limb: Limb, actuation: Actuation, scaling: Scaling) -> Limb:
    """Return ``limb`` as it answers drives through actuators.

    Its responses are those of the limb, calibrated to the acceleration of the probe, convolved with
    the impulse response of equaliser and actuator: they are longer, and begin before time 0.  They
    are read when they are used first.

    Raises
    ------
    InvalidInputError
        Drives are not accelerations or volts under this scaling, or an actuator rings for longer
        than can be predicted.
    """
    if scaling != "probe":
        raise InvalidInputError(
            "Predict through the actuator needs drives that are accelerations or volts, and under "
            f"this scaling, {scaling}, they are none. Choose the scaling Probe acceleration, or "
            "switch it off."
        )
    transfers = transfers_of(actuation, limb.sample_rate_hz, limb.band_hz)
    first = next(iter(transfers.values()))
    n_taps = limb.n_taps + first.samples.size - 1

    def read(location: int) -> Floats:
        transfer = transfers[actuation.at(location).place]
        taps = scaled_taps(limb, location, "probe")
        n_fft = scipy.fft.next_fast_len(n_taps, real=True)
        tally(forward_transforms=taps.shape[0] * taps.shape[1])
        spectra = scipy.fft.rfft(taps, n_fft)
        spectra *= scipy.fft.rfft(transfer.samples, n_fft)
        tally(inverse_transforms=taps.shape[0] * taps.shape[1])
        return scipy.fft.irfft(spectra, n_fft)[..., :n_taps].copy()

    return limb_like(
        limb,
        map=limb.map,
        read_response=read,
        per_unit_drive=True,
        shape=(limb.n_inputs, limb.n_outputs, limb.n_axes, n_taps),
        lead_samples=first.lead,
    )
