"""Spectra of impulse responses, in bounded memory; of all voices together; behind actuators."""

from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from weakref import ref

import numpy as np
import scipy

from skinsource.actuators.actuation import Actuation, transfers_of
from skinsource.base.arrays import Complexes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.work import tally
from skinsource.design.signal_path import LARGEST, first_unusable
from skinsource.engine.memory import (
    EXACT_SPECTRA_BYTES,
    RESPONSE_SPECTRA_BYTES,
    Memory,
    untouched_array,
)
from skinsource.engine.transforms import Channel, driven, forward
from skinsource.limbs.limb import Limb
from skinsource.limbs.scaling import Scaling, per_probe_acceleration

#: Taps at which responses are cut for bounds by energy: short sections where most energy is.
SECTIONS = (0, 32, 64, 96, 128, 192, 256)
#: Bins of a band: responses are shorter than the transform, and change little over so many bins.
BAND_BINS = 8


@dataclass(frozen=True, eq=False)
class ResponseSpectrum:
    """Responses to one location, in time and in frequency.

    Attributes
    ----------
    taps : (n_outputs, n_axes, n_taps)
        m/s².
    values : (n_outputs, n_axes, n_fft // 2 + 1)
        Their spectra.
    known_norms
        Norms of the taps, where they were computed already.
    """

    taps: Floats
    values: Complexes
    n_fft: int
    known_norms: "Norms | None" = None

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
    def norms(self) -> "Norms":
        """Norms of the responses, for bounds of samples."""
        return Norms.of(self.taps) if self.known_norms is None else self.known_norms


@dataclass(frozen=True, slots=True, eq=False)
class Norms:
    """Norms of responses.

    Attributes
    ----------
    sections : (n_channels, n_sections)
        Root of the sum of squares of each section of each response.
    section_lengths
        Taps in each section.
    energies : (n_channels,)
        Root of the sum of squares of each response.
    absolute_sums : (n_channels,)
        Sum of magnitudes of each response.
    """

    sections: Floats
    section_lengths: tuple[int, ...]
    energies: Floats
    absolute_sums: Floats

    @classmethod
    def of(cls, taps: Floats) -> "Norms":
        """Return the norms of responses, (n_outputs, n_axes, n_taps)."""
        n_taps = taps.shape[-1]
        rows = taps.reshape(-1, n_taps)
        begins = [tap for tap in SECTIONS if tap < n_taps]
        squares = np.add.reduceat(np.square(rows), begins, axis=-1)
        return cls(
            sections=np.sqrt(squares),
            section_lengths=tuple(b - a for a, b in pairwise((*begins, n_taps))),
            energies=np.sqrt(squares.sum(axis=-1)),
            absolute_sums=np.abs(rows).sum(axis=-1),
        )


class _Places:
    """Spectra of responses at one length, made location by location in one array."""

    def __init__(self, limb: Limb, n_fft: int) -> None:
        self._n_fft = n_fft
        shape = limb.n_inputs, limb.n_outputs, limb.n_axes, n_fft // 2 + 1
        self._values = untouched_array(shape)
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

    @property
    def held_bytes(self) -> int:
        """Memory that the spectra take."""
        return self.values.nbytes


# Limb, whether responses are calibrated, length, and the locations of a stack.
_Key = tuple[ref[Limb], bool, int, tuple[int, ...]]


