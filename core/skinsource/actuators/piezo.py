"""A piezoelectric actuator."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from skinsource import fields
from skinsource.actuators import parameters
from skinsource.actuators.actuator import LinearActuator
from skinsource.actuators.simulating import Equations
from skinsource.arrays import Complexes

CAPACITANCE = parameters.positive("Capacitance", "F", "Of the clamped actuator")
COUPLING = parameters.not_negative("Coupling", "N/V", "Force for each volt, and A for each m/s")
SERIES = parameters.positive("Series resistance", "Ω", "Of amplifier and leads")


@dataclass(frozen=True, slots=True)
class Piezo(LinearActuator):
    """A piezoelectric bender or stack behind the resistance of its amplifier.

    With the voltage e over the capacitance: u = R i + e, i = C de/dt + alpha v, and
    alpha e = m a + (c + c_skin) v + (k + k_skin) x.

    Attributes
    ----------
    capacitance_f, coupling_n_per_v
        C, clamped, above 0, and alpha, 0 or more.
    moving_mass_kg, damping_n_s_per_m, stiffness_n_per_m
        m, above 0, c and k (short-circuited), 0 or more.
    series_resistance_ohm
        R, above 0: it bounds the current that charges the capacitance.
    skin_stiffness_n_per_m, skin_damping_n_s_per_m
        k_skin and c_skin of the skin at the contact, 0 or more; 0 in air.
    """

    title: ClassVar[str] = "Piezo"

    capacitance_f: float = fields.field(CAPACITANCE)
    coupling_n_per_v: float = fields.field(COUPLING)
    moving_mass_kg: float = fields.field(parameters.MOVING_MASS)
    damping_n_s_per_m: float = fields.field(parameters.DAMPING)
    stiffness_n_per_m: float = fields.field(parameters.STIFFNESS)
    series_resistance_ohm: float = fields.number(100.0, SERIES)
    skin_stiffness_n_per_m: float = fields.number(0.0, parameters.SKIN_STIFFNESS)
    skin_damping_n_s_per_m: float = fields.number(0.0, parameters.SKIN_DAMPING)

    def __post_init__(self) -> None:
        fields.check(self)

    def equations(self) -> Equations:
        """Voltage over the capacitance, velocity and displacement."""
        mass, coupling = self.moving_mass_kg, self.coupling_n_per_v
        damping = self.damping_n_s_per_m + self.skin_damping_n_s_per_m
        stiffness = self.stiffness_n_per_m + self.skin_stiffness_n_per_m
        admittance = 1.0 / self.series_resistance_ohm
        charging = admittance / self.capacitance_f
        return Equations(
            dynamics=(
                (-charging, -coupling / self.capacitance_f, 0.0),
                (coupling / mass, -damping / mass, -stiffness / mass),
                (0.0, 1.0, 0.0),
            ),
            drive=(charging, 0.0, 0.0),
            velocity=(0.0, 1.0, 0.0),
            displacement=(0.0, 0.0, 1.0),
            current=(-admittance, 0.0, 0.0),
            passed_a_per_v=admittance,
        )

    def response_at(self, s: Complexes) -> Complexes:
        """A / U = s alpha / (Z (1 + s R C) + R alpha²) with Z = m s + c + k / s."""
        return s * self.coupling_n_per_v / self._divisor(s)

    def current_at(self, s: Complexes) -> Complexes:
        """(s C Z + alpha²) / (Z (1 + s R C) + R alpha²)."""
        flowing = s * self.capacitance_f * self._mechanical(s) + np.square(self.coupling_n_per_v)
        return flowing / self._divisor(s)

    def _mechanical(self, s: Complexes) -> Complexes:
        damping = self.damping_n_s_per_m + self.skin_damping_n_s_per_m
        stiffness = self.stiffness_n_per_m + self.skin_stiffness_n_per_m
        return self.moving_mass_kg * s + damping + stiffness / s

    def _divisor(self, s: Complexes) -> Complexes:
        charged = 1.0 + s * self.series_resistance_ohm * self.capacitance_f
        moved = self.series_resistance_ohm * np.square(self.coupling_n_per_v)
        return self._mechanical(s) * charged + moved
