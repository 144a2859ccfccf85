"""A coil that moves a contactor."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from skinsource import fields
from skinsource.actuators import parameters
from skinsource.actuators.actuator import LinearActuator
from skinsource.actuators.simulating import Equations
from skinsource.arrays import Complexes


@dataclass(frozen=True, slots=True)
class VoiceCoil(LinearActuator):
    """A voice coil, or a linear resonant actuator, whose moving mass touches the skin.

    u = R i + L di/dt + Bl v and Bl i = m a + (c + c_skin) v + (k + k_skin) x, driven by a voltage.

    Attributes
    ----------
    resistance_ohm, inductance_h, moving_mass_kg
        R, L and m, above 0 without another bound.
    force_factor_n_per_a, damping_n_s_per_m, stiffness_n_per_m
        Bl, c and k, 0 or more.
    skin_stiffness_n_per_m, skin_damping_n_s_per_m
        k_skin and c_skin of the skin at the contact, 0 or more; 0 in air.

    References
    ----------
    Thiele, Loudspeakers in vented boxes, J. Audio Eng. Soc. 19, 1971: the same mechanics and coil.
    """

    title: ClassVar[str] = "Voice coil"

    resistance_ohm: float = fields.field(parameters.RESISTANCE)
    inductance_h: float = fields.field(parameters.INDUCTANCE)
    force_factor_n_per_a: float = fields.field(parameters.FORCE_FACTOR)
    moving_mass_kg: float = fields.field(parameters.MOVING_MASS)
    damping_n_s_per_m: float = fields.field(parameters.DAMPING)
    stiffness_n_per_m: float = fields.field(parameters.STIFFNESS)
    skin_stiffness_n_per_m: float = fields.number(0.0, parameters.SKIN_STIFFNESS)
    skin_damping_n_s_per_m: float = fields.number(0.0, parameters.SKIN_DAMPING)

    def __post_init__(self) -> None:
        fields.check(self)

    def equations(self) -> Equations:
        """Current, velocity and displacement."""
        mass, coupling = self.moving_mass_kg, self.force_factor_n_per_a
        damping = self.damping_n_s_per_m + self.skin_damping_n_s_per_m
        stiffness = self.stiffness_n_per_m + self.skin_stiffness_n_per_m
        inductance = self.inductance_h
        return Equations(
            dynamics=(
                (-self.resistance_ohm / inductance, -coupling / inductance, 0.0),
                (coupling / mass, -damping / mass, -stiffness / mass),
                (0.0, 1.0, 0.0),
            ),
            drive=(1.0 / inductance, 0.0, 0.0),
            velocity=(0.0, 1.0, 0.0),
            displacement=(0.0, 0.0, 1.0),
            current=(1.0, 0.0, 0.0),
        )

    def response_at(self, s: Complexes) -> Complexes:
        """A / U = s Bl / (Z (R + s L) + Bl²) with the mechanical impedance Z = m s + c + k / s."""
        return s * self.force_factor_n_per_a / self._divisor(s)

    def current_at(self, s: Complexes) -> Complexes:
        """Z / (Z (R + s L) + Bl²)."""
        return self._mechanical(s) / self._divisor(s)

    def _mechanical(self, s: Complexes) -> Complexes:
        damping = self.damping_n_s_per_m + self.skin_damping_n_s_per_m
        stiffness = self.stiffness_n_per_m + self.skin_stiffness_n_per_m
        return self.moving_mass_kg * s + damping + stiffness / s

    def _divisor(self, s: Complexes) -> Complexes:
        electrical = self.resistance_ohm + s * self.inductance_h
        return self._mechanical(s) * electrical + np.square(self.force_factor_n_per_a)
