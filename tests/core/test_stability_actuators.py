"""Motions of actuators against exponentials that mpmath computed with 60 digits and more."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators.simulation import OUTPUTS
from skinsource.base.errors import InvalidInputError
from skinsource.specs.models import specs_of

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


#: An actuator of each kind, with parameters of ordinary ones.
COIL = ss.actuators.VoiceCoil(8.0, 8e-4, 0.8, 1e-3, 0.07, 1209.0)
RECOIL = ss.actuators.RecoilVoiceCoil(4.0, 5e-4, 1.5, 4e-3, 0.5, 1280.0, 1.1e-2, 700.0, 1.0)
PIEZO = ss.actuators.Piezo(1e-7, 1e-2, 1e-3, 0.1, 2000.0)
PARAMETERS = [(kind, name) for kind in (COIL, RECOIL, PIEZO) for name in specs_of(kind)]


@pytest.mark.parametrize(
    ("voltage", "rate_hz", "hold", "word"),
    [
        ([0.0, np.nan], 1300.0, "zero", "voltage"),
        ([[0.0]], 1300.0, "zero", "voltage"),
        ([1j], 1300.0, "zero", "voltage"),
        ([0.0], 0.0, "zero", "sample_rate_hz"),
        ([0.0], np.inf, "zero", "sample_rate_hz"),
        ([0.0], 1300.0, "second", "hold"),
        ([1e308] * 90, 1300.0, "zero", "voltage"),
    ],
)
def test_what_cannot_be_simulated_is_refused(voltage, rate_hz, hold, word):
    with pytest.raises(InvalidInputError, match=word):
        COIL.simulate(voltage, rate_hz, hold)


@pytest.mark.parametrize("value", [5e-324, 1e-150, 1e150, 1.7e308])
@pytest.mark.parametrize(("actuator", "name"), PARAMETERS)
def test_a_parameter_at_the_end_of_all_numbers_moves_it_or_is_refused(actuator, name, value):
    extreme = replace(actuator, **{name: value})
    for act in (
        lambda: extreme.simulate(np.sin(np.arange(70.0)), 1300.0).acceleration,
        lambda: extreme.response(100.0),
        lambda: extreme.admittance(100.0),
        lambda: ss.equalising.resonance_of(extreme),
    ):
        try:
            result = act()
        except InvalidInputError:
            continue
        assert np.isfinite(result).all()


@pytest.mark.parametrize("actuator", [COIL, RECOIL, PIEZO])
def test_a_long_tone_moves_it_as_its_response_says(actuator):
    rate_hz, n = 96_000.0, 4 * 96_000
    turn = np.exp(2j * np.pi * 150.0 * np.arange(n) / rate_hz)
    motion = actuator.simulate(turn.real, rate_hz, "first")
    last = slice(n - 9600, n)
    shown = 2.0 * np.mean(motion.acceleration[last] * turn[last].conj())
    assert shown == pytest.approx(actuator.response(150.0), rel=1e-4)
    flowing = 2.0 * np.mean(motion.current[last] * turn[last].conj())
    assert flowing == pytest.approx(actuator.admittance(150.0), rel=1e-3)


def test_a_recoiling_casing_keeps_the_momentum_where_it_hangs_free():
    free = ss.actuators.RecoilVoiceCoil(4.0, 5e-4, 1.5, 4e-3, 0.5, 1280.0, 1.1e-2)
    fixed = ss.actuators.VoiceCoil(4.0, 5e-4, 1.5, 4e-3 * 1.1e-2 / 1.5e-2, 0.5, 1280.0)
    frequency_hz = np.array([20.0, 90.0, 600.0])
    # Both masses swing about their common centre, as one reduced mass does about a wall.
    share = -4e-3 / 1.5e-2
    assert free.response(frequency_hz) == pytest.approx(share * fixed.response(frequency_hz))


def test_a_response_is_zero_where_nothing_oscillates_and_mirrored_below():
    for actuator in (COIL, RECOIL, PIEZO, ss.actuators.VoiceCoil(8.0, 8e-4, 0.0, 1e-3, 0.0, 0.0)):
        assert actuator.response(0.0) == 0.0
        assert actuator.response([[-50.0, 50.0]]).shape == (1, 2)
        assert actuator.response(-50.0) == actuator.response(50.0).conjugate()
