"""A second thread that helps where a processor is free, and holds nobody up where none is."""

import math
from _thread import start_new_thread
from collections import OrderedDict, deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from functools import cache, partial
from hashlib import sha256
from itertools import islice
from math import inf, prod
from queue import Empty, SimpleQueue
from sys import getsizeof
from threading import Lock
from time import perf_counter
from typing import TypeVar
from weakref import WeakKeyDictionary, ref

import numpy as np
from numpy.typing import ArrayLike

from skinsource.actuators.actuation import Actuation
from skinsource.base.arguments import real_array
from skinsource.base.arrays import Complexes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.published import check_input_location
from skinsource.base.quoting import quoted
from skinsource.base.work import tally
from skinsource.design.signal_path import LARGEST, Drive, check_drive, drive_of, first_unusable
from skinsource.engine.drives import active_samples
from skinsource.engine.gains import exceeds_rounding, unit_gains
from skinsource.engine.memory import PREDICT_BYTES, PREDICT_GAINS_BYTES, Memory
from skinsource.engine.spectra import (
    Norms,
    ResponseSpectra,
    ResponseSpectrum,
    actuated_limb,
    bounded_taps,
    scaled_taps,
)
from skinsource.engine.streaming import StreamedVibration
from skinsource.engine.transforms import (
    OUTPUTS_AT_ONCE,
    Blocks,
    Played,
    add_up,
    forward,
    forward_in_parts,
    inverse_here,
    length_at_once,
    parts_of,
)
from skinsource.limbs.limb import Limb
from skinsource.limbs.scaling import Scaling, check_scaling

Result = TypeVar("Result")


def run_with_helper(tasks: Sequence[Callable[[], Result]]) -> list[Result]:
    """Return what ``tasks`` return, in their order.

    A second thread takes some of them.  What it has begun and not finished in the least time that
    a task took, this one does itself: a task may be done twice, and be done again when this has
    returned.  It may write only what it would write each time, and count no work, which belongs to
    a thread.  What a task raises is raised here.
    """
    waiting = deque(range(len(tasks)))
    done: SimpleQueue[tuple[int, Result]] = SimpleQueue()

    def help_out() -> None:
        try:
            while waiting:
                number = waiting.pop()
                done.put((number, tasks[number]()))
        except Exception:  # noqa: BLE001, S110  this thread finds no more, or fails as the other will
            pass

    results: dict[int, Result] = {}
    if len(tasks) > 1:
        with suppress(RuntimeError):  # no more threads are to be had
            # One of the threading module would be waited for until it runs.
            start_new_thread(help_out, ())
    shortest_s = inf
    while waiting:
        try:
            number = waiting.popleft()
        except IndexError:
            break
        begin = perf_counter()
        results[number] = tasks[number]()
        shortest_s = min(shortest_s, perf_counter() - begin)
    # Others took longer where other programs had the processor meanwhile.
    deadline = perf_counter() + (shortest_s if results else 0.0)
    while len(results) < len(tasks):
        try:
            number, result = done.get(timeout=max(deadline - perf_counter(), 0.0))
        except Empty:
            break
        results[number] = result
    return [results[k] if k in results else tasks[k]() for k in range(len(tasks))]


# Spectra of the responses of limbs that scripts use, in bounded memory, for all threads.


class _Places:
    """Spectra at one length, in one piece of memory for so many places."""

    def __init__(self, limb: Limb, n_fft: int, most_places: int) -> None:
        self.n_fft = n_fft
        self._shape = limb.n_outputs, limb.n_axes, n_fft // 2 + 1
        self._values = np.empty((most_places, *self._shape), np.complex128)
        self.known: dict[int, ResponseSpectrum] = {}

    @property
    def held_bytes(self) -> int:
        return len(self.known) * 16 * prod(self._shape)

    def add(self, taps: dict[int, Floats]) -> dict[int, ResponseSpectrum]:
        """Transform responses by place; they are remembered as far as there is room."""
        first = len(self.known)
        rooms = list(self._values[first : first + len(taps)])
        rooms += [np.empty(self._shape, np.complex128) for _ in range(len(taps) - len(rooms))]
        pairs = zip(taps.values(), rooms, strict=True)
        spectra = run_with_helper([partial(_response, *pair, self.n_fft) for pair in pairs])
        tally(forward_transforms=len(taps) * prod(self._shape[:2]))
        added = dict(zip(taps, spectra, strict=True))
        self.known |= dict(list(added.items())[: len(self._values) - first])
        return added