class ResponseSpectra:
    """Spectra by limb, location, scaling and length; the least recently used lengths go first."""

    def __init__(self, budget_bytes: int = RESPONSE_SPECTRA_BYTES) -> None:
        self._budget_bytes = budget_bytes
        self._cached: OrderedDict[_Key, _Places | Stack] = OrderedDict()

    @property
    def held_bytes(self) -> int:
        """Memory that the spectra take."""
        return sum(entry.held_bytes for entry in self._cached.values())

    def of(self, limb: Limb, location: int, scaling: Scaling, n_fft: int) -> ResponseSpectrum:
        """Return the responses to ``location``; under ``"probe"`` scaling the calibrated ones."""
        # The key is the object, as a name may mean other data after an installation; and a weak
        # reference, which does not keep all responses in memory.
        key: _Key = ref(limb), scaling == "probe", n_fft, ()
        spectra = self._cached.get(key)
        if not isinstance(spectra, _Places):
            spectra = _Places(limb, n_fft)
        response = spectra.of(limb, location, scaling)
        self._remember(key, spectra)
        return response

    def stack(self, limb: Limb, locations: tuple[int, ...], scaling: Scaling, n_fft: int) -> Stack:
        """Return the responses to ``locations`` for matrix products."""
        key: _Key = ref(limb), scaling == "probe", n_fft, locations
        stack = self._cached.get(key)
        if not isinstance(stack, Stack):
            stack = _stack(limb, locations, scaling, n_fft)
        self._remember(key, stack)
        return stack

    def _remember(self, key: _Key, latest: _Places | Stack) -> None:
        self._forget_lost_limbs()
        self._cached[key] = latest
        self._cached.move_to_end(key)
        while len(self._cached) > 1 and self.held_bytes > self._budget_bytes:
            self._cached.popitem(last=False)

    def _forget_lost_limbs(self) -> None:
        """Drop spectra of limbs that nobody holds any more."""
        for key in [key for key in self._cached if key[0]() is None]:
            del self._cached[key]


def scaled_taps(limb: Limb, location: int, scaling: Scaling) -> Floats:
    """Return the responses to ``location``, (n_outputs, n_axes, n_taps), m/s².

    Raises
    ------
    InvalidInputError
        A sample of them is not usable.
    """
    return bounded_taps(limb, location, scaling)[0]


def bounded_taps(limb: Limb, location: int, scaling: Scaling) -> tuple[Floats, float]:
    """Return the same as `scaled_taps`, and the largest magnitude of them all, m/s²."""
    taps, largest = limb.response_to(location), limb.largest_response_to(location)
    # Written so that NaN, too, is checked further.
    bad = None if largest <= LARGEST else first_unusable(taps)
    if bad is not None:
        output, axis, tap = bad
        raise InvalidInputError(
            f"{limb.name}: in the response to input location {location}, output {output + 1}, axis "
            f"{limb.axes[axis]}, tap {tap} is {taps[bad]}, expected a finite number of at most "
            f"{LARGEST:g}. Install or load the limb again."
        )
    if scaling != "probe" or limb.per_unit_drive:
        return taps, largest
    taps = per_probe_acceleration(taps, limb.sample_rate_hz)
    return taps, float(np.abs(taps).max(initial=0.0))


def _stack(limb: Limb, locations: tuple[int, ...], scaling: Scaling, n_fft: int) -> Stack:
    n_bins, n_channels = n_fft // 2 + 1, limb.n_outputs * limb.n_axes
    values = np.empty((n_bins, len(locations), n_channels), np.complex128)
    responses = {}
    for row, location in enumerate(locations):
        taps = scaled_taps(limb, location, scaling)
        values[:, row] = forward(taps.reshape(n_channels, -1), n_fft).T
        by_channel = values[:, row].T.reshape(limb.n_outputs, limb.n_axes, n_bins)
        responses[location] = ResponseSpectrum(taps, by_channel, n_fft)
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
    ) -> Complexes:
        keys = [(name, n_times, channel) for channel in channels]
        spectra = {key: self._known.find(key) for key in keys}
        missing = [key for key in keys if spectra[key] is None]
        if missing:
            rows = np.array([taps[output - 1, axis] for _, _, (output, axis) in missing])
            for key, spectrum in zip(missing, forward(rows, n_times), strict=True):
                spectra[key] = spectrum
                self._known.add(key, spectrum)
        return np.array([spectra[key] for key in keys])


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
            total += self.response.values[rows] * self.drive * self.weight
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
        responses: Floats = scipy.fft.irfft(spectra, n_fft)
        return responses[..., :n_taps].copy()

    return Limb(
        name=limb.name,
        hand_length_mm=limb.hand_length_mm,
        synthetic=limb.synthetic,
        map=limb.map,
        read_response=read,
        sample_rate_hz=limb.sample_rate_hz,
        axes=limb.axes,
        pre_trigger_delay_s=limb.pre_trigger_delay_s,
        band_hz=limb.band_hz,
        per_unit_drive=True,
        note=limb.note,
        shape=(limb.n_inputs, limb.n_outputs, limb.n_axes, n_taps),
        lead_samples=first.lead,
    )
