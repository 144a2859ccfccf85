"""Models of actuators with linear equations: voice coils and piezoelectric actuators."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from skinsource.actuators import actuator
from skinsource.actuators.actuator import LinearActuator
from skinsource.actuators.simulation import Equations
from skinsource.base.conventions import Complexes
from skinsource.specs import fields


@dataclass(frozen=True, slots=True)
class VoiceCoil(fields.CheckedModel, LinearActuator):
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

    resistance_ohm: float = fields.field(actuator.RESISTANCE)
    inductance_h: float = fields.field(actuator.INDUCTANCE)
    force_factor_n_per_a: float = fields.field(actuator.FORCE_FACTOR)
    moving_mass_kg: float = fields.field(actuator.MOVING_MASS)
    damping_n_s_per_m: float = fields.field(actuator.DAMPING)
    stiffness_n_per_m: float = fields.field(actuator.STIFFNESS)
    skin_stiffness_n_per_m: float = fields.number(0.0, actuator.SKIN_STIFFNESS)
    skin_damping_n_s_per_m: float = fields.number(0.0, actuator.SKIN_DAMPING)

    def equations(self) -> Equations:
        """Return the equations of the states current, velocity and displacement."""
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
        """Return A / U = s Bl / (Z (R + s L) + Bl²) with the impedance Z = m s + c + k / s."""
        return s * self.force_factor_n_per_a / self._divisor(s)

    def current_at(self, s: Complexes) -> Complexes:
        """Return Z / (Z (R + s L) + Bl²)."""
        return _impedance(self, s) / self._divisor(s)

    def _divisor(self, s: Complexes) -> Complexes:
        electrical = self.resistance_ohm + s * self.inductance_h
        return _impedance(self, s) * electrical + np.square(self.force_factor_n_per_a)


CASING_MASS = actuator.positive("Casing mass", "kg", "Mass that touches the skin and recoils")


@dataclass(frozen=True, slots=True)
class RecoilVoiceCoil(fields.CheckedModel, LinearActuator):
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

    resistance_ohm: float = fields.field(actuator.RESISTANCE)
    inductance_h: float = fields.field(actuator.INDUCTANCE)
    force_factor_n_per_a: float = fields.field(actuator.FORCE_FACTOR)
    moving_mass_kg: float = fields.field(actuator.MOVING_MASS)
    damping_n_s_per_m: float = fields.field(actuator.DAMPING)
    stiffness_n_per_m: float = fields.field(actuator.STIFFNESS)
    casing_mass_kg: float = fields.field(CASING_MASS)
    skin_stiffness_n_per_m: float = fields.number(0.0, actuator.SKIN_STIFFNESS)
    skin_damping_n_s_per_m: float = fields.number(0.0, actuator.SKIN_DAMPING)

    def equations(self) -> Equations:
        """Return the equations of the current and of motions between and of both masses."""
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
        """Return -s² m Bl / (P (R + s L) + Bl² S) with P and S of `_joined`."""
        parted, both = self._joined(s)
        driven = -self.force_factor_n_per_a * self.moving_mass_kg * s**2
        return driven / self._divisor(s, parted, both)

    def current_at(self, s: Complexes) -> Complexes:
        """Return P / (P (R + s L) + Bl² S) with P and S of `_joined`."""
        parted, both = self._joined(s)
        return parted / self._divisor(s, parted, both)

    def _joined(self, s: Complexes) -> tuple[Complexes, Complexes]:
        """Return P, the impedance between the masses times S, and S, that of both together."""
        inner = self.moving_mass_kg * s
        casing = self.casing_mass_kg * s
        casing = casing + self.skin_damping_n_s_per_m + self.skin_stiffness_n_per_m / s
        suspension = self.damping_n_s_per_m + self.stiffness_n_per_m / s
        return inner * casing + suspension * (inner + casing), inner + casing

    def _divisor(self, s: Complexes, parted: Complexes, both: Complexes) -> Complexes:
        electrical = self.resistance_ohm + s * self.inductance_h
        return parted * electrical + np.square(self.force_factor_n_per_a) * both


CAPACITANCE = actuator.positive("Capacitance", "F", "Of the clamped actuator")
COUPLING = actuator.not_negative("Coupling", "N/V", "Force per volt, and amperes per m/s")
SERIES = actuator.positive("Series resistance", "Ω", "Of amplifier and leads")


@dataclass(frozen=True, slots=True)
class Piezo(fields.CheckedModel, LinearActuator):
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
    moving_mass_kg: float = fields.field(actuator.MOVING_MASS)
    damping_n_s_per_m: float = fields.field(actuator.DAMPING)
    stiffness_n_per_m: float = fields.field(actuator.STIFFNESS)
    series_resistance_ohm: float = fields.number(100.0, SERIES)
    skin_stiffness_n_per_m: float = fields.number(0.0, actuator.SKIN_STIFFNESS)
    skin_damping_n_s_per_m: float = fields.number(0.0, actuator.SKIN_DAMPING)

    def equations(self) -> Equations:
        """Return the equations of the states capacitor voltage, velocity and displacement."""
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
        """Return A / U = s alpha / (Z (1 + s R C) + R alpha²) with Z = m s + c + k / s."""
        return s * self.coupling_n_per_v / self._divisor(s)

    def current_at(self, s: Complexes) -> Complexes:
        """Return (s C Z + alpha²) / (Z (1 + s R C) + R alpha²)."""
        flowing = s * self.capacitance_f * _impedance(self, s) + np.square(self.coupling_n_per_v)
        return flowing / self._divisor(s)

    def _divisor(self, s: Complexes) -> Complexes:
        charged = 1.0 + s * self.series_resistance_ohm * self.capacitance_f
        moved = self.series_resistance_ohm * np.square(self.coupling_n_per_v)
        return _impedance(self, s) * charged + moved


def _impedance(moved: VoiceCoil | Piezo, s: Complexes) -> Complexes:
    damping = moved.damping_n_s_per_m + moved.skin_damping_n_s_per_m
    stiffness = moved.stiffness_n_per_m + moved.skin_stiffness_n_per_m
    return moved.moving_mass_kg * s + damping + stiffness / s
