"""What every actuator can do."""

from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from skinsource.actuators.motion import ActuatorMotion
from skinsource.actuators.simulating import Equations, Hold, simulated
from skinsource.arguments import finite_array, positive_number
from skinsource.arrays import Complexes
from skinsource.errors import InvalidInputError


class Actuator(ABC):
    """A frozen dataclass of parameters.

    Attributes
    ----------
    title
        What a user calls this kind.
    """

    __slots__ = ()

    title: ClassVar[str]

    @abstractmethod
    def response(self, frequency_hz: ArrayLike) -> Complexes:
        """Acceleration of what touches the skin over the voltage, in m/s² per V.

        Parameters
        ----------
        frequency_hz
            Of any shape, finite; at 0 nothing is accelerated for ever.

        Returns
        -------
        Complex amplitudes of the shape of ``frequency_hz``: a voltage of cos(2 pi f t) gives the
        real part of response exp(2 pi i f t) once what the start caused has died away.
        """

    @abstractmethod
    def admittance(self, frequency_hz: ArrayLike) -> Complexes:
        """Current over voltage, in A/V, of the shape of ``frequency_hz``; NaN where not known."""

    @abstractmethod
    def simulate(
        self, voltage: ArrayLike, sample_rate_hz: float, hold: Hold = "zero"
    ) -> ActuatorMotion:
        """Motion under a voltage, from rest, at its samples.

        Parameters
        ----------
        voltage : (n_times,)
            In V; there is none before.
        sample_rate_hz
            Any rate above 0.
        hold
            What the voltage does between two samples: ``"zero"``, it stays; ``"first"``, it goes
            evenly from one to the next.

        Raises
        ------
        InvalidInputError
            The voltage is not one row of finite numbers, or the motion is beyond all floats.
        """


class LinearActuator(Actuator):
    """An actuator with linear equations of motion.

    What it does under a voltage is exact for the voltage as it is held, at any rate; rounding is
    all that is lost, and the motion neither diverges nor gains energy, however lightly it is
    damped.
    """

    __slots__ = ()

    @abstractmethod
    def equations(self) -> Equations:
        """Equations of motion."""

    @abstractmethod
    def response_at(self, s: Complexes) -> Complexes:
        """Acceleration over voltage at complex frequencies other than 0, in m/s² per V."""

    @abstractmethod
    def current_at(self, s: Complexes) -> Complexes:
        """Current over voltage at complex frequencies other than 0, in A/V."""

    def response(self, frequency_hz: ArrayLike) -> Complexes:
        """Acceleration over voltage, in m/s² per V."""
        s = _imaginary(frequency_hz)
        with np.errstate(all="ignore"):
            found = self.response_at(s)
        return _known(np.where(s == 0.0, 0.0, found))

    def admittance(self, frequency_hz: ArrayLike) -> Complexes:
        """Current over voltage, in A/V, at frequencies other than 0."""
        with np.errstate(all="ignore"):
            found = self.current_at(_imaginary(frequency_hz))
        return _known(found)

    def simulate(
        self, voltage: ArrayLike, sample_rate_hz: float, hold: Hold = "zero"
    ) -> ActuatorMotion:
        """Motion under a voltage, from rest, at its samples."""
        step_s = 1.0 / positive_number("sample_rate_hz", sample_rate_hz)
        with np.errstate(all="ignore"):
            return simulated(self.equations(), voltage, step_s, hold)


def _imaginary(frequency_hz: ArrayLike) -> Complexes:
    found = finite_array("frequency_hz", frequency_hz, "finite frequencies in Hz")
    s: Complexes = (2j * np.pi * found).astype(np.complex128)
    return s


def _known(values: Complexes) -> Complexes:
    if not np.isfinite(values).all():
        raise InvalidInputError(
            "the response is beyond all floating-point numbers; move the parameters nearer to "
            "those of real actuators"
        )
    return values
