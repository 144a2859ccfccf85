"""Wavelets and glides to 50 digits, rounded once: ``wavelets.npz``, read by their tests.

Each is its documented formula in mpmath at some instants of its samples.  Nothing here knows the
library.

    python tests/references/make_wavelets.py
"""

import json
from itertools import pairwise
from pathlib import Path

import numpy as np
from mpmath import cos, exp, floor, mp, mpf, pi, sin, sqrt

#: Instants of each case: so many anywhere, and so many at each end.
N_ANYWHERE, N_ENDS = 380, 10
TRAIN = (50.0, 84.1, 141.4, 237.8, 400.0)
GLIDE = ((0.0, 60.0, 0.0), (0.1, 60.0, 1.0), (0.4, 240.0, 1.0), (0.5, 240.0, 0.0))


def gabor_length(frequency_hz, cycles=4.0, phase_rad=0.0):
    """8 sigma."""
    return 8 * mpf(cycles) / (2 * pi * mpf(frequency_hz))


def gabor(time, frequency_hz, cycles=4.0, phase_rad=0.0):
    """A Gaussian times a tone."""
    sigma = mpf(cycles) / (2 * pi * mpf(frequency_hz))
    turn = 2 * pi * mpf(frequency_hz) * time
    return exp(-(time**2) / (2 * sigma**2)) * cos(turn + mpf(phase_rad))


def ricker_length(frequency_hz):
    """3 periods."""
    return 3 / mpf(frequency_hz)


def ricker(time, frequency_hz):
    """The Mexican hat."""
    a = (pi * mpf(frequency_hz) * time) ** 2
    return (1 - 2 * a) * exp(-a)


def morlet_length(frequency_hz, w0=6.0):
    """10 standard deviations."""
    return 10 * mpf(w0) / (2 * pi * mpf(frequency_hz))


def morlet(time, frequency_hz, w0=6.0):
    """Real part of the admissible one, of peak 1."""
    u = time * 2 * pi * mpf(frequency_hz) / mpf(w0)
    correction = exp(-(mpf(w0) ** 2) / 2)
    return (cos(mpf(w0) * u) - correction) * exp(-(u**2) / 2) / (1 - correction)


def chirplet_length(frequency_hz, rate_hz_per_s, sigma_s):
    """8 sigma."""
    return 8 * mpf(sigma_s)


def chirplet(time, frequency_hz, rate_hz_per_s, sigma_s):
    """A Gaussian times a tone that rises."""
    turns = mpf(frequency_hz) * time + mpf(rate_hz_per_s) * time**2 / 2
    return exp(-(time**2) / (2 * mpf(sigma_s) ** 2)) * cos(2 * pi * turns)


def centred_tap_length(width_s):
    """The width."""
    return mpf(width_s)


def centred_tap(time, width_s):
    """Two cosines within the width."""
    turn = 2 * pi * time / mpf(width_s)
    return (cos(turn) + cos(2 * turn)) / 2 if abs(time) <= mpf(width_s) / 2 else mpf(0)


def tap_length():
    """21 samples at 1300 Hz."""
    return mpf(21) / 1300


def tap(time):
    """Hanning's window at 1300 Hz, between its samples."""
    return (1 - cos(2 * pi * (1300 * time + 1) / 22)) / 2 if time < tap_length() else mpf(0)


def reach(family, cycles, frequency_hz):
    """Half the length of a wavelet of a train."""
    periods = {"gabor": 2 * mpf(cycles) / pi, "ricker": mpf(3) / 2, "hann": mpf(cycles) / 2}
    return periods[family] / mpf(frequency_hz)


def beyond(frequencies_hz, cycles, slot_s, family):
    """How far a train reaches before its first slot and after its last one."""
    slot, count = mpf(slot_s), len(frequencies_hz)
    reaches = [reach(family, cycles, value) for value in frequencies_hz]
    early = max(value - (j + mpf(1) / 2) * slot for j, value in enumerate(reaches))
    late = max(value - (count - j - mpf(1) / 2) * slot for j, value in enumerate(reaches))
    return max(early, 0), max(late, 0)


def train_length(
    frequencies_hz, cycles=4.0, slot_s=0.12, family="gabor", equalise="none", gains_db=()
):
    """All slots, and what lies beyond."""
    return len(frequencies_hz) * mpf(slot_s) + sum(beyond(frequencies_hz, cycles, slot_s, family))


def train(
    time, frequencies_hz, cycles=4.0, slot_s=0.12, family="gabor", equalise="none", gains_db=()
):
    """The sum of its wavelets."""
    early, _ = beyond(frequencies_hz, cycles, slot_s, family)
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


def glide_length(points):
    """Time of the last point."""
    return mpf(points[-1][0])


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


