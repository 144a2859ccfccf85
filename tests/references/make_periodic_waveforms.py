"""Periodic waveforms to 40 digits, rounded once: ``periodic_waveforms.npz``, read by their tests.

Each is its documented formula in mpmath, summed harmonic by harmonic where it is a series, at some
instants of its samples.  Nothing here knows the library.

    python tests/references/make_periodic_waveforms.py
"""

import json
from pathlib import Path

import numpy as np
from mpmath import ceil, cos, exp, fsum, log, mp, mpf, pi, sin

#: Instants of each case: so many anywhere, and so many at each end.
N_ANYWHERE, N_ENDS = 200, 10


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


FORMULAS = {
    "Chirp": chirp,
    "DampedSine": damped_sine,
    "Square": square,
    "Saw": saw,
    "Triangle": triangle,
    "PulseTrain": pulse_train,
    "AmplitudeModulated": amplitude_modulated,
    "FrequencyModulated": frequency_modulated,
}
#: Kind, its fields by position, sample rate in Hz, shift in samples.
CASES = (
    ("Chirp", (25.0, 600.0, 1.0, "linear", 0.0), 1300.0, 0.0),
    ("Chirp", (25.0, 600.0, 60.0, "linear", 0.7), 1300.0, 0.37),
    ("Chirp", (25.0, 600.0, 600.0, "linear", 0.0), 1300.0, 0.0),
    ("Chirp", (25.0, 600.0, 600.0, "linear", -2.0), 48000.0, 0.81),
    ("Chirp", (649.9, 0.01, 600.0, "linear", 0.0), 1300.0, 0.0),
    ("Chirp", (25.0, 600.0, 1.0, "logarithmic", 0.0), 1300.0, 0.0),
    ("Chirp", (25.0, 600.0, 600.0, "logarithmic", 0.7), 1300.0, 0.37),
    ("Chirp", (600.0, 25.0, 600.0, "logarithmic", 0.0), 48000.0, 0.0),
    ("Chirp", (250.1, 250.1000000001, 600.0, "logarithmic", 0.0), 1300.0, 0.5),
    ("Chirp", (250.1, 250.1, 600.0, "linear", 1.0), 1300.0, 0.0),
    ("DampedSine", (100.0, 0.03, 0.2, 0.0), 1300.0, 0.0),
    ("DampedSine", (249.7, 0.005, 0.2, 1.2), 48000.0, 0.42),
    ("DampedSine", (649.9, 60.0, 600.0, 0.0), 1300.0, 0.0),
    ("Square", (90.7, 0.5, 1.0, 0.0), 1300.0, 0.0),
    ("Square", (250.3, 0.25, 1.0, 0.4), 48000.0, 0.61),
    ("Square", (560.7, 0.5, 60.0, 0.0), 1300.0, 0.25),
    ("Square", (25.0, 0.01, 60.0, 0.0), 48000.0, 0.0),
    ("Saw", (90.7, 1.0, 0.0), 1300.0, 0.0),
    ("Saw", (400.9, 1.0, -3.0), 48000.0, 0.15),
    ("Saw", (25.0, 60.0, 0.0), 48000.0, 0.0),
    ("Triangle", (90.7, 1.0, 0.0), 1300.0, 0.0),
    ("Triangle", (50.0, 1.0, 1.5), 48000.0, 0.9),
    ("PulseTrain", (40.0, 0.004, 1.0, 0.0), 1300.0, 0.0),
    ("PulseTrain", (560.7, 0.0001, 1.0, 0.2), 48000.0, 0.33),
    ("PulseTrain", (30.3, 0.0329, 60.0, 0.0), 8000.0, 0.0),
    ("AmplitudeModulated", (200.0, 20.0, 1.0, 0.2, 0.0, 0.0), 1300.0, 0.0),
    ("AmplitudeModulated", (249.9, 31.3, 0.6, 600.0, 0.3, 3.1), 1300.0, 0.72),
    ("FrequencyModulated", (200.0, 20.0, 50.0, 0.2, 0.0, 0.0), 1300.0, 0.0),
    ("FrequencyModulated", (249.9, 0.7, 300.0, 600.0, 0.3, 3.1), 1300.0, 0.72),
)


def some_instants(n: int, seed: int) -> list[int]:
    """Numbers of samples, by a linear congruential generator, and those at both ends."""
    state, result = seed, set(range(N_ENDS)) | set(range(n - N_ENDS, n))
    for _ in range(N_ANYWHERE):
        state = (6364136223846793005 * state + 1442695040888963407) % 2**64
        result.add((state >> 11) * n >> 53)
    return sorted(result)


def main() -> None:
    """Write the file."""
    mp.dps = 40
    cases, stored = [], {}
    for number, (kind, fields, rate_hz, part) in enumerate(CASES):
        lengths = {"Chirp": 2, "Square": 2, "Saw": 1, "Triangle": 1, "DampedSine": 2}
        duration_s = fields[lengths.get(kind, 2 if kind == "PulseTrain" else 3)]
        shift_s = part / rate_hz
        places = some_instants(round(duration_s * rate_hz) + (part > 0), number + 1)
        values = []
        for k in places:
            time = mpf(k) / mpf(rate_hz) - mpf(shift_s)
            values.append(float(FORMULAS[kind](time, rate_hz, *fields)) if time >= 0 else 0.0)
        cases.append({"kind": kind, "fields": fields, "rate_hz": rate_hz, "shift_s": shift_s})
        stored[f"places_{number}"] = np.array(places, np.int32)
        stored[f"values_{number}"] = np.array(values)
    path = Path(__file__).with_name("periodic_waveforms.npz")
    np.savez_compressed(path, cases=np.array(json.dumps(cases)), **stored)


if __name__ == "__main__":
    main()
