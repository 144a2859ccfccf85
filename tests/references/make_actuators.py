"""Motion of actuators to 50 digits, rounded once: ``actuators.npz``, read by their tests.

Each is its equations of motion, put into one matrix with the held voltage and its slope beside the
states, whose exponential mpmath computes.  Nothing here knows the library.

    python tests/references/make_actuators.py
"""

import json
from pathlib import Path

import numpy as np
from mpmath import expm, matrix, mp, mpf, pi, sqrt

HERE = Path(__file__).parent
SHIPPED = HERE.parents[1] / "data" / "actuators"
RATE_HZ = 1300
N_STEP, N_UNEVEN = 400, 120
#: Of runs of an uneven voltage: how it is held, how many steps, and every how many are kept.
RUNS = {
    "shipped": ("first", 960, 8),
    "rates": ("first", 120, 1),
    "stiff": ("first", 120, 1),
    "fast": ("first", 120, 1),
    "minute": ("zero", 60 * RATE_HZ, 997),
}
#: Samples of the long run whose motion is kept.
LONG = (1000, 10_000, 100_000, 300_000, 1_000_000)


def coil(frequency_hz, quality, tau_s, force_factor, mass=1e-3, resistance=8.0, damping=None):
    """Parameters of a voice coil whose undriven mass has this resonance, in doubles."""
    stiffness = float((2 * pi * mpf(frequency_hz)) ** 2 * mpf(mass))
    if damping is None:
        damping = float(sqrt(mpf(stiffness) * mpf(mass)) / mpf(quality))
    return {
        "kind": "VoiceCoil",
        "resistance_ohm": resistance,
        "inductance_h": float(mpf(resistance) * mpf(tau_s)),
        "force_factor_n_per_a": force_factor,
        "moving_mass_kg": mass,
        "damping_n_s_per_m": damping,
        "stiffness_n_per_m": stiffness,
    }


def triple_root():
    """Coil and mass alike: 1 / tau and twice the resonance, nearly uncoupled."""
    frequency_hz = 175.0
    tau_s = float(1 / (2 * pi * mpf(frequency_hz)))
    return coil(frequency_hz, 0.5, tau_s, 1e-9)


CASES = {
    "d1 linear resonant actuator": coil(175.0, 15.0, 1e-4, 0.8),
    "d2 voice coil": coil(60.0, 2.0, 1.5e-4, 1.9, mass=1e-2, resistance=4.0),
    "d3 quality of 10 000": coil(175.0, 1e4, 1e-4, 1e-3),
    "d4 no damping": coil(175.0, 1.0, 1e-4, 1e-6, damping=0.0),
    "d5 coil of 1 µs on 5 Hz": coil(5.0, 0.5, 1e-6, 0.8),
    "d6 just below half the rate": coil(640.0, 50.0, 1e-4, 0.8),
    "d7 double root": coil(175.0, 0.5, 1e-4, 1e-6),
    "d8 triple root": triple_root(),
    "coil of 0.1 µs": coil(175.0, 15.0, 1e-7, 0.8),
    "mass of a microgram": coil(175.0, 15.0, 1e-4, 0.8, mass=1e-9),
    "no stiffness": coil(175.0, 15.0, 1e-4, 0.8) | {"stiffness_n_per_m": 0.0},
    "neither stiffness nor damping": coil(175.0, 15.0, 1e-4, 0.8, damping=0.0)
    | {"stiffness_n_per_m": 0.0},
    "hardly any stiffness": coil(175.0, 15.0, 1e-4, 0.8) | {"stiffness_n_per_m": 1e-150},
    "hardly any inductance": coil(175.0, 15.0, 1e-120, 0.8),
    "hardly any force": coil(175.0, 15.0, 1e-4, 1e-120),
    "no force": coil(175.0, 15.0, 1e-4, 0.0),
    "on the skin": coil(60.0, 2.0, 1.5e-4, 1.9, mass=1e-2)
    | {"skin_stiffness_n_per_m": 800.0, "skin_damping_n_s_per_m": 1.0},
    "recoil": coil(90.0, 4.0, 1.2e-4, 1.5, mass=4e-3)
    | {
        "kind": "RecoilVoiceCoil",
        "casing_mass_kg": 1.1e-2,
        "skin_stiffness_n_per_m": 700.0,
        "skin_damping_n_s_per_m": 1.0,
    },
    "recoil, hanging free": coil(90.0, 4.0, 1.2e-4, 1.5, mass=4e-3)
    | {"kind": "RecoilVoiceCoil", "casing_mass_kg": 1.1e-2},
    "piezo": {
        "kind": "Piezo",
        "capacitance_f": 1e-7,
        "coupling_n_per_v": 1e-2,
        "moving_mass_kg": 1e-3,
        "damping_n_s_per_m": 0.1,
        "stiffness_n_per_m": 2000.0,
        "series_resistance_ohm": 150.0,
        "skin_stiffness_n_per_m": 500.0,
        "skin_damping_n_s_per_m": 0.8,
    },
}


