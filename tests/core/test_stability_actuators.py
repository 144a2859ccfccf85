"""Motions of actuators against exponentials that mpmath computed with 60 digits and more."""

import json
from pathlib import Path

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators.simulation import OUTPUTS

REFERENCES = Path(__file__).parents[1] / "references"
KNOWN = json.loads((REFERENCES / "actuators.json").read_text(encoding="utf-8"))
CASES = KNOWN["cases"]
RATE_HZ = KNOWN["rate_hz"]
MODELS = {
    name: getattr(ss.actuators, case["kind"])(**{k: v for k, v in case.items() if k != "kind"})
    for what in ("cases", "stiff", "fast")
    for name, case in KNOWN[what].items()
} | {name: ss.actuators.load(name) for name in ss.actuators.names()}
with np.load(REFERENCES / "actuators.npz") as _stored:
    STORED = dict(_stored)


def error(motion, exact, at=slice(None)):
    """Largest error of any output over its peak."""
    errors = []
    for name, expected in zip(OUTPUTS, exact, strict=True):
        values = getattr(motion, name)
        peak = max(np.abs(values).max(), np.abs(expected).max(), 1e-300)
        errors.append(np.abs(values[at] - expected).max() / peak)
    return max(errors)


def most_of(coil, n_steps):
    """30 eps ‖A‖ T of a voice coil, its states scaled by the roots of L, m and k."""
    mass, inductance = coil.moving_mass_kg, coil.inductance_h
    coupled = coil.force_factor_n_per_a / np.sqrt(inductance * mass)
    swung = np.sqrt(coil.stiffness_n_per_m / mass)
    damped = coil.damping_n_s_per_m / mass
    size_hz = max(coil.resistance_ohm / inductance + coupled, coupled + damped + swung)
    return 30.0 * 2.0**-52 * size_hz * n_steps / RATE_HZ


def held_error(name, drive):
    """Error of a case under one of the drives at 1300 Hz."""
    voltage = np.ones(401) if drive == "step" else STORED["uneven"]
    hold = "first" if drive == "ramps" else "zero"
    return error(MODELS[name].simulate(voltage, RATE_HZ, hold), STORED[f"{name}/{drive}"])


def run_error(key):
    """Error of a run of the uneven voltage."""
    what, name, rate_hz = key.split("/")
    hold, n_steps, every = KNOWN["runs"][what]
    k = np.arange(n_steps + 1)
    voltage = ((7919 * k * k + 31 * k) % 2001 - 1000) / 1000.0
    motion = MODELS[name].simulate(voltage, float(rate_hz), hold)
    return error(motion, STORED[key], slice(None, None, every))


COILS = [name for name in CASES if name[0] == "d"]
SHORT = ["coil of 0.1 µs", "hardly any inductance"]
LIGHT = "mass of a microgram"
UNDAMPED = "d4 no damping"
DRIVES = pytest.mark.parametrize("drive", ["step", "uneven", "ramps"])


def runs(what):
    """All runs of a kind, as parameters of a test."""
    return pytest.mark.parametrize("key", [key for key in STORED if key.startswith(f"{what}/")])


@DRIVES
@pytest.mark.parametrize("name", COILS)
def test_a_coil_moves_exactly_as_the_held_voltage_says(noted, name, drive):
    noted("j coils", held_error(name, drive))


@DRIVES
@pytest.mark.parametrize("name", [name for name in CASES if name not in (*COILS, *SHORT, LIGHT)])
def test_other_kinds_move_exactly_as_the_held_voltage_says(noted, name, drive):
    noted("j kinds", held_error(name, drive))


@runs("shipped")
def test_shipped_actuators_move_exactly(noted, key):
    noted("j shipped", run_error(key))


@runs("rates")
def test_motions_are_exact_at_low_and_high_rates(noted, key):
    noted("j rates", run_error(key))


@DRIVES
@pytest.mark.parametrize("name", SHORT)
def test_a_coil_without_inertia_takes_no_digits(noted, name, drive):
    noted("j stiff", held_error(name, drive))


@runs("stiff")
def test_what_settles_at_once_takes_no_digits(noted, key):
    noted("j stiff", run_error(key))


@DRIVES
def test_a_light_mass_takes_the_digits_that_its_speed_costs(noted, drive):
    noted("j fast", held_error(LIGHT, drive) / most_of(MODELS[LIGHT], 120))


@runs("fast")
def test_what_swings_between_samples_takes_the_digits_that_its_speed_costs(noted, key):
    noted("j fast", run_error(key) / most_of(MODELS[key.split("/")[1]], 120))


@runs("minute")
def test_a_minute_is_exact(noted, key):
    error = run_error(key)
    if UNDAMPED in key:
        noted("j undamped", error)
    else:
        noted("j minute", error)


def million_error(name):
    """Error of a coil at samples up to a million."""
    motion = MODELS[name].simulate(np.ones(KNOWN["long"][-1] + 1), RATE_HZ)
    return error(motion, STORED[f"{name}/long"], KNOWN["long"])


@pytest.mark.parametrize("name", [name for name in COILS if name[:2] in ("d1", "d6")])
def test_a_million_steps_are_exact(noted, name):
    noted("j million", million_error(name))


def test_without_damping_the_phase_takes_its_digits(noted):
    noted("j undamped", million_error(UNDAMPED))
