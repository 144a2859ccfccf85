"""Spectra of impulse responses, by place and length, in bounded memory."""

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
from skinsource.engine.memory import EXACT_SPECTRA_BYTES, RESPONSE_SPECTRA_BYTES, Memory
from skinsource.engine.transforms import Channel, driven, forward
from skinsource.limbs.limb import Limb
from skinsource.limbs.scaling import Scaling, per_probe_acceleration

#: Taps at which responses are cut for bounds by energy: finely where most of it is.
SECTIONS = (0, 32, 64, 96, 128, 192, 256)
#: Bins of a band, over which responses, shorter than the transform, change little.
BAND_BINS = 8


@dataclass(frozen=True, eq=False)
class ResponseSpectrum:
    """Responses to one place, in time and in frequency.

    Attributes
    ----------
    taps : (n_outputs, n_axes, n_taps)
        m/s².
    values : (n_outputs, n_axes, n_fft // 2 + 1)
        Their spectra.
    known_norms
        Those of the taps, where they were computed already.
    """

    taps: Floats
    values: Complexes
    n_fft: int
    known_norms: "Norms | None" = None

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
        """Those of responses, (n_outputs, n_axes, n_taps)."""
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
    """Spectra at one length, made place by place in one array."""

    def __init__(self, limb: Limb, n_fft: int) -> None:
        self._n_fft = n_fft
        shape = limb.n_inputs, limb.n_outputs, limb.n_axes, n_fft // 2 + 1
        self._values = np.empty(shape, np.complex128)
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
        return sum(entry.held_bytes for entry in self._held.values())

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
    """Responses to ``location``, (n_outputs, n_axes, n_taps); refused where one is not usable."""
    return bounded_taps(limb, location, scaling)[0]


def bounded_taps(limb: Limb, location: int, scaling: Scaling) -> tuple[Floats, float]:
    """As `scaled_taps`, with the largest magnitude of them all, m/s²."""
    taps, largest = limb.response_to(location), limb.largest_response_to(location)
    # Not a number is neither.
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


def _stack(limb: Limb, places: tuple[int, ...], scaling: Scaling, n_fft: int) -> Stack:
    n_bins, n_channels = n_fft // 2 + 1, limb.n_outputs * limb.n_axes
    values = np.empty((n_bins, len(places), n_channels), np.complex128)
    responses = {}
    for row, location in enumerate(places):
        taps = scaled_taps(limb, location, scaling)
        values[:, row] = forward(taps.reshape(n_channels, -1), n_fft).T
        by_channel = values[:, row].T.reshape(limb.n_outputs, limb.n_axes, n_bins)
        responses[location] = ResponseSpectrum(taps, by_channel, n_fft)
    return Stack(values, responses)


# Spectra over exactly the samples of a response, of one voice.
#
# They are taken over as many samples as there are, as upstream does, which is seldom a fast length
# (1821 = 3 x 607).  The spectrum of a convolution is the product of those of drive and response;
# those of responses stay the same when the drive changes, so that one transform is left of many.


class ExactSpectra:
    """Spectra of single responses at exact lengths, in bounded memory."""

    def __init__(self) -> None:
        self._known = Memory[Complexes](EXACT_SPECTRA_BYTES, lambda spectrum: spectrum.nbytes)

    def of(
        self, samples: Floats, taps: Floats, name: Hashable, n_times: int
    ) -> Callable[[list[Channel]], Complexes]:
        """Return a function from channels to spectra, (n_channels, n_times // 2 + 1).

        Parameters
        ----------
        samples
            The drive; its response ends within ``n_times``.
        taps : (n_outputs, 3 axes, n_taps)
            Responses to the place of the drive.
        name
            What the responses are remembered under.
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


# The spectrum of all voices together, where it is asked for.


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TotalSpectrum:
    """Sum of what the other voices and the edited one cause, made row by row.

    Attributes
    ----------
    shape
        Outputs, axes, and bins.
    n_fft
        Length of the transforms.
    others : (n_outputs, n_axes, n_bins) or None
        Vibration by the other voices; None: none of them moves anything.
    response, drive, weight
        Responses to the place of the edited voice, the spectrum of its drive, (n_bins,), onset
        included, and what stands before it; None where there is no such voice.
    """

    shape: tuple[int, int, int]
    n_fft: int
    others: Complexes | None
    response: ResponseSpectrum | None
    drive: Complexes | None
    weight: float

    def times(self, weights: Floats) -> "TotalSpectrum":
        """The same through a filter, of which ``weights``, (n_bins,), is the response."""
        return replace(
            self,
            others=None if self.others is None else self.others * weights,
            drive=None if self.drive is None else self.drive * weights,
        )

    def rows(self, outputs: np.ndarray, axes: tuple[int, ...]) -> Complexes:
        """Spectra of some outputs, counted from 0, and axes, (n, n_axes, n_bins)."""
        rows = np.ix_(outputs, np.array(axes))
        if self.others is None:
            total = np.zeros((len(outputs), len(axes), self.shape[-1]), np.complex128)
        else:
            total = self.others[rows]
        if self.response is not None and self.drive is not None and self.weight != 0.0:
            total += self.response.values[rows] * self.drive * self.weight
        return total


# A limb behind actuators: its responses are to the drives, not to the probe.


def actuated_limb(limb: Limb, actuation: Actuation, scaling: Scaling) -> Limb:
    """Return ``limb`` as it answers through actuators.

    Its responses are those of the limb, calibrated to the acceleration of the probe, convolved with
    what equaliser and actuator of the place make of an impulse: longer, and from before time 0 on.
    Nothing is read yet.

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