#: Formula, length, whether times are from the middle of all samples.
FORMULAS = {
    "Gabor": (gabor, gabor_length, True),
    "Ricker": (ricker, ricker_length, True),
    "Morlet": (morlet, morlet_length, True),
    "Chirplet": (chirplet, chirplet_length, True),
    "CentredTap": (centred_tap, centred_tap_length, True),
    "Tap": (tap, tap_length, False),
    "WaveletTrain": (train, train_length, False),
    "Glide": (glide, glide_length, False),
}
WIGGLE = tuple((0.02 * k, 100.0 + 90.0 * (-1) ** k, 1.0 - 0.01 * k) for k in range(80))
#: Kind, its fields by position, sample rate in Hz, shift in samples.
CASES = (
    ("Gabor", (250.0,), 1300.0, 0.0),
    ("Gabor", (250.0,), 1300.0, 0.37),
    ("Gabor", (25.0, 0.5, 1.0), 1300.0, 0.0),
    ("Gabor", (600.0, 0.5, -1.0), 1300.0, 0.9),
    ("Gabor", (249.9, 10_000.0, 0.3), 1300.0, 0.61),
    ("Gabor", (649.9, 40.0), 1300.0, 0.0),
    ("Gabor", (100.0, 4.0), 48000.0, 0.25),
    ("Gabor", (0.1, 4.0), 1300.0, 0.0),
    ("Ricker", (100.0,), 1300.0, 0.0),
    ("Ricker", (100.0,), 1300.0, 0.5),
    ("Ricker", (0.1,), 1300.0, 0.25),
    ("Ricker", (600.0,), 48000.0, 0.1),
    ("Ricker", (649.9,), 1300.0, 0.0),
    ("Morlet", (100.0,), 1300.0, 0.0),
    ("Morlet", (250.0, 1.0), 1300.0, 0.37),
    ("Morlet", (249.9, 1000.0), 1300.0, 0.5),
    ("Morlet", (60.0, 5.0), 48000.0, 0.8),
    ("Morlet", (0.1, 6.0), 1300.0, 0.0),
    ("Chirplet", (150.0, 1500.0, 0.03), 1300.0, 0.0),
    ("Chirplet", (150.0, -3000.0, 0.03), 1300.0, 0.41),
    ("Chirplet", (300.0, 2.5, 60.0), 1300.0, 0.77),
    ("Chirplet", (20_000.0, 900_000.0, 0.002), 48000.0, 0.2),
    ("Chirplet", (250.0, 0.0, 0.001), 1300.0, 0.0),
    ("CentredTap", (0.02,), 1300.0, 0.0),
    ("CentredTap", (0.0123,), 1300.0, 0.63),
    ("CentredTap", (0.004,), 48000.0, 0.5),
    ("CentredTap", (10.0,), 1300.0, 0.1),
    ("Tap", (), 1300.0, 0.0),
    ("Tap", (), 1300.0, 0.5),
    ("Tap", (), 48000.0, 0.3),
    ("WaveletTrain", (TRAIN,), 1300.0, 0.0),
    ("WaveletTrain", (TRAIN, 4.0, 0.12, "gabor", "energy"), 1300.0, 0.43),
    ("WaveletTrain", (TRAIN, 6.0, 0.05, "hann", "none", (0.0, -3.0, 6.0, 1.5, -20.0)), 1300.0, 0.1),
    ("WaveletTrain", (TRAIN, 4.0, 0.013, "ricker", "energy"), 1300.0, 0.0),
    ("WaveletTrain", (TRAIN, 7.0, 0.02, "gabor"), 48000.0, 0.7),
    ("WaveletTrain", ((300.0, 249.9), 1000.0, 60.0, "gabor"), 1300.0, 0.2),
    ("Glide", (GLIDE,), 1300.0, 0.0),
    ("Glide", (GLIDE,), 48000.0, 0.57),
    ("Glide", (WIGGLE,), 1300.0, 0.33),
    ("Glide", (((0.0, 649.9, 1.0), (600.0, 0.0, 0.1)),), 1300.0, 0.33),
    (
        "Glide",
        (((0.3, 250.1, 0.5), (0.5, 250.1, 1.0), (0.5, 80.3, 0.2), (60.0, 81.7, 1.0)),),
        1300.0,
        0.0,
    ),
)


def some_instants(n: int, seed: int) -> list[int]:
    """Numbers of samples, by a linear congruential generator, and those at both ends."""
    state, result = seed, {k % n for k in range(-N_ENDS, N_ENDS)}
    for _ in range(N_ANYWHERE):
        state = (6364136223846793005 * state + 1442695040888963407) % 2**64
        result.add((state >> 11) * n >> 53)
    return sorted(result)


def main() -> None:
    """Write the file."""
    mp.dps = 50
    cases, stored = [], {}
    for number, (kind, fields, rate_hz, part) in enumerate(CASES):
        formula, length, centred = FORMULAS[kind]
        shift_s = part / rate_hz
        n = int(floor(length(*fields) * mpf(rate_hz) + mpf(1) / 2))
        places = some_instants(n + (part > 0), number + 1)
        values = []
        for k in places:
            time = mpf(k) / mpf(rate_hz) - mpf(shift_s)
            begun = time >= 0
            if centred:
                time -= mpf(n - 1) / (2 * mpf(rate_hz))
            values.append(float(formula(time, *fields)) if begun else 0.0)
        cases.append({"kind": kind, "fields": fields, "rate_hz": rate_hz, "shift_s": shift_s})
        stored[f"places_{number}"] = np.array(places, np.int32)
        stored[f"values_{number}"] = np.array(values)
    path = Path(__file__).with_name("wavelets.npz")
    np.savez_compressed(path, cases=np.array(json.dumps(cases)), **stored)


if __name__ == "__main__":
    main()
