"""What every equaliser can do."""

from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from skinsource.actuators import Actuator
from skinsource.arguments import finite_array
from skinsource.arrays import Complexes, Floats
from skinsource.errors import InvalidInputError
from skinsource.limb import BAND_HZ, Band

# Beyond the band the target falls to nothing: over an octave below, and up to 7/6 of its end, 700
# Hz of the published limbs, above.
_FALLS_BELOW, _FALLS_ABOVE = 1.0 / 2.0, 7.0 / 6.0
_ZOOMS, _ZOOMED = 4, 41


class Equaliser(ABC):
    """A frozen dataclass of settings.

    Attributes
    ----------
    title
        What a user calls this kind.
    """

    __slots__ = ()

    title: ClassVar[str]

    @abstractmethod
    def filter(
        self, actuator: Actuator, frequency_hz: ArrayLike, band_hz: Band = BAND_HZ
    ) -> Complexes:
        """Voltage for each m/s² of the drive, in V per m/s², of the shape of ``frequency_hz``.

        Parameters
        ----------
        actuator
            What it is made for.
        frequency_hz
            0 or above.
        band_hz
            In which it is made to follow; see `skinsource.equalising.followed_band`.

        Raises
        ------
        InvalidInputError
            The actuator does not move in the band, so that nothing inverts it.
        """


def target(frequency_hz: ArrayLike, band_hz: Band = BAND_HZ) -> Floats:
    """What is asked for, of the shape of ``frequency_hz``: 1 in the band, 0 far from it.

    Between, half a cosine over the logarithm of the frequency.
    """
    size_hz = np.abs(finite_array("frequency_hz", frequency_hz, "finite frequencies in Hz"))
    with np.errstate(divide="ignore"):
        place = np.log(size_hz)
    low, high = band_hz
    edges = ((low, low * _FALLS_BELOW), (high, high * _FALLS_ABOVE))
    beyond = [
        np.clip((place - np.log(full)) / (np.log(gone) - np.log(full)), 0.0, 1.0)
        for full, gone in edges
    ]
    found: Floats = np.prod([0.5 * (1.0 + np.cos(np.pi * part)) for part in beyond], axis=0)
    return found


def in_band_hz(band_hz: Band = BAND_HZ) -> Floats:
    """Frequencies over a band by which an actuator is judged, (400,)."""
    return np.geomspace(*band_hz, 400)


def largest_gain(actuator: Actuator, band_hz: Band = BAND_HZ) -> float:
    """Largest gain of an actuator in the band, however sharp its peak, in m/s² per V; above 0."""
    gain, frequency_hz = gain_in_band(actuator, band_hz), in_band_hz(band_hz)
    for _ in range(_ZOOMS):
        # On both sides of a resonance the gain rises towards it.
        place = int(gain.argmax())
        low = float(frequency_hz[max(place - 1, 0)])
        high = float(frequency_hz[min(place + 1, frequency_hz.size - 1)])
        frequency_hz = np.linspace(low, high, _ZOOMED)
        gain = np.abs(actuator.response(frequency_hz))
    return float(gain.max())


def mean_gain(actuator: Actuator, band_hz: Band = BAND_HZ) -> float:
    """Geometric mean of the gain in the band, in m/s² per V, of where it moves at all."""
    return mean_of(gain_in_band(actuator, band_hz))


def mean_of(gain: Floats) -> float:
    """Geometric mean of gains, (n,), of those above 0."""
    # What does not move at all somewhere says nothing about the mean.
    return float(np.exp(np.mean(np.log(gain[gain > 0.0]))))


def gain_in_band(actuator: Actuator, band_hz: Band = BAND_HZ) -> Floats:
    """Gain of an actuator at `in_band_hz`, (400,), in m/s² per V; above 0 somewhere.

    Raises
    ------
    InvalidInputError
        It does not move at all.
    """
    gain = np.abs(actuator.response(in_band_hz(band_hz)))
    if not gain.max() > 0.0:
        raise InvalidInputError(
            f"the actuator does not move from {band_hz[0]:g} to {band_hz[1]:g} Hz, so no equaliser "
            "can make it; give it a force factor or a coupling above 0"
        )
    return gain
