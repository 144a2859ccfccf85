"""How the skin answers: superposition of convolutions (eq. 1 of the SkinSource paper)."""

from collections.abc import Iterable, Sequence
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import fft

from skinsource.calibration import per_probe_acceleration
from skinsource.errors import InvalidInputError
from skinsource.limb import Limb, check_input_location

Floats = NDArray[np.float64]
Scaling = Literal["upstream", "relative", "probe"]
SCALINGS: tuple[Scaling, ...] = get_args(Scaling)

# Beyond it the transforms overflow, and NaN would come out.
_LARGEST = 1e30


def predict(
    limb: Limb,
    drives: ArrayLike,
    locations: Sequence[int] | int,
    amplitudes: ArrayLike | None = None,
    scaling: Scaling = "upstream",
) -> Floats:
    """Skin acceleration at all outputs, for drives at some input places.

    Parameters
    ----------
    limb
        From `load_limb`.  Only the responses of the places in use are read.
    drives : (n_inputs, n_times)
        What each input plays.  Dimensionless; with ``scaling="probe"`` probe acceleration, m/s².
    locations : (n_inputs,)
        Input place of each drive, 1 to 20.  A place may occur more than once.
    amplitudes : (n_inputs,), optional
        Factor of each input, 1 by default; may be negative or zero.
    scaling
        ``"upstream"``: the field of each input is divided by its signed maximum over all outputs,
        axes and times, so that an amplitude is that maximum in m/s².  ``"relative"``: no division;
        1 is the measuring pulse, sample by sample.  ``"probe"``: responses calibrated to probe
        acceleration (`skinsource.calibration`).

    Returns
    -------
    (72 outputs, 3 axes, n_times + 521), m/s², float64: the full linear convolution.

    Raises
    ------
    InvalidInputError
        Empty or unequal drives, values that are not finite, unknown places or scaling.
    """
    check_scaling(scaling)
    samples = _checked_drives(drives)
    places = _checked_locations(locations, len(samples))
    factors = _checked_amplitudes(amplitudes, len(samples))
    total: Floats | None = None
    for drive, place, amplitude in zip(samples, places, factors, strict=True):
        field = input_field(limb, place, drive, scaling)
        field *= amplitude * unit_gain(field, scaling)
        total = field if total is None else np.add(total, field, out=total)
    if total is None:
        raise InvalidInputError("drives has no rows: expected at least one input")
    return total


def input_field(limb: Limb, location: int, drive: Floats, scaling: Scaling) -> Floats:
    """Field of one input at amplitude 1, before any gain, (72 outputs, 3 axes, n_times + 521)."""
    response = limb.response_to(location)
    if scaling == "probe":
        response = per_probe_acceleration(response, limb.sample_rate_hz)
    n_times = drive.size + response.shape[-1] - 1
    if not drive.any():
        return np.zeros((*response.shape[:-1], n_times))
    n_fft = fft.next_fast_len(n_times, real=True)
    spectrum = fft.rfft(response, n_fft)
    spectrum *= fft.rfft(drive, n_fft)
    return fft.irfft(spectrum, n_fft, overwrite_x=True)[..., :n_times]


def unit_gain(field: Floats, scaling: Scaling) -> float:
    """What a unit field is multiplied with under a scaling.

    For ``"upstream"`` one over its signed maximum; 1 where there is no positive sample, or none
    whose reciprocal is a number.
    """
    if scaling != "upstream":
        return 1.0
    largest = float(field.max())
    return 1.0 / largest if largest >= np.finfo(np.float64).tiny else 1.0


def check_scaling(scaling: str) -> None:
    """Raise `InvalidInputError` unless ``scaling`` is one of `SCALINGS`."""
    if scaling not in SCALINGS:
        raise InvalidInputError(
            f"scaling {scaling!r} is not known; choose from {', '.join(SCALINGS)}"
        )


def _checked_drives(drives: ArrayLike) -> Floats:
    try:
        samples = _real(drives)
    except (TypeError, ValueError) as error:
        raise InvalidInputError(
            "drives cannot be read as one array of real numbers: expected (n_inputs, n_times), all "
            "inputs of equal length. Pad the shorter ones with zeros."
        ) from error
    if samples.ndim == 1:
        samples = samples[None]
    if samples.ndim != 2 or 0 in samples.shape:
        raise InvalidInputError(
            f"drives has shape {samples.shape}, expected (n_inputs, n_times) with at least one "
            "input and one sample"
        )
    usable = np.abs(samples) <= _LARGEST
    if not usable.all():
        row, sample = np.argwhere(~usable)[0]
        raise InvalidInputError(
            f"drive {row + 1}, sample {sample} is {samples[row, sample]}, expected a finite number "
            f"of at most {_LARGEST:g}"
        )
    return samples


def _checked_locations(locations: Sequence[int] | int, n_inputs: int) -> list[int]:
    # An array would make 1 of True and 7.0 of 7 beside 2.5.
    found = locations.tolist() if isinstance(locations, np.ndarray) else locations
    places = list(found) if isinstance(found, Iterable) else [found]
    for place in places:
        check_input_location(place)
    if len(places) != n_inputs:
        raise InvalidInputError(
            f"{len(places)} locations for {n_inputs} drives: expected one location for each drive"
        )
    return places


def _checked_amplitudes(amplitudes: ArrayLike | None, n_inputs: int) -> Floats:
    if amplitudes is None:
        return np.ones(n_inputs)
    try:
        factors = np.atleast_1d(_real(amplitudes))
    except (TypeError, ValueError) as error:
        raise InvalidInputError(
            f"amplitudes cannot be read as numbers: expected {n_inputs}, one for each drive"
        ) from error
    if factors.shape != (n_inputs,):
        raise InvalidInputError(
            f"amplitudes has shape {factors.shape}, expected ({n_inputs},): one for each drive"
        )
    if not (np.abs(factors) <= _LARGEST).all():
        raise InvalidInputError(
            f"amplitudes are {factors.tolist()}, expected finite numbers of at most {_LARGEST:g}"
        )
    return factors


def _real(values: ArrayLike) -> Floats:
    # Texts and complex numbers are refused, not read or halved.
    return np.asarray(values).astype(np.float64, casting="same_kind", copy=False)