def _response(taps: Floats, values: Complexes, n_fft: int) -> ResponseSpectrum:
    # Some outputs at a time: their spectra stay in a core's own cache.
    for part, spectra in forward_in_parts(taps, n_fft, OUTPUTS_AT_ONCE):
        values[part] = spectra
    return ResponseSpectrum(taps, values, n_fft, Norms.of(taps))


# Far more than are asked for in turn.
_MOST_REQUESTED = 10_000
# Length, and whether calibrated.
_Key = tuple[int, bool]
_Lengths = OrderedDict[_Key, _Places]


class SpectraOfLimbs:
    """What is remembered of a limb goes with it; of the rest, the least recently used goes first.

    Parameters
    ----------
    budget_bytes
        What all spectra together may take.
    """

    def __init__(self, budget_bytes: int = PREDICT_BYTES) -> None:
        self._budget_bytes = budget_bytes
        self._lock = Lock()
        # The latest last, limbs and lengths.
        self._known: WeakKeyDictionary[Limb, _Lengths] = WeakKeyDictionary()
        self._asked: WeakKeyDictionary[Limb, set[tuple[int, _Key]]] = WeakKeyDictionary()

    @property
    def held_bytes(self) -> int:
        """What the spectra take in memory."""
        with self._lock:
            return self._sum()

    def of(
        self, limb: Limb, places: Sequence[int], scaling: Scaling, n_fft: int
    ) -> list[ResponseSpectrum]:
        """Responses to each of ``places``, transformed where they are not remembered."""
        key = n_fft, scaling == "probe"
        with self._lock:
            lengths = self._known.pop(limb, None)
            self._known[limb] = lengths = OrderedDict() if lengths is None else lengths
            if key not in lengths:
                lengths[key] = _Places(limb, n_fft, self._most_places(limb, n_fft))
            lengths.move_to_end(key)
            known = lengths[key].known
            new = [location for location in dict.fromkeys(places) if location not in known]
            taps = {location: scaled_taps(limb, location, scaling) for location in new}
            added = lengths[key].add(taps) if new else {}
            self._forget()
            return [
                added[location] if location in added else known[location] for location in places
            ]

    def of_one(
        self, limb: Limb, location: int, scaling: Scaling, n_fft: int
    ) -> ResponseSpectrum | None:
        """Responses to ``place``; None where they are asked for the first time.

        Whoever predicts once does not pay for what is kept.
        """
        with self._lock:
            requested = self._asked.setdefault(limb, set())
            key = n_fft, scaling == "probe"
            lengths = self._known.get(limb)
            is_known = lengths is not None and key in lengths and location in lengths[key].known
            if not is_known and (location, key) not in requested:
                if len(requested) >= _MOST_REQUESTED:
                    requested.clear()
                requested.add((location, key))
                return None
        return self.of(limb, [location], scaling, n_fft)[0]

    def _most_places(self, limb: Limb, n_fft: int) -> int:
        each = 16 * limb.n_outputs * limb.n_axes * (n_fft // 2 + 1)
        return min(limb.n_inputs, self._budget_bytes // each)

    def _forget(self) -> None:
        excess = self._sum() - self._budget_bytes
        for lengths in list(self._known.values()):
            while lengths and excess > 0:
                _, oldest = lengths.popitem(last=False)
                excess -= oldest.held_bytes

    def _sum(self) -> int:
        known = list(self._known.values())
        return sum(spectra.held_bytes for lengths in known for spectra in lengths.values())


# The vibration by drives at some places, from spectra.

#: Spectra of the responses at some outputs.
SpectraOf = Callable[[slice], Complexes]


def superposed(
    spectra: Sequence[SpectraOf],
    drives: Sequence[Complexes],
    shape: tuple[int, int, int],
    n_fft: int,
) -> list[Floats]:
    """Vibration by ``drives``.

    Parameters
    ----------
    spectra
        Of the responses to the place of each drive, (n, 3 axes, n_fft // 2 + 1) for n outputs.
    drives : (n_fft // 2 + 1,) each
        Spectra, at least one.
    shape
        Outputs, axes and samples of the vibration.

    Returns
    -------
    The vibration, m/s², in pieces of some outputs (`parts_of`).  Each piece is taken from the
    spectra to the samples at once: what lies between stays in a core's own cache.
    """

    def samples_of(part: slice) -> Floats:
        responses = [spectra_of(part) for spectra_of in spectra]
        total = np.empty_like(responses[0])
        add_up(responses, drives, total)
        return inverse_here(total, n_fft)[..., : shape[-1]]

    pieces = run_with_helper([partial(samples_of, part) for part in parts_of(shape[0])])
    tally(inverse_transforms=shape[0] * shape[1])
    return pieces


def single_response(
    responses: Floats | ResponseSpectrum,
    drive: Complexes,
    shape: tuple[int, int, int],
    n_fft: int,
) -> tuple[Floats, float]:
    """Vibration by one drive, and its largest sample.

    One thread does it: where no processor is free a second one would make it slower than the plain
    way, and where one is free it gains little of what is over in a few milliseconds.

    Parameters
    ----------
    responses
        To its place: as samples, (n_outputs, 3 axes, n_taps), or transformed.
    drive : (n_fft // 2 + 1,)
        Its spectrum.
    shape
        Outputs, axes and samples of the vibration.

    Returns
    -------
    The vibration, (n_outputs, 3 axes, n_times), m/s², and m/s².
    """
    n_outputs, n_axes, n_times = shape
    vibration, largest = np.empty(shape), -np.inf
    at_once = max(1, _SAMPLES_AT_ONCE // (n_axes * n_fft))
    for part, spectra in _spectra_in_parts(responses, drive, n_fft, at_once):
        piece = vibration[part]
        piece[:] = inverse_here(spectra, n_fft)[..., :n_times]
        largest = max(largest, float(piece.max()))
    tally(inverse_transforms=n_outputs * n_axes)
    return vibration, largest


def _spectra_in_parts(
    responses: Floats | ResponseSpectrum, drive: Complexes, n_fft: int, at_once: int
) -> Iterator[tuple[slice, Complexes]]:
    if isinstance(responses, ResponseSpectrum):
        for low in range(0, len(responses.values), at_once):
            part = slice(low, low + at_once)
            yield part, responses.values[part] * drive
    else:
        for part, spectra in forward_in_parts(responses, n_fft, at_once):
            # They are wanted for nothing else.
            spectra *= drive
            yield part, spectra
        tally(forward_transforms=responses.shape[0] * responses.shape[1])


# What a core's own cache holds of spectra and as many samples, beside what they come from.
_SAMPLES_AT_ONCE = 2**16


# Gains of any samples at places of limbs, which are searched for once.


class GainsOfDrives:
    """Gains of drives at places, in bounded memory, for all threads."""

    def __init__(self) -> None:
        self._known = Memory[float](PREDICT_GAINS_BYTES, getsizeof)
        self._lock = Lock()

    def of(
        self,
        limb: Limb,
        places: Sequence[int],
        drives: Sequence[Drive],
        spectra: Sequence[Complexes],
        responses: Sequence[ResponseSpectrum],
    ) -> list[float]:
        """Gain of each drive at its place; arguments as those of `unit_gains`."""
        keys = [
            (
                ref(limb),
                location,
                response.n_fft,
                drive.factor,
                sha256(drive.samples.tobytes()).digest(),
            )
            for location, drive, response in zip(places, drives, responses, strict=True)
        ]
        with self._lock:
            known = {key: gain for key in keys if (gain := self._known.find(key)) is not None}
        missing = {key: k for k, key in enumerate(keys) if key not in known}
        new = list(missing.values())
        if new:
            gains = unit_gains(
                [drives[k] for k in new],
                [spectra[k] for k in new],
                [responses[k] for k in new],
                # Bounds by frequency cost more to prepare than the channels that they spare.
                tight=False,
            )
            known |= zip(missing, gains, strict=True)
            with self._lock:
                for key in missing:
                    if self._known.find(key) is None:
                        self._known.add(key, known[key])
        return [known[key] for key in keys]


# How the skin answers: superposition of convolutions (eq. 1 of the SkinSource paper).


def predict(
    limb: Limb,
    drives: ArrayLike,
    locations: Sequence[int] | int,
    amplitudes: ArrayLike | None = None,
    scaling: Scaling = "upstream",
    actuation: Actuation | None = None,
) -> Floats:
    """Skin acceleration at all outputs, for drives at some input places.

    Parameters
    ----------
    limb
        From `load_limb`.  Only the responses of the places in use are read.
    drives : (n_inputs, n_times)
        What each input plays.  Dimensionless; with ``scaling="probe"`` probe acceleration, m/s².
    locations : (n_inputs,)
        Input place of each drive, from 1.  A place may occur more than once.
    amplitudes : (n_inputs,), optional
        Factor of each input, 1 by default; may be negative or zero.
    scaling
        ``"upstream"``: what each input causes is divided by its signed maximum over all outputs,
        axes and times, so that an amplitude is that maximum in m/s².  ``"relative"``: no division;
        1 is the measuring pulse, sample by sample.  ``"probe"``: responses calibrated to probe
        acceleration (`skinsource.limbs.scaling`).
    actuation
        Actuators before the skin, under ``"probe"`` scaling: drives are `Actuation`'s.

    Returns
    -------
    (n_outputs, n_axes, n_times + n_taps - 1), m/s², float64: the full linear convolution;
    through actuators with what they ring after the end, from time 0 on.

    Raises
    ------
    InvalidInputError
        Empty or unequal drives, values that are not finite, unknown places or scaling.
    """
    if not isinstance(limb, Limb):
        raise InvalidInputError(f"limb is {quoted(limb)}, expected a Limb, see load_limb")
    check_scaling(scaling)
    samples = _checked_drives(drives)
    places = _checked_locations(locations, len(samples), limb.n_inputs)
    if actuation is not None:
        return _predict_through(actuation, limb, samples, places, amplitudes, scaling)
    factors = _checked_amplitudes(amplitudes, len(samples))
    response_samples = samples.shape[-1] + limb.n_taps - 1
    played = [
        (drive, location, amplitude)
        for drive, location, amplitude in zip(map(drive_of, samples), places, factors, strict=True)
        if not drive.silent and amplitude != 0.0
    ]
    n_places = len({location for _, location, _ in played})
    n_fft = length_at_once(response_samples, n_places, limb.n_outputs * limb.n_axes)
    if n_fft is None:
        return _streamed(limb, played, scaling, response_samples).everything()
    return _at_once(
        limb, played, scaling, response_samples, _shorter_length(n_fft, response_samples)
    )


def _shorter_length(n_fft: int, n_times: int) -> int:
    """A transform of 27 times a power of two is as quick as its neighbours, 24 and 30 times."""
    shorter = n_fft * 9 // 10
    return shorter if n_fft % 10 == 0 and shorter >= n_times else n_fft


def _predict_through(
    actuation: Actuation,
    limb: Limb,
    samples: Floats,
    places: list[int],
    amplitudes: ArrayLike | None,
    scaling: Scaling,
) -> Floats:
    """The same through actuators, from time 0 on."""
    actuated = actuated_limb(limb, actuation, scaling)
    for drive, location in zip(samples, places, strict=True):
        check_drive(actuation, drive_of(drive), limb.sample_rate_hz, limb.band_hz, location)
    vibration = predict(actuated, samples, places, amplitudes, scaling)
    return vibration[..., actuated.lead_samples :]


# Far more than anybody has drives for.
_MOST_LOCATIONS = 10**5
_PlacedDrive = tuple[Drive, int, float]


def _streamed(
    limb: Limb, heard: list[_PlacedDrive], scaling: Scaling, response_samples: int
) -> StreamedVibration:
    blocks, shape = Blocks(limb.n_taps), (limb.n_outputs, limb.n_axes, response_samples)
    if not heard:
        return StreamedVibration([], None, shape, blocks)
    used = tuple(sorted({location for _, location, _ in heard}))
    # As large as all that is remembered: made anew.
    stack = ResponseSpectra().stack(limb, used, scaling, blocks.n_fft)
    drives = [drive for drive, _, _ in heard]
    gains = [drive.factor for drive in drives]
    if scaling == "upstream":
        gains = unit_gains(drives, [], [stack.responses[location] for _, location, _ in heard])
    played = [
        Played(drive=drive, start=0, weight=amplitude * gain, location=location)
        for (drive, location, amplitude), gain in zip(heard, gains, strict=True)
    ]
    return StreamedVibration(played, stack, shape, blocks)


def _at_once(
    limb: Limb, heard: list[_PlacedDrive], scaling: Scaling, response_samples: int, n_fft: int
) -> Floats:
    shape = limb.n_outputs, limb.n_axes, response_samples
    if not heard:
        return np.zeros(shape)
    drives = [drive for drive, _, _ in heard]
    played = [forward(drive.samples, n_fft) for drive in drives]
    together = _response_to_drive if len(heard) == 1 else _response_to_drives
    vibration = together(limb, heard, played, scaling, shape, n_fft)
    # Where nothing can move nothing does, not even by the rounding of the transforms.
    if any(drive.samples.all() for drive in drives):
        return vibration
    sounding = np.zeros(response_samples, bool)
    for drive in drives:
        sounding[: drive.samples.size] |= drive.samples != 0.0
    active = active_samples(sounding, limb.n_taps)
    if not active.all():
        vibration[..., ~active] = 0.0
    return vibration


def _response_to_drives(
    limb: Limb,
    heard: list[_PlacedDrive],
    played: list[Complexes],
    scaling: Scaling,
    shape: tuple[int, int, int],
    n_fft: int,
) -> Floats:
    drives, places = [drive for drive, _, _ in heard], [location for _, location, _ in heard]
    responses = _cached_spectra().of(limb, places, scaling, n_fft)
    gains = [drive.factor for drive in drives]
    if scaling == "upstream":
        gains = _cached_gains().of(limb, places, drives, played, responses)
    weighted = [
        spectrum * (gain * amplitude)
        for spectrum, gain, (_, _, amplitude) in zip(played, gains, heard, strict=True)
    ]
    vibration = np.empty(shape)
    pieces = superposed(
        [response.values.__getitem__ for response in responses], weighted, shape, n_fft
    )
    for part, piece in zip(parts_of(limb.n_outputs), pieces, strict=True):
        vibration[part] = piece
    return vibration


def _response_to_drive(
    limb: Limb,
    drives: list[_PlacedDrive],
    played: list[Complexes],
    scaling: Scaling,
    shape: tuple[int, int, int],
    n_fft: int,
) -> Floats:
    """As `_together` by one drive, which has its maximum in what is computed anyway."""
    ((drive, location, amplitude),) = drives
    known = _cached_spectra().of_one(limb, location, scaling, n_fft)
    if known is None:
        taps, largest_tap = bounded_taps(limb, location, scaling)
        vibration, largest = single_response(taps, played[0], shape, n_fft)
        energies = _energy_bounds(taps, largest_tap)
    else:
        vibration, largest = single_response(known, played[0], shape, n_fft)
        energies = iter([float(known.norms.energies.max())])
    gain = drive.factor
    if scaling == "upstream" and any(
        exceeds_rounding(largest, drive, energy, n_fft) for energy in energies
    ):
        gain = 1.0 / largest
    vibration *= amplitude * gain
    return vibration


def _energy_bounds(taps: Floats, largest_tap: float) -> Iterator[float]:
    """What the largest energy of a response is at most, and what it is."""
    # None has more than one that is at its largest all the time.  Most often this is enough to
    # know, and norms need not be computed.
    yield math.sqrt(taps.shape[-1]) * largest_tap
    yield float(Norms.of(taps).energies.max())


@cache
def _cached_spectra() -> SpectraOfLimbs:
    return SpectraOfLimbs()


@cache
def _cached_gains() -> GainsOfDrives:
    return GainsOfDrives()


def _checked_drives(drives: ArrayLike) -> Floats:
    samples = real_array("drives", drives, "(n_inputs, n_times), all inputs of equal length")
    if samples.ndim == 1:
        samples = samples[None]
    if samples.ndim != 2 or 0 in samples.shape:
        raise InvalidInputError(
            f"drives has shape {samples.shape}, expected (n_inputs, n_times) with at least one "
            "input and one sample"
        )
    bad = first_unusable(samples)
    if bad is not None:
        row, sample = bad
        raise InvalidInputError(
            f"drive {row + 1}, sample {sample} is {samples[row, sample]}, expected a finite number "
            f"of at most {LARGEST:g}"
        )
    return samples


def _checked_locations(locations: Sequence[int] | int, n_drives: int, n_inputs: int) -> list[int]:
    # An array would make 1 of True and 7.0 of 7 beside 2.5.
    values = locations.tolist() if isinstance(locations, np.ndarray) else locations
    # There may be no end to them.
    places = list(islice(values, _MOST_LOCATIONS)) if isinstance(values, Iterable) else [values]
    for location in places:
        check_input_location(location, n_inputs)
    if len(places) != n_drives:
        raise InvalidInputError(
            f"{len(places)} locations for {n_drives} drives: expected one location for each drive"
        )
    return places


def _checked_amplitudes(amplitudes: ArrayLike | None, n_inputs: int) -> Floats:
    if amplitudes is None:
        return np.ones(n_inputs)
    factors = np.atleast_1d(real_array("amplitudes", amplitudes, f"{n_inputs}, one for each drive"))
    if factors.shape != (n_inputs,):
        raise InvalidInputError(
            f"amplitudes has shape {factors.shape}, expected ({n_inputs},): one for each drive"
        )
    if not (np.abs(factors) <= LARGEST).all():
        raise InvalidInputError(
            f"amplitudes are {factors.tolist()}, expected finite numbers of at most {LARGEST:g}"
        )
    return factors
