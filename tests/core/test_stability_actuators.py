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


HELD = {
    "j coils": COILS,
    "j kinds": [name for name in CASES if name not in (*COILS, *SHORT, LIGHT)],
    "j stiff": SHORT,
    "j fast": [LIGHT],
}
RUNS = {"shipped": "j shipped", "rates": "j rates", "stiff": "j stiff", "fast": "j fast"}


@pytest.mark.parametrize("drive", ["step", "uneven", "ramps"])
@pytest.mark.parametrize(
    ("case", "name"), [(case, name) for case, names in HELD.items() for name in names]
)
def test_each_moves_exactly_as_the_held_voltage_says(noted, case, name, drive):
    # What is very light or quick takes the digits that its speed costs.
    most = most_of(MODELS[name], 120) if case == "j fast" else 1.0
    noted(case, held_error(name, drive) / most)


@pytest.mark.parametrize("key", [key for key in STORED if key.split("/")[0] in (*RUNS, "minute")])
def test_runs_at_other_rates_and_of_a_minute_are_exact(noted, key):
    kind, name, _ = key.split("/")
    most = most_of(MODELS[name], 120) if kind == "fast" else 1.0
    noted(RUNS.get(kind, "j undamped" if UNDAMPED in key else "j minute"), run_error(key) / most)


@pytest.mark.parametrize("name", [name for name in COILS if name[:2] in ("d1", "d4", "d6")])
def test_a_million_steps_are_exact(noted, name):
    motion = MODELS[name].simulate(np.ones(KNOWN["long"][-1] + 1), RATE_HZ)
    # Without damping the phase takes its digits.
    case = "j undamped" if name == UNDAMPED else "j million"
    noted(case, error(motion, STORED[f"{name}/long"], KNOWN["long"]))