#: Where the current, the charge or the mass settles long before the next sample.
STIFF = {
    "piezo of 1 pF behind 1 mΩ": {
        "kind": "Piezo",
        "capacitance_f": 1e-12,
        "coupling_n_per_v": 1e-2,
        "moving_mass_kg": 1e-3,
        "damping_n_s_per_m": 0.1,
        "stiffness_n_per_m": 2000.0,
        "series_resistance_ohm": 1e-3,
    },
    "recoil with a coil of 1 ps": CASES["recoil"] | {"inductance_h": 8e-12},
    "mass of a picogram": coil(175.0, 15.0, 1e-4, 0.8, mass=1e-15)
    | {"damping_n_s_per_m": 0.07, "stiffness_n_per_m": 1209.0},
}
#: Where the mass swings many times between two samples.
FAST = {
    "mass of a microgram": CASES["mass of a microgram"],
    "strong force": coil(0.0, 1.0, 1.0, 1e4, resistance=1e-6, damping=0.0),
    "stiff spring": coil(175.0, 15.0, 1e-4, 0.8) | {"stiffness_n_per_m": 1e9},
}


def shipped():
    """Parameters of the actuators of ``data/actuators`` that have a model, by name."""
    result = {}
    for path in sorted(SHIPPED.glob("*.json")):
        model = json.loads(path.read_text(encoding="utf-8"))["content"]["model"]
        if model["kind"] != "ResponseShape":
            result[path.stem] = model
    return result


def runs():
    """Runs of an uneven voltage: what for, case, and rate."""
    coils = [name for name in CASES if name[0] == "d"]
    held = [*coils, "recoil", "recoil, hanging free", "piezo"]
    return [
        *(("shipped", name, rate_hz) for name in shipped() for rate_hz in (1300, 8000, 48_000)),
        *(("rates", name, rate_hz) for name in held for rate_hz in (200, 192_000)),
        *(("stiff", name, RATE_HZ) for name in STIFF),
        *(("fast", name, RATE_HZ) for name in FAST),
        *(("minute", name, RATE_HZ) for name in [*held, *shipped()]),
    ]


def equations(case):
    """A, b, and what gives acceleration, velocity, displacement and current; states and voltage."""
    p = {name: mpf(value) for name, value in case.items() if name != "kind"}
    zero, one = mpf(0), mpf(1)
    m, c, k = p["moving_mass_kg"], p["damping_n_s_per_m"], p["stiffness_n_per_m"]
    ks = p.get("skin_stiffness_n_per_m", zero)
    cs = p.get("skin_damping_n_s_per_m", zero)
    if case["kind"] == "Piezo":
        cap, alpha, r = p["capacitance_f"], p["coupling_n_per_v"], p["series_resistance_ohm"]
        rows = [
            [-1 / (r * cap), -alpha / cap, zero, 1 / (r * cap)],
            [alpha / m, -(c + cs) / m, -(k + ks) / m, zero],
            [zero, one, zero, zero],
        ]
        return rows, [rows[1], rows[2], [zero, zero, one, zero], [-1 / r, zero, zero, 1 / r]]
    r, ind, bl = p["resistance_ohm"], p["inductance_h"], p["force_factor_n_per_a"]
    if case["kind"] == "VoiceCoil":
        rows = [
            [-r / ind, -bl / ind, zero, 1 / ind],
            [bl / m, -(c + cs) / m, -(k + ks) / m, zero],
            [zero, one, zero, zero],
        ]
        return rows, [rows[1], rows[2], [zero, zero, one, zero], [one, zero, zero, zero]]
    # Current, velocity and place of the mass inside, velocity and place of the casing.
    big = p["casing_mass_kg"]
    force = [bl, -c, -k, c, k, zero]
    rows = [
        [-r / ind, -bl / ind, zero, bl / ind, zero, 1 / ind],
        [part / m for part in force],
        [zero, one, zero, zero, zero, zero],
        [(s - f) / big for f, s in zip(force, [zero, zero, zero, -cs, -ks, zero], strict=True)],
        [zero, zero, zero, one, zero, zero],
    ]
    reads = [rows[3], rows[4], [zero] * 4 + [one, zero], [one] + [zero] * 5]
    return rows, reads


