"""A coil inside a casing that recoils."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from skinsource import fields
from skinsource.actuators import parameters
from skinsource.actuators.actuator import LinearActuator
from skinsource.actuators.simulating import Equations
from skinsource.arrays import Complexes

CASING_MASS = parameters.positive("Casing mass", "kg", "What touches the skin, and recoils")


@dataclass(frozen=True, slots=True)
class RecoilVoiceCoil(LinearActuator):
    """An inertial actuator: a mass moves inside a casing, and the casing touches the skin.

    With the velocity v of the mass inside and w of the casing, r = v - w and its integral q:
    u = R i + L di/dt + Bl r;  F = Bl i - c r - k q;  m dv/dt = F;
    M dw/dt = -F - c_skin w - k_skin z, where z is the displacement of the casing.  Motions and
    responses are those of the casing: above its resonance it recoils as one half of a pair of
    free masses, against the sign of the mass inside.

    Attributes
    ----------
    resistance_ohm, inductance_h, moving_mass_kg, casing_mass_kg
        R, L, m and M, above 0.
    force_factor_n_per_a, damping_n_s_per_m, stiffness_n_per_m
        Bl, c and k, 0 or more.
    skin_stiffness_n_per_m, skin_damping_n_s_per_m
        Of the skin under the casing, 0 or more; 0 where it hangs free.
    """

    title: ClassVar[str] = "Recoil voice coil"

    resistance_ohm: float = fields.field(parameters.RESISTANCE)
    inductance_h: float = fields.field(parameters.INDUCTANCE)
    force_factor_n_per_a: float = fields.field(parameters.FORCE_FACTOR)
    moving_mass_kg: float = fields.field(parameters.MOVING_MASS)
    damping_n_s_per_m: float = fields.field(parameters.DAMPING)
    stiffness_n_per_m: float = fields.field(parameters.STIFFNESS)
    casing_mass_kg: float = fields.field(CASING_MASS)
    skin_stiffness_n_per_m: float = fields.number(0.0, parameters.SKIN_STIFFNESS)
    skin_damping_n_s_per_m: float = fields.number(0.0, parameters.SKIN_DAMPING)

    def __post_init__(self) -> None:
        fields.check(self)

    def equations(self) -> Equations:
        """Current, velocities between the masses and of their common centre, and displacements."""
        inductance, coupling = self.inductance_h, self.force_factor_n_per_a
        casing, total = self.casing_mass_kg, self.moving_mass_kg + self.casing_mass_kg
        # The casing moves less than the centre by this share of what lies between the masses.
        share = self.moving_mass_kg / total
        reduced = share * casing
        force = np.array((coupling, -self.damping_n_s_per_m, 0.0, -self.stiffness_n_per_m, 0.0))
        velocity = np.array((0.0, -share, 1.0, 0.0, 0.0))
        displacement = np.array((0.0, 0.0, 0.0, -share, 1.0))
        skin = self.skin_damping_n_s_per_m * velocity + self.skin_stiffness_n_per_m * displacement
        return Equations(
            dynamics=np.array(
                (
                    (-self.resistance_ohm / inductance, -coupling / inductance, 0.0, 0.0, 0.0),
                    force / reduced + skin / casing,
                    -skin / total,
                    (0.0, 1.0, 0.0, 0.0, 0.0),
                    (0.0, 0.0, 1.0, 0.0, 0.0),
                )
            ),
            drive=(1.0 / inductance, 0.0, 0.0, 0.0, 0.0),
            velocity=velocity,
            displacement=displacement,
            current=(1.0, 0.0, 0.0, 0.0, 0.0),
        )

    def response_at(self, s: Complexes) -> Complexes:
        """-s² m Bl / (P (R + s L) + Bl² S), P and S as `_joined` gives them."""
        parted, both = self._joined(s)
        driven = -self.force_factor_n_per_a * self.moving_mass_kg * s**2
        return driven / self._divisor(s, parted, both)

    def current_at(self, s: Complexes) -> Complexes:
        """P / (P (R + s L) + Bl² S)."""
        parted, both = self._joined(s)
        return parted / self._divisor(s, parted, both)

    def _joined(self, s: Complexes) -> tuple[Complexes, Complexes]:
        """Impedances: what parts the masses times S, P, and that of both together, S."""
        inner = self.moving_mass_kg * s
        casing = self.casing_mass_kg * s
        casing = casing + self.skin_damping_n_s_per_m + self.skin_stiffness_n_per_m / s
        suspension = self.damping_n_s_per_m + self.stiffness_n_per_m / s
        return inner * casing + suspension * (inner + casing), inner + casing

    def _divisor(self, s: Complexes, parted: Complexes, both: Complexes) -> Complexes:
        electrical = self.resistance_ohm + s * self.inductance_h
        return parted * electrical + np.square(self.force_factor_n_per_a) * both
