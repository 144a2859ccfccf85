"""How the skin answers: superposition of convolutions (eq. 1 of the SkinSource paper)."""

import math
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from itertools import islice

import numpy as np
from numpy.typing import ArrayLike

from skinsource.arguments import real_array
from skinsource.arrays import Complexes, Floats
from skinsource.chain import LARGEST, Actuation, Drive, drive_of, first_unusable, refuse_unfollowed
from skinsource.errors import InvalidInputError
from skinsource.limb import Limb, check_input_location
from skinsource.prediction.gains_of_drives import GainsOfDrives
from skinsource.prediction.spectra_of_limbs import SpectraOfLimbs
from skinsource.prediction.superposition import caused_by_one, superposed
from skinsource.quoting import quoted
from skinsource.rendering.actuated import actuated_limb
from skinsource.rendering.drives import active_samples
from skinsource.rendering.gains import exceeds_rounding, unit_gains
from skinsource.rendering.response_spectra import Norms, ResponseSpectra, bounded_taps
from skinsource.rendering.segments import Blocks, Played, length_at_once
from skinsource.rendering.streaming import StreamedVibration
from skinsource.rendering.sums import parts_of
from skinsource.rendering.transforms import forward
from skinsource.scaling.response_scaling import Scaling, check_scaling


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
        acceleration (`skinsource.scaling.calibration`).
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
        return _through(actuation, limb, samples, places, amplitudes, scaling)
    factors = _checked_amplitudes(amplitudes, len(samples))
    response_samples = samples.shape[-1] + limb.n_taps - 1
    heard = [
        (drive, place, amplitude)
        for drive, place, amplitude in zip(map(drive_of, samples), places, factors, strict=True)
        if not drive.silent and amplitude != 0.0
    ]
    n_places = len({place for _, place, _ in heard})
    n_fft = length_at_once(response_samples, n_places, limb.n_outputs * limb.n_axes)
    if n_fft is None:
        return _streamed(limb, heard, scaling, response_samples).everything()
    return _at_once(limb, heard, scaling, response_samples, _shorter(n_fft, response_samples))


def _shorter(n_fft: int, n_times: int) -> int:
    """A transform of 27 times a power of two is as quick as its neighbours, 24 and 30 times."""
    shorter = n_fft * 9 // 10
    return shorter if n_fft % 10 == 0 and shorter >= n_times else n_fft


def _through(
    actuation: Actuation,
    limb: Limb,
    samples: Floats,
    places: list[int],
    amplitudes: ArrayLike | None,
    scaling: Scaling,
) -> Floats:
    """The same through actuators, from time 0 on."""
    through = actuated_limb(limb, actuation, scaling)
    for one, place in zip(samples, places, strict=True):
        refuse_unfollowed(actuation, drive_of(one), limb.sample_rate_hz, limb.band_hz, place)
    vibration = predict(through, samples, places, amplitudes, scaling)
    return vibration[..., through.lead_samples :]


# Far more than anybody has drives for.
_MOST_LOCATIONS = 10**5
_Heard = tuple[Drive, int, float]


def _streamed(
    limb: Limb, heard: list[_Heard], scaling: Scaling, response_samples: int
) -> StreamedVibration:
    blocks, shape = Blocks(limb.n_taps), (limb.n_outputs, limb.n_axes, response_samples)
    if not heard:
        return StreamedVibration([], None, shape, blocks)
    used = tuple(sorted({place for _, place, _ in heard}))
    # As large as all that is remembered: made anew.
    stack = ResponseSpectra().stack(limb, used, scaling, blocks.n_fft)
    drives = [drive for drive, _, _ in heard]
    gains = [drive.factor for drive in drives]
    if scaling == "upstream":
        gains = unit_gains(drives, [], [stack.responses[place] for _, place, _ in heard])
    played = [
        Played(drive=drive, start=0, weight=amplitude * gain, location=place)
        for (drive, place, amplitude), gain in zip(heard, gains, strict=True)
    ]
    return StreamedVibration(played, stack, shape, blocks)


def _at_once(
    limb: Limb, heard: list[_Heard], scaling: Scaling, response_samples: int, n_fft: int
) -> Floats:
    shape = limb.n_outputs, limb.n_axes, response_samples
    if not heard:
        return np.zeros(shape)
    drives = [drive for drive, _, _ in heard]
    played = [forward(drive.samples, n_fft) for drive in drives]
    together = _alone if len(heard) == 1 else _together
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


def _together(
    limb: Limb,
    heard: list[_Heard],
    played: list[Complexes],
    scaling: Scaling,
    shape: tuple[int, int, int],
    n_fft: int,
) -> Floats:
    drives, places = [drive for drive, _, _ in heard], [place for _, place, _ in heard]
    responses = _remembered().of(limb, places, scaling, n_fft)
    gains = [drive.factor for drive in drives]
    if scaling == "upstream":
        gains = _known_gains().of(limb, places, drives, played, responses)
    weighted = [
        spectrum * (gain * amplitude)
        for spectrum, gain, (_, _, amplitude) in zip(played, gains, heard, strict=True)
    ]
    vibration = np.empty(shape)
    pieces = superposed([one.values.__getitem__ for one in responses], weighted, shape, n_fft)
    for part, piece in zip(parts_of(limb.n_outputs), pieces, strict=True):
        vibration[part] = piece
    return vibration


def _alone(
    limb: Limb,
    heard: list[_Heard],
    played: list[Complexes],
    scaling: Scaling,
    shape: tuple[int, int, int],
    n_fft: int,
) -> Floats:
    """As `_together` by one drive, which has its maximum in what is computed anyway."""
    ((drive, place, amplitude),) = heard
    known = _remembered().of_one(limb, place, scaling, n_fft)
    if known is None:
        taps, largest_tap = bounded_taps(limb, place, scaling)
        vibration, largest = caused_by_one(taps, played[0], shape, n_fft)
        energies = _energies(taps, largest_tap)
    else:
        vibration, largest = caused_by_one(known, played[0], shape, n_fft)
        energies = iter([float(known.norms.energies.max())])
    gain = drive.factor
    if scaling == "upstream" and any(
        exceeds_rounding(largest, drive, energy, n_fft) for energy in energies
    ):
        gain = 1.0 / largest
    vibration *= amplitude * gain
    return vibration


def _energies(taps: Floats, largest_tap: float) -> Iterator[float]:
    """What the largest energy of a response is at most, and what it is."""
    # None has more than one that is at its largest all the time.  Most often this is enough to
    # know, and norms need not be computed.
    yield math.sqrt(taps.shape[-1]) * largest_tap
    yield float(Norms.of(taps).energies.max())


@cache
def _remembered() -> SpectraOfLimbs:
    return SpectraOfLimbs()


@cache
def _known_gains() -> GainsOfDrives:
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
    found = locations.tolist() if isinstance(locations, np.ndarray) else locations
    # There may be no end to them.
    places = list(islice(found, _MOST_LOCATIONS)) if isinstance(found, Iterable) else [found]
    for place in places:
        check_input_location(place, n_inputs)
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