def stepped(rows, step_s):
    """Exponential for one step, with voltage and slope beside the states."""
    n = len(rows)
    grown = matrix(n + 2, n + 2)
    for k in range(n):
        for j in range(n + 1):
            grown[k, j] = rows[k][j] * step_s
    grown[n, n + 1] = step_s
    return expm(grown)


def motion(case, voltage, hold, rate_hz=RATE_HZ, every=1):
    """Outputs, (4, n_kept), at every so many samples of a voltage."""
    rows, reads = equations(case)
    n, step_s = len(rows), 1 / mpf(rate_hz)
    grown = stepped(rows, step_s)
    state, result = [mpf(0)] * n, []
    for k, now in enumerate(voltage):
        known = [*state, mpf(now)]
        if k % every == 0:
            result.append([sum(a * b for a, b in zip(read, known, strict=True)) for read in reads])
        if k + 1 < len(voltage):
            slope = (mpf(voltage[k + 1]) - mpf(now)) / step_s if hold == "first" else mpf(0)
            known = [*known, slope]
            state = [sum(grown[j, i] * known[i] for i in range(n + 2)) for j in range(n)]
    return np.array([[float(value) for value in line] for line in result]).T


def long_motion(case):
    """Outputs, (4, len(LONG)), so many samples after 1 V came on, each by one exponential."""
    rows, reads = equations(case)
    n, result = len(rows), []
    for samples in LONG:
        grown = stepped(rows, mpf(samples) / RATE_HZ)
        known = [*(grown[j, n] for j in range(n)), mpf(1)]
        result.append([sum(a * b for a, b in zip(read, known, strict=True)) for read in reads])
    return np.array([[float(value) for value in line] for line in result]).T


def uneven():
    """A voltage that steps and wanders, in doubles."""
    k = np.arange(N_UNEVEN + 1)
    return np.round(np.sin(0.37 * k * k) + (k > 40) - 1.5 * (k > 80), 6)


def thousandths(n_steps):
    """Another uneven voltage, of any length: thousandths of a volt, the same on every machine."""
    k = np.arange(n_steps + 1)
    return ((7919 * k * k + 31 * k) % 2001 - 1000) / 1000.0


def main():
    """Write all cases."""
    mp.dps = 50
    result = {"uneven": uneven()}
    for name, case in CASES.items():
        # Parts far apart need more digits than 50 to end with 50.
        mp.dps = 400 if name.startswith("hardly") else 120 if "microgram" in name else 60
        result[f"{name}/step"] = motion(case, np.ones(N_STEP + 1), "zero")
        result[f"{name}/uneven"] = motion(case, uneven(), "zero")
        result[f"{name}/ramps"] = motion(case, uneven(), "first")
    for name in ("d1", "d4", "d6"):
        full = next(case for case in CASES if case.startswith(name))
        result[f"{full}/long"] = long_motion(CASES[full])
    cases = CASES | STIFF | FAST | shipped()
    for what, name, rate_hz in runs():
        mp.dps = 120 if what in ("stiff", "fast") else 60
        hold, n_steps, every = RUNS[what]
        voltage = thousandths(n_steps)
        result[f"{what}/{name}/{rate_hz}"] = motion(cases[name], voltage, hold, rate_hz, every)
    np.savez_compressed(HERE / "actuators.npz", **result)
    known = {"rate_hz": RATE_HZ, "long": LONG, "runs": RUNS}
    known |= {"cases": CASES, "stiff": STIFF, "fast": FAST}
    (HERE / "actuators.json").write_text(json.dumps(known, indent=1) + "\n")


if __name__ == "__main__":
    main()
