"""The prediction for plain drives: `predict`, without a design.

The skin answers with the sum of the convolutions of drives and responses (eq. 1 of the SkinSource
paper).  Spectra of responses and gains of drives are remembered for all threads, in bounded memory.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from hashlib import sha256
from itertools import islice
from sys import getsizeof
from threading import Lock
from weakref import ref

import numpy as np
from numpy.typing import ArrayLike

from skinsource.actuators.actuation import Actuation
from skinsource.base.arguments import checking, real_array
from skinsource.base.conventions import Complexes, Floats, check_input_location
from skinsource.base.errors import InvalidInputError
from skinsource.design.signal_path import LARGEST, Drive, check_drive, drive_of, first_unusable
from skinsource.engine.drives import active_samples
from skinsource.engine.gains import unit_gain, unit_gains
from skinsource.engine.memory import GAINS_BYTES, PREDICT_BYTES, Memory
from skinsource.engine.spectra import (
    Response,
    ResponseSpectra,
    ResponseSpectrum,
    actuated_limb,
    superpose,
)
from skinsource.engine.streaming import StreamedVibration
from skinsource.engine.transforms import Blocks, Played, forward, length_at_once
from skinsource.limbs.catalog import limb_of
from skinsource.limbs.limb import Limb
from skinsource.limbs.scaling import Scaling, check_scaling


@checking
def predict(
    limb: Limb | str,
    drives: ArrayLike,
    locations: Sequence[int] | int,
    amplitudes: ArrayLike | None = None,
    scaling: Scaling = "probe",
    actuation: Actuation | None = None,
) -> Floats:
    """Return the skin acceleration at all outputs, for drives at some input locations.

    Parameters
    ----------
    limb
        From `load_limb`, or its name, which opens it anew in each call.  Only the responses to the
        locations in use are read.
    drives : (n_inputs, n_times)
        Samples of each input: probe acceleration, m/s²; dimensionless in the other scalings.
    locations : (n_inputs,)
        Input location of each drive, from 1.  A location may occur more than once.
    amplitudes : (n_inputs,), optional
        Factor of each input, 1 by default; may be negative or zero.
    scaling
        As that of a design.  ``"probe"``: responses calibrated to probe acceleration
        (`skinsource.limbs.scaling`).  ``"upstream"``: the vibration by each input is divided by its
        signed maximum over all outputs, axes and times: an amplitude is that maximum in m/s².
        ``"relative"``: no division; 1 is the measuring pulse, sample by sample.
    actuation
        Actuators between drives and skin, under ``"probe"`` scaling; drives are then in the unit
        that `Actuation` states.

    Returns
    -------
    (n_outputs, n_axes, n_times + n_taps - 1), m/s², float64: the full linear convolution.
    Through actuators it starts at time 0 too, and is longer by what they ring after the end.

    Raises
    ------
    InvalidInputError
        Drives are empty or of unequal length, a value is not finite, or a location or the scaling
        is unknown.

    Examples
    --------
    >>> import skinsource as ss
    >>> acceleration = ss.predict("synthetic-1", [ss.sinusoid(100.0)], [7])
    >>> levels_db = ss.decibels(ss.rms(ss.project_axes(acceleration, "xyz", "mag")))
    >>> figure = ss.plot.map(levels_db, limb="synthetic-1")
    """
    limb = limb_of(limb)
    check_scaling(scaling)
    samples = _checked_drives(drives)
    checked_locations = _checked_locations(locations, len(samples), limb.n_inputs)
    if actuation is not None:
        actuated = actuated_limb(limb, actuation, scaling)
        for drive, location in zip(samples, checked_locations, strict=True):
            check_drive(actuation, drive_of(drive), limb.sample_rate_hz, limb.band_hz, location)
        vibration = predict(actuated, samples, checked_locations, amplitudes, scaling)
        return vibration[..., actuated.lead_samples :]
    factors = _checked_amplitudes(amplitudes, len(samples))
    response_samples = samples.shape[-1] + limb.n_taps - 1
    played = [
        (drive, location, amplitude)
        for drive, location, amplitude in zip(
            map(drive_of, samples), checked_locations, factors, strict=True
        )
        if not drive.silent and amplitude != 0.0
    ]
    n_locations = len({location for _, location, _ in played})
    n_fft = length_at_once(response_samples, n_locations, limb.n_outputs * limb.n_axes)
    if n_fft is None:
        streamed = _streamed(limb, played, scaling, response_samples)
        return streamed.traces(*streamed.every_channel)
    return _at_once(
        limb, played, scaling, response_samples, _shorter_length(n_fft, response_samples)
    )


def _shorter_length(n_fft: int, n_times: int) -> int:
    """Return 27 times a power of two instead of 30 times, which is as quick, if it is enough."""
    shorter = n_fft * 9 // 10
    return shorter if n_fft % 10 == 0 and shorter >= n_times else n_fft


# Far more than anybody has drives for.
_MOST_LOCATIONS = 10**5
_PlacedDrive = tuple[Drive, int, float]


def _streamed(
    limb: Limb, placed_drives: list[_PlacedDrive], scaling: Scaling, response_samples: int
) -> StreamedVibration:
    blocks, shape = Blocks(limb.n_taps), (limb.n_outputs, limb.n_axes, response_samples)
    if not placed_drives:
        return StreamedVibration([], None, shape, blocks)
    used = tuple(sorted({location for _, location, _ in placed_drives}))
    # It is not remembered: it takes as much memory as all that is.
    stack = ResponseSpectra().stack(limb, used, scaling, blocks.n_fft)
    drives = [drive for drive, _, _ in placed_drives]
    gains = [drive.factor for drive in drives]
    if scaling == "upstream":
        gains = unit_gains(
            drives, [], [stack.responses[location] for _, location, _ in placed_drives]
        )
    played = [
        Played(drive=drive, start=0, weight=amplitude * gain, location=location)
        for (drive, location, amplitude), gain in zip(placed_drives, gains, strict=True)
    ]
    return StreamedVibration(played, stack, shape, blocks)


def _at_once(
    limb: Limb,
    placed_drives: list[_PlacedDrive],
    scaling: Scaling,
    response_samples: int,
    n_fft: int,
) -> Floats:
    vibration = np.empty((limb.n_outputs, limb.n_axes, response_samples))
    if not placed_drives:
        return np.zeros_like(vibration)
    drives, locations, amplitudes = (list(column) for column in zip(*placed_drives, strict=True))
    spectra = [forward(drive.samples, n_fft) for drive in drives]
    responses: Sequence[Response]
    if len(drives) == 1:
        responses = [_cached_spectra().of_one(limb, locations[0], scaling, n_fft)]
        superpose(responses, spectra, vibration)
        # The maximum of a single vibration needs no search.
        gain = drives[0].factor
        if scaling == "upstream":
            gain = unit_gain(float(vibration.max()), drives[0], responses[0])
        vibration *= amplitudes[0] * gain
    else:
        responses = _cached_spectra().of(limb, locations, scaling, n_fft)
        gains = [drive.factor for drive in drives]
        if scaling == "upstream":
            gains = _gains_of(limb, locations, drives, spectra, responses)
        superpose(
            responses,
            [
                spectrum * (gain * amplitude)
                for spectrum, gain, amplitude in zip(spectra, gains, amplitudes, strict=True)
            ],
            vibration,
        )
    # Where nothing can move, the vibration is exactly 0, without the rounding of the transforms.
    if any(drive.samples.all() for drive in drives):
        return vibration
    sounding = np.zeros(response_samples, bool)
    for drive in drives:
        sounding[: drive.samples.size] |= drive.samples != 0.0
    active = active_samples(sounding, limb.n_taps)
    if not active.all():
        vibration[..., ~active] = 0.0
    return vibration


@cache
def _cached_spectra() -> ResponseSpectra:
    return ResponseSpectra(PREDICT_BYTES)


@cache
def _cached_gains() -> Memory[float]:
    return Memory(GAINS_BYTES, getsizeof)


_GAINS_LOCK = Lock()


def _gains_of(
    limb: Limb,
    locations: Sequence[int],
    drives: Sequence[Drive],
    spectra: Sequence[Complexes],
    responses: Sequence[ResponseSpectrum],
) -> list[float]:
    """Return the gain of each drive at its location; arguments as those of `unit_gains`."""
    digests = [sha256(drive.samples.tobytes()).digest() for drive in drives]
    keys = [
        (ref(limb), location, response.n_fft, drive.factor, digest)
        for location, response, drive, digest in zip(
            locations, responses, drives, digests, strict=True
        )
    ]
    memory = _cached_gains()
    with _GAINS_LOCK:
        known = {key: gain for key in keys if (gain := memory.find(key)) is not None}
    new = {key: k for k, key in enumerate(keys) if key not in known}
    if new:
        gains = unit_gains(
            [drives[k] for k in new.values()],
            [spectra[k] for k in new.values()],
            [responses[k] for k in new.values()],
            # Bounds by frequency cost more to prepare than the channels that they spare.
            tight=False,
        )
        known |= zip(new, gains, strict=True)
        with _GAINS_LOCK:
            for key in new:
                if memory.find(key) is None:
                    memory.add(key, known[key])
    return [known[key] for key in keys]


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
    # As an array, True would become 1, and 7 beside 2.5 would become 7.0.
    values = locations.tolist() if isinstance(locations, np.ndarray) else locations
    # An iterable may have no end.
    checked = list(islice(values, _MOST_LOCATIONS)) if isinstance(values, Iterable) else [values]
    for location in checked:
        check_input_location(location, n_inputs)
    if len(checked) != n_drives:
        raise InvalidInputError(
            f"{len(checked)} locations for {n_drives} drives: expected one location for each drive"
        )
    return checked


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
