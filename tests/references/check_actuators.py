"""Stored motion of actuators is that of their equations to 50 digits, rounded once.

``actuators.json`` holds the cases, and ``actuators.npz`` their motion, read by their tests.  Each
is its equations of motion, put into one matrix with the held voltage and its slope beside the
states, whose exponential mpmath computes.  Nothing here knows the library.

    python tests/references/check_actuators.py
"""

import json
from pathlib import Path

import numpy as np
from mpmath import expm, matrix, mp, mpf

HERE = Path(__file__).parent
SHIPPED = HERE.parents[1] / "data" / "actuators"
RATE_HZ = 1300


def shipped():
    """Parameters of the actuators of ``data/actuators`` that have a model, by name."""
    result = {}
    for path in sorted(SHIPPED.glob("*.json")):
        model = json.loads(path.read_text(encoding="utf-8"))["content"]["model"]
        if model["kind"] != "ResponseShape":
            result[path.stem] = model
    return result


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


def long_motion(case, counts):
    """Outputs, (4, n_counts), so many samples after 1 V came on, each by one exponential."""
    rows, reads = equations(case)
    n, result = len(rows), []
    for samples in counts:
        grown = stepped(rows, mpf(samples) / RATE_HZ)
        known = [*(grown[j, n] for j in range(n)), mpf(1)]
        result.append([sum(a * b for a, b in zip(read, known, strict=True)) for read in reads])
    return np.array([[float(value) for value in line] for line in result]).T


def thousandths(n_steps):
    """Another uneven voltage, of any length: thousandths of a volt, the same on every machine."""
    k = np.arange(n_steps + 1)
    return ((7919 * k * k + 31 * k) % 2001 - 1000) / 1000.0


def exact_motion(key, known, voltages):
    """What is stored under a key: of a case and how its voltage is held, or of a run."""
    first, name, *rest = key.split("/")
    if rest:
        # Parts far apart need more digits than 50 to end with 50.
        mp.dps = 120 if first in ("stiff", "fast") else 60
        cases = known["cases"] | known["stiff"] | known["fast"] | shipped()
        hold, n_steps, every = known["runs"][first]
        return motion(cases[name], thousandths(n_steps), hold, int(rest[0]), every)
    mp.dps = 400 if first.startswith("hardly") else 120 if "microgram" in first else 60
    case = known["cases"][first]
    if name == "long":
        return long_motion(case, known["long"])
    return motion(case, voltages[name], "first" if name == "ramps" else "zero")


def main():
    """Compare all stored motions."""
    known = json.loads((HERE / "actuators.json").read_text(encoding="utf-8"))
    with np.load(HERE / "actuators.npz") as stored:
        n_step = stored[f"{next(iter(known['cases']))}/step"].shape[1]
        uneven = stored["uneven"]
        voltages = {"step": np.ones(n_step), "uneven": uneven, "ramps": uneven}
        for key in set(stored) - {"uneven"}:
            exact = exact_motion(key, known, voltages)
            np.testing.assert_array_equal(exact, stored[key], key)


if __name__ == "__main__":
    main()
