"""What every equaliser can do."""

from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from skinsource.actuators import Actuator
from skinsource.arguments import finite_array
from skinsource.arrays import Complexes, Floats
from skinsource.errors import InvalidInputError
from skinsource.limb import BAND_HZ

# Beyond it the target falls to nothing: over an octave below, and up to 700 Hz above.
_FALLS_TO_HZ = (12.5, 700.0)
#: Frequencies over the band by which an actuator is judged.
IN_BAND_HZ = np.geomspace(*BAND_HZ, 400)
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
    def filter(self, actuator: Actuator, frequency_hz: ArrayLike) -> Complexes:
        """Voltage for each m/s² of the drive, in V per m/s², of the shape of ``frequency_hz``.

        Parameters
        ----------
        actuator
            What it is made for.
        frequency_hz
            0 or above.

        Raises
        ------
        InvalidInputError
            The actuator does not move in the band, so that nothing inverts it.
        """


def target(frequency_hz: ArrayLike) -> Floats:
    """What is asked for, of the shape of ``frequency_hz``: 1 in the band, 0 far from it.

    Between, half a cosine over the logarithm of the frequency.
    """
    size_hz = np.abs(finite_array("frequency_hz", frequency_hz, "finite frequencies in Hz"))
    with np.errstate(divide="ignore"):
        place = np.log(size_hz)
    edges = zip(BAND_HZ, _FALLS_TO_HZ, strict=True)
    beyond = [
        np.clip((place - np.log(full)) / (np.log(gone) - np.log(full)), 0.0, 1.0)
        for full, gone in edges
    ]
    found: Floats = np.prod([0.5 * (1.0 + np.cos(np.pi * part)) for part in beyond], axis=0)
    return found


def largest_gain(actuator: Actuator) -> float:
    """Largest gain of an actuator in the band, however sharp its peak, in m/s² per V; above 0."""
    gain, frequency_hz = gain_in_band(actuator), IN_BAND_HZ
    for _ in range(_ZOOMS):
        # On both sides of a resonance the gain rises towards it.
        place = int(gain.argmax())
        low = float(frequency_hz[max(place - 1, 0)])
        high = float(frequency_hz[min(place + 1, frequency_hz.size - 1)])
        frequency_hz = np.linspace(low, high, _ZOOMED)
        gain = np.abs(actuator.response(frequency_hz))
    return float(gain.max())


def gain_in_band(actuator: Actuator) -> Floats:
    """Gain of an actuator at `IN_BAND_HZ`, (400,), in m/s² per V; above 0 somewhere.

    Raises
    ------
    InvalidInputError
        It does not move at all.
    """
    gain = np.abs(actuator.response(IN_BAND_HZ))
    if not gain.max() > 0.0:
        raise InvalidInputError(
            "the actuator does not move from 25 to 600 Hz, so no equaliser can make it; give it a "
            "force factor or a coupling above 0"
        )
    return gain
