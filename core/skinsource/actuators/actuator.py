"""The interface of all actuators, the specs of their parameters, and the response shape."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from skinsource.actuators.simulation import ActuatorMotion, Equations, Hold, simulated
from skinsource.base.arguments import finite_array, positive_number
from skinsource.base.conventions import Complexes
from skinsource.base.errors import InvalidInputError
from skinsource.specs import fields
from skinsource.specs.numbers import SMALLEST, NumberSpec


def positive(label: str, unit: str, hint: str = "") -> NumberSpec:
    """Return a parameter above 0."""
    return NumberSpec(
        label=label, unit=unit, minimum=SMALLEST, step=0.02, logarithmic=True, hint=hint
    )


def not_negative(label: str, unit: str, hint: str = "") -> NumberSpec:
    """Return a parameter of 0 or more."""
    return NumberSpec(label=label, unit=unit, minimum=0.0, step=0.02, logarithmic=True, hint=hint)


RESISTANCE = positive("Resistance", "Ω", "Of the coil")
INDUCTANCE = positive("Inductance", "H", "Of the coil")
FORCE_FACTOR = not_negative("Force factor", "N/A", "Force per ampere, and volts per m/s")
MOVING_MASS = positive("Moving mass", "kg")
DAMPING = not_negative("Damping", "N s/m", "Of the suspension")
STIFFNESS = not_negative("Stiffness", "N/m", "Of the suspension")
SKIN_STIFFNESS = not_negative("Skin stiffness", "N/m", "Of the skin at the contact; 0 in air")
SKIN_DAMPING = not_negative("Skin damping", "N s/m", "Of the skin at the contact; 0 in air")


@dataclass(frozen=True, slots=True)
class ResponseShape(fields.CheckedModel):
    """A resonance without a scale: it shows a shape, and cannot be simulated in m/s².

    Attributes
    ----------
    resonance_hz, quality
        Of the moving mass on its spring, both above 0.
    """

    title: ClassVar[str] = "Response shape"

    resonance_hz: float = fields.field(positive("Resonance", "Hz"))
    quality: float = fields.field(positive("Quality factor", ""))

    def shape(self, frequency_hz: ArrayLike) -> Complexes:
        """Return the acceleration relative to that far above the resonance, at equal force.

        s² / (s² + s w / Q + w²), of the shape of ``frequency_hz``.
        """
        ratio = finite_array("frequency_hz", frequency_hz) / self.resonance_hz
        return np.asarray(-(ratio**2) / (1.0 - ratio**2 + 1j * ratio / self.quality), np.complex128)


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
        """Return the acceleration of the contactor per volt, in m/s² per V.

        Parameters
        ----------
        frequency_hz
            Of any shape, finite; at 0 Hz the acceleration is 0.

        Returns
        -------
        Complex amplitudes of the shape of ``frequency_hz``: a voltage of cos(2 pi f t) gives the
        real part of response exp(2 pi i f t) once what the start caused has died away.
        """

    @abstractmethod
    def admittance(self, frequency_hz: ArrayLike) -> Complexes:
        """Return current over voltage, A/V, shaped as ``frequency_hz``; NaN where not known."""

    @abstractmethod
    def simulate(
        self, voltage: ArrayLike, sample_rate_hz: float, hold: Hold = "zero"
    ) -> ActuatorMotion:
        """Return the motion under a voltage, from rest, at its samples.

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
            The voltage is not one row of finite numbers, or the motion overflows.
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
        """Return the equations of motion."""

    @abstractmethod
    def response_at(self, s: Complexes) -> Complexes:
        """Return acceleration over voltage at complex frequencies other than 0, in m/s² per V."""

    @abstractmethod
    def current_at(self, s: Complexes) -> Complexes:
        """Return current over voltage at complex frequencies other than 0, in A/V."""

    def response(self, frequency_hz: ArrayLike) -> Complexes:
        """Return acceleration over voltage, in m/s² per V."""
        s = _laplace_variable(frequency_hz)
        with np.errstate(all="ignore"):
            response = self.response_at(s)
        return _check_finite(np.where(s == 0.0, 0.0, response))

    def admittance(self, frequency_hz: ArrayLike) -> Complexes:
        """Return current over voltage, in A/V, at frequencies other than 0."""
        with np.errstate(all="ignore"):
            current = self.current_at(_laplace_variable(frequency_hz))
        return _check_finite(current)

    def simulate(
        self, voltage: ArrayLike, sample_rate_hz: float, hold: Hold = "zero"
    ) -> ActuatorMotion:
        """Return the motion under a voltage, from rest, at its samples."""
        step_s = 1.0 / positive_number("sample_rate_hz", sample_rate_hz)
        with np.errstate(all="ignore"):
            return simulated(self.equations(), voltage, step_s, hold)


def _laplace_variable(frequency_hz: ArrayLike) -> Complexes:
    frequency = finite_array("frequency_hz", frequency_hz, "finite frequencies in Hz")
    return (2j * np.pi * frequency).astype(np.complex128)


def _check_finite(values: Complexes) -> Complexes:
    if not np.isfinite(values).all():
        raise InvalidInputError(
            "the response overflows; choose parameters nearer to those of real actuators"
        )
    return values
