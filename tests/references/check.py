"""Stored references are exact, rounded once: computed with mpmath, in 40 digits and more.

Motions of actuators are their equations, put into one matrix with the held voltage and its slope
beside the states, whose exponential is taken.  Waveforms are their documented formulas, summed
harmonic by harmonic where they are series; formulas are what Python takes their texts for.  Of
natural neighbours the cell that a point takes is clipped out of the plane, and again by each site's
own cell, in rational arithmetic.  Nothing here knows the library.

    python tests/references/check.py
"""

import json
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import mpmath
import numpy as np
from mpmath import ceil, cos, exp, expm, floor, fsum, log, matrix, mp, mpf, pi, sin, sqrt

HERE = Path(__file__).parent
RATE_HZ = 1300
Point = tuple[Fraction, Fraction]
FAR = Fraction(10**9)


def rows_of(name):
    """Content of a JSON file beside this one."""
    return json.loads((HERE / f"{name}.json").read_text("utf-8"))


def shipped():
    """Parameters of the actuators of ``data/actuators`` that have a model, by name."""
    paths = sorted((HERE.parents[1] / "data" / "actuators").glob("*.json"))
    models = {path.stem: json.loads(path.read_text("utf-8"))["content"]["model"] for path in paths}
    return {name: model for name, model in models.items() if model["kind"] != "ResponseShape"}


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


def check_actuators():
    """``actuators.npz`` holds motions of the cases of ``actuators.json``."""
    known = rows_of("actuators")
    with np.load(HERE / "actuators.npz") as stored:
        n_step = stored[f"{next(iter(known['cases']))}/step"].shape[1]
        uneven = stored["uneven"]
        voltages = {"step": np.ones(n_step), "uneven": uneven, "ramps": uneven}
        for key in set(stored) - {"uneven"}:
            exact = exact_motion(key, known, voltages)
            np.testing.assert_array_equal(exact, stored[key], key)


def hann(time, duration):
    """Hann window over the duration."""
    return (1 - cos(2 * pi * time / duration)) / 2


def tukey(time, duration, share=0.25):
    """Tukey window over the duration, of which a share is taper."""
    taper, from_end = mpf(share) * duration / 2, min(time, duration - time)
    return (1 - cos(pi * from_end / taper)) / 2 if from_end < taper else mpf(1)


#: What names of formulas mean that mpmath and Python have not, or otherwise.
NAMES = {
    # A factor of 0 leaves out what has no root.
    "sqrt": lambda value: sqrt(max(value, 0)),
    "round": lambda value: floor(value + mpf(1) / 2),
    "mod": lambda value, divisor: value - divisor * floor(value / divisor),
    "clip": lambda value, low, high: max(mpf(low), min(mpf(high), value)),
}


def formula(text, time, duration):
    """What a formula means at a time, for a duration."""
    of_time = {
        "t": time,
        "duration": duration,
        "hann": lambda: hann(time, duration),
        "window": lambda: hann(time, duration),
        "tukey": lambda *share: tukey(time, duration, *share),
        "gauss": lambda at, width: exp(-(((time - mpf(at)) / mpf(width)) ** 2) / 2),
        "pulse": lambda at, length: int(at <= time < at + length),
        "step": lambda at: int(time >= at),
        "chirp": lambda *ends_hz: chirp(time, None, *ends_hz, duration),
    }
    # Numbers are the floats that a text of them means.
    return eval(text.replace("^", "**"), vars(mpmath) | NAMES | of_time)  # noqa: S307


def check_formulas():
    """``formulas.json`` holds some samples of each text."""
    mp.dps = 40
    for row in rows_of("formulas"):
        for k, value in zip(row["numbers"], row["values"], strict=True):
            time = mpf(k) / mpf(row["sample_rate_hz"]) - mpf(row["shift_s"])
            exact = formula(row["text"], time, mpf(row["duration_s"]))
            assert float(exact).hex() == value, (row["text"], k)


def convolved(drive: np.ndarray, response: np.ndarray) -> list[float]:
    """Sum of the products of the stored numbers, each sum rounded once."""
    left, right = ([mpf(float(value)) for value in row] for row in (drive, response))
    # Zeros add nothing, and take as long as the rest.
    nonzero = [k for k, value in enumerate(left) if value != 0]
    results = []
    for time in range(len(left) + len(right) - 1):
        first = max(0, time - len(right) + 1)
        products = (left[k] * right[time - k] for k in nonzero if first <= k <= time)
        results.append(float(mp.fsum(products)))
    return results


