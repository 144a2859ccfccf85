"""Fit a voice coil to a measured response."""

from __future__ import annotations

from itertools import product

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.actuators.actuator import Actuator
from skinsource.actuators.measured_response import measured_arrays
from skinsource.actuators.models import VoiceCoil
from skinsource.base.arguments import positive_number
from skinsource.base.arrays import Complexes, Floats
from skinsource.base.errors import InvalidInputError

#: The model has four constants that a response determines; fewer points than these are no fit.
_FEWEST_POINTS = 8
_QUALITIES, _TIMES_S = (0.7, 3.0, 15.0), (1e-5, 2e-4)


def fit(
    frequency_hz: ArrayLike,
    response: ArrayLike,
    *,
    resistance_ohm: float = 8.0,
    moving_mass_kg: float | None = None,
) -> VoiceCoil:
    """Return the voice coil whose response is nearest to a measured one.

    Nearest means: the sum of squares of the relative differences is the least.  A response in m/s²
    per V determines four of the six parameters of a coil: the resistance is given (measure it with
    an ohmmeter), and the mass may be; without it the motion is that of the measurement, and the
    current is a guess.

    Parameters
    ----------
    frequency_hz, response : (n,)
        At least 8 points; real values are taken as magnitudes without a known phase.
    resistance_ohm, moving_mass_kg
        Above 0.

    Raises
    ------
    InvalidInputError
        There are too few points, or nothing near them is a voice coil.

    Examples
    --------
    >>> import skinsource as ss
    >>> import numpy as np
    >>> coil, hz = ss.actuators.load("example-voice-coil"), np.geomspace(25.0, 600.0, 40)
    >>> fitted = ss.actuators.fit(hz, coil.response(hz))
    >>> print(f"{ss.actuators.misfit_db(fitted, hz, coil.response(hz)):.1f} dB")
    0.0 dB
    """
    known_hz, values = measured_arrays(frequency_hz, response)
    resistance = positive_number("resistance_ohm", resistance_ohm)
    mass = None if moving_mass_kg is None else positive_number("moving_mass_kg", moving_mass_kg)
    if known_hz.size < _FEWEST_POINTS:
        raise InvalidInputError(
            f"{known_hz.size} points are too few for a fit, expected at least {_FEWEST_POINTS}"
        )
    with_phase = bool(np.iscomplexobj(np.asarray(response)) and values.imag.any())

    def coil(logs: Floats) -> VoiceCoil:
        inductance, force, damping, stiffness, *free = np.exp(logs).tolist()
        return VoiceCoil(
            resistance, inductance, force, free[0] if mass is None else mass, damping, stiffness
        )

    def misfits(logs: Floats) -> Floats:
        return _differences(coil(logs), known_hz, values, with_phase)

    def cost(start: Floats) -> float:
        return float(np.square(misfits(start)).sum())

    starts = sorted(_starts(known_hz, values, resistance, mass), key=cost)[:4]
    fits = (
        scipy.optimize.least_squares(misfits, start, bounds=(start - 14.0, start + 14.0))
        for start in starts
    )
    best = min(fits, key=lambda result: float(result.cost))
    return coil(best.x)


def misfit_db(actuator: Actuator, frequency_hz: ArrayLike, response: ArrayLike) -> float:
    """Return the largest difference between the gains of an actuator and a measurement, in dB.

    Examples
    --------
    >>> import skinsource as ss
    >>> import numpy as np
    >>> model, hz = ss.actuators.load(ss.actuators.names()[0]), np.geomspace(25.0, 600.0, 20)
    >>> print(ss.actuators.misfit_db(model, hz, model.response(hz)))
    0.0
    """
    known_hz, values = measured_arrays(frequency_hz, response)
    gain = np.abs(actuator.response(known_hz))
    with np.errstate(divide="ignore"):
        return float(np.abs(20.0 * np.log10(gain / np.abs(values))).max())


def _differences(
    coil: VoiceCoil, frequency_hz: Floats, values: Complexes, with_phase: bool
) -> Floats:
    response = coil.response(frequency_hz)
    if not with_phase:
        gain: Floats = np.log(np.abs(response) / np.abs(values))
        return gain
    relative = (response - values) / np.abs(values)
    return np.concatenate((relative.real, relative.imag))


def _starts(
    frequency_hz: Floats, values: Complexes, resistance: float, mass: float | None
) -> list[Floats]:
    """Return logarithms of parameters to start from: resonances in the band and at the peak.

    Force factors are such that the gain fits in the middle.
    """
    first, last = frequency_hz[0], frequency_hz[-1]
    resonances = [*np.geomspace(first, last, 7), frequency_hz[np.abs(values).argmax()]]
    starts = []
    for resonance_hz, quality, time_s in product(resonances, _QUALITIES, _TIMES_S):
        turning = 2.0 * np.pi * resonance_hz
        own = 1e-3 if mass is None else mass
        shape = VoiceCoil(
            resistance, resistance * time_s, 1e-3, own, own * turning / quality, own * turning**2
        )
        ratio = np.abs(values) / np.abs(shape.response(frequency_hz))
        force = 1e-3 * float(np.exp(np.median(np.log(ratio))))
        # What brakes electrically must not brake mechanically as well.
        damping = max(
            own * turning / quality - force**2 / resistance, 0.05 * own * turning / quality
        )
        logs = [resistance * time_s, force, damping, own * turning**2]
        starts.append(np.log([*logs, own] if mass is None else logs))
    return starts