def level_db(amplitude: str, reference: str) -> str:
    """Level of an amplitude re a reference."""
    ratio = mpf(float.fromhex(amplitude)) / mpf(float.fromhex(reference))
    return float(20 * mp.log10(ratio)).hex()


def axis_and_gap(covariance: list[list[str]]) -> tuple[list[str], str]:
    """Main axis of a covariance, its largest part positive, and its gap to the second."""
    rows = [[float.fromhex(value) for value in row] for row in covariance]
    values, vectors = mp.eigsy(matrix(rows))
    s1, s2 = mp.sqrt(values[2]), mp.sqrt(values[1])
    axis = [vectors[i, 2] for i in range(3)]
    largest = max(axis, key=abs)
    return [float(value * mp.sign(largest)).hex() for value in axis], float((s1 - s2) / s1).hex()


def nearer_half(polygon: list[Point], keep: Point, other: Point) -> list[Point]:
    """The part of a convex polygon that is nearer to ``keep`` than to ``other``."""
    normal = (other[0] - keep[0], other[1] - keep[1])
    level = sum(normal[i] * (other[i] + keep[i]) for i in (0, 1)) / 2
    height = [normal[0] * x + normal[1] * y - level for x, y in polygon]
    kept = []
    for k, here in enumerate(polygon):
        after = (k + 1) % len(polygon)
        if height[k] <= 0:
            kept.append(here)
        if (height[k] < 0) != (height[after] < 0) and height[k] * height[after] != 0:
            share = height[k] / (height[k] - height[after])
            there = polygon[after]
            kept.append(tuple(here[i] + share * (there[i] - here[i]) for i in (0, 1)))
    return kept


def area(polygon: list[Point]) -> Fraction:
    """Area within a polygon that runs counterclockwise."""
    around = zip(polygon, polygon[1:] + polygon[:1], strict=True)
    return sum((p[0] * q[1] - q[0] * p[1] for p, q in around), Fraction(0)) / 2


def weights(sites: list[Point], point: Point) -> list[Fraction]:
    """Shares of the cell of ``point`` in the cells of ``sites``."""
    cell = [(-FAR, -FAR), (FAR, -FAR), (FAR, FAR), (-FAR, FAR)]
    for site in sites:
        cell = nearer_half(cell, point, site)
    areas = []
    for site in sites:
        part = cell
        for other in sites:
            if other != site and part:
                part = nearer_half(part, site, other)
        areas.append(area(part) if len(part) > 2 else Fraction(0))
    return [value / sum(areas) for value in areas]


def check_numbers():
    """Convolutions, levels, principal axes with their gaps, and weights of natural neighbours."""
    mp.dps = 50
    with np.load(HERE / "convolution.npz") as stored:
        drives, responses = stored["drives"], stored["responses"]
        fields = [[convolved(drive, row) for row in responses] for drive in drives]
        np.testing.assert_array_equal(fields, stored["fields"])
    for row in rows_of("levels"):
        assert level_db(row["amplitude"], row["reference"]) == row["level_db"], row
    for row in rows_of("axes"):
        assert axis_and_gap(row["covariance"]) == (row["axis"], row["gap"]), row
    for row in rows_of("natural_neighbours"):
        sites, points = (
            [tuple(map(Fraction, point)) for point in row[name]] for name in ("sites", "points")
        )
        exact = [[float(value) for value in weights(sites, point)] for point in points]
        assert exact == row["weights"], row


def turn(frequency_hz, time, phase_rad=0.0):
    """Phase of a tone, in rad."""
    return 2 * pi * mpf(frequency_hz) * time + mpf(phase_rad)


def harmonics(frequency_hz, rate_hz):
    """Numbers of the harmonics below half the rate."""
    return range(1, int(ceil(mpf(rate_hz) / 2 / mpf(frequency_hz))))


def chirp(time, rate_hz, start_hz, end_hz, duration_s, law="linear", phase_rad=0.0):
    """The integral of the frequency."""
    start, end, length = mpf(start_hz), mpf(end_hz), mpf(duration_s)
    if law == "linear":
        turns = start * time + (end - start) * time**2 / (2 * length)
    else:
        ratio = end / start
        turns = start * length * (ratio ** (time / length) - 1) / log(ratio)
    return sin(2 * pi * turns + mpf(phase_rad))


def damped_sine(time, rate_hz, frequency_hz, decay_s, duration_s, phase_rad=0.0):
    """A sine times its decay."""
    return exp(-time / mpf(decay_s)) * sin(turn(frequency_hz, time, phase_rad))


def square(time, rate_hz, frequency_hz, duty, duration_s, phase_rad=0.0):
    """High for the first ``duty`` of each turn."""
    high, angle = mpf(duty), turn(frequency_hz, time, phase_rad)
    return (2 * high - 1) + fsum(
        4 / (pi * h) * sin(pi * h * high) * cos(h * (angle - pi * high))
        for h in harmonics(frequency_hz, rate_hz)
    )


def saw(time, rate_hz, frequency_hz, duration_s, phase_rad=0.0):
    """2 u for -1/2 < u < 1/2."""
    angle = turn(frequency_hz, time, phase_rad)
    return fsum(
        (-1) ** (h + 1) * 2 / (pi * h) * sin(h * angle) for h in harmonics(frequency_hz, rate_hz)
    )


def triangle(time, rate_hz, frequency_hz, duration_s, phase_rad=0.0):
    """1 - 4 |u - 1/4| for -1/4 < u < 3/4."""
    angle = turn(frequency_hz, time, phase_rad)
    return fsum(
        (-1) ** ((h - 1) // 2) * 8 / (pi * h) ** 2 * sin(h * angle)
        for h in harmonics(frequency_hz, rate_hz)
        if h % 2
    )


def pulse_train(time, rate_hz, rate, pulse_s, duration_s, phase_rad=0.0):
    """1 for the first ``pulse_s`` of each turn, then 0."""
    high, angle = mpf(rate) * mpf(pulse_s), turn(rate, time, phase_rad)
    return high + fsum(
        2 / (pi * h) * sin(pi * h * high) * cos(h * (angle - pi * high))
        for h in harmonics(rate, rate_hz)
    )


def amplitude_modulated(
    time, rate_hz, carrier_hz, modulator_hz, depth, duration_s, phase_rad=0.0, modulator_rad=0.0
):
    """Carrier and two lines beside it."""
    swell = 1 + mpf(depth) * cos(turn(modulator_hz, time, modulator_rad))
    return swell / (1 + mpf(depth)) * sin(turn(carrier_hz, time, phase_rad))


def frequency_modulated(
    time, rate_hz, carrier_hz, modulator_hz, deviation, duration_s, phase_rad=0.0, modulator_rad=0.0
):
    """The frequency is carrier + deviation cos(2 pi modulator t + modulator phase)."""
    index = mpf(deviation) / mpf(modulator_hz)
    swing = sin(turn(modulator_hz, time, modulator_rad)) - sin(mpf(modulator_rad))
    return sin(turn(carrier_hz, time, phase_rad) + index * swing)


def gabor(time, frequency_hz, cycles=4.0, phase_rad=0.0):
    """A Gaussian times a tone."""
    sigma = mpf(cycles) / (2 * pi * mpf(frequency_hz))
    turn = 2 * pi * mpf(frequency_hz) * time
    return exp(-(time**2) / (2 * sigma**2)) * cos(turn + mpf(phase_rad))


def ricker(time, frequency_hz):
    """The Mexican hat."""
    a = (pi * mpf(frequency_hz) * time) ** 2
    return (1 - 2 * a) * exp(-a)


def morlet(time, frequency_hz, w0=6.0):
    """Real part of the admissible one, of peak 1."""
    u = time * 2 * pi * mpf(frequency_hz) / mpf(w0)
    correction = exp(-(mpf(w0) ** 2) / 2)
    return (cos(mpf(w0) * u) - correction) * exp(-(u**2) / 2) / (1 - correction)


def chirplet(time, frequency_hz, rate_hz_per_s, sigma_s):
    """A Gaussian times a tone that rises."""
    turns = mpf(frequency_hz) * time + mpf(rate_hz_per_s) * time**2 / 2
    return exp(-(time**2) / (2 * mpf(sigma_s) ** 2)) * cos(2 * pi * turns)


def centred_tap(time, width_s):
    """Two cosines within the width."""
    turn = 2 * pi * time / mpf(width_s)
    return (cos(turn) + cos(2 * turn)) / 2 if abs(time) <= mpf(width_s) / 2 else mpf(0)


def tap(time):
    """Hanning's window at 1300 Hz, between its samples."""
    return (1 - cos(2 * pi * (1300 * time + 1) / 22)) / 2 if time < mpf(21) / 1300 else mpf(0)


def reach(family, cycles, frequency_hz):
    """Half the length of a wavelet of a train."""
    periods = {"gabor": 2 * mpf(cycles) / pi, "ricker": mpf(3) / 2, "hann": mpf(cycles) / 2}
    return periods[family] / mpf(frequency_hz)


def before(frequencies_hz, cycles, slot_s, family):
    """How far a train reaches before its first slot."""
    reaches = (reach(family, cycles, value) for value in frequencies_hz)
    return max(0, *(value - (j + mpf(1) / 2) * mpf(slot_s) for j, value in enumerate(reaches)))


def train(
    time, frequencies_hz, cycles=4.0, slot_s=0.12, family="gabor", equalise="none", gains_db=()
):
    """The sum of its wavelets."""
    early = before(frequencies_hz, cycles, slot_s, family)
    total = mpf(0)
    for j, frequency_hz in enumerate(frequencies_hz):
        since = time - early - (j + mpf(1) / 2) * mpf(slot_s)
        # Both ends belong to a wavelet, however the length of the train is rounded.
        if abs(since) > reach(family, cycles, frequency_hz) * (1 + mpf("1e-9")):
            continue
        gain = mpf(10) ** (mpf(gains_db[j]) / 20) if gains_db else mpf(1)
        if equalise == "energy":
            gain *= sqrt(mpf(frequency_hz) / mpf(max(frequencies_hz)))
        if family == "gabor":
            total += gain * gabor(since, frequency_hz, cycles)
        elif family == "ricker":
            total += gain * ricker(since, frequency_hz)
        else:
            turn = 2 * pi * mpf(frequency_hz) * since
            total += gain * (1 + cos(turn / mpf(cycles))) / 2 * sin(turn)
    return total


def glide(time, points):
    """Amplitude times the sine of the integral of the frequency, stretch by stretch."""
    turns, points = mpf(0), ((0.0, *points[0][1:]), *points)
    for before, after in pairwise(points):
        (start, low, soft), (end, high, loud) = (
            tuple(map(mpf, value)) for value in (before, after)
        )
        if time < end:
            since, length = time - start, end - start
            turns += low * since + (high - low) * since**2 / (2 * length)
            return (soft + (loud - soft) * since / length) * sin(2 * pi * turns)
        turns += (low + high) / 2 * (end - start)
    return mpf(0)


#: Formula of each periodic kind.
PERIODIC = {
    "Chirp": chirp,
    "DampedSine": damped_sine,
    "Square": square,
    "Saw": saw,
    "Triangle": triangle,
    "PulseTrain": pulse_train,
    "AmplitudeModulated": amplitude_modulated,
    "FrequencyModulated": frequency_modulated,
}
#: Formula of each wavelet, and of a glide.
WAVELETS = {
    "Gabor": gabor,
    "Ricker": ricker,
    "Morlet": morlet,
    "Chirplet": chirplet,
    "CentredTap": centred_tap,
    "Tap": tap,
    "WaveletTrain": train,
    "Glide": glide,
}
#: Their times are from the middle of all samples.
CENTRED = ("Gabor", "Ricker", "Morlet", "Chirplet", "CentredTap")


def value(k, n, kind, fields, rate_hz, shift_s):
    """Sample ``k`` of a waveform of ``n`` samples, a shift apart."""
    time = mpf(k) / mpf(rate_hz) - mpf(shift_s)
    if time < 0:
        return mpf(0)
    if kind in PERIODIC:
        return PERIODIC[kind](time, rate_hz, *fields)
    middle = mpf(n - 1) / (2 * mpf(rate_hz)) if kind in CENTRED else 0
    return WAVELETS[kind](time - middle, *fields)


def check_waveforms():
    """Their files hold cases: a kind, its fields by position, a rate, a shift, and some samples."""
    for name, mp.dps in (("periodic_waveforms", 40), ("wavelets", 50)):
        with np.load(HERE / f"{name}.npz") as stored:
            for number, case in enumerate(json.loads(str(stored["cases"]))):
                places = stored[f"places_{number}"].tolist()
                # The last one is stored; a shift makes one sample more.
                n = places[-1] + (0 if case["shift_s"] else 1)
                exact = [float(value(k, n, **case)) for k in places]
                np.testing.assert_array_equal(exact, stored[f"values_{number}"], str(case))


if __name__ == "__main__":
    for check in (check_formulas, check_numbers, check_waveforms, check_actuators):
        check()
