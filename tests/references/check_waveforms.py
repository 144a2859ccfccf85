"""Stored samples of waveforms are those of their formulas to 40 or 50 digits, rounded.

``periodic_waveforms.npz`` and ``wavelets.npz`` hold cases, read by their tests: a kind, its fields
by position, a rate and a shift, and some instants with their values.  Each formula is the
documented one in mpmath, summed harmonic by harmonic where it is a series.  Nothing here knows the
library.

    python tests/references/check_waveforms.py
"""

import json
from itertools import pairwise
from pathlib import Path

import numpy as np
from mpmath import ceil, cos, exp, fsum, log, mp, mpf, pi, sin, sqrt


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


def main() -> None:
    """Compare all stored values."""
    for name, mp.dps in (("periodic_waveforms", 40), ("wavelets", 50)):
        with np.load(Path(__file__).with_name(f"{name}.npz")) as stored:
            for number, case in enumerate(json.loads(str(stored["cases"]))):
                places = stored[f"places_{number}"].tolist()
                # The last one is stored; a shift makes one sample more.
                n = places[-1] + (0 if case["shift_s"] else 1)
                exact = [float(value(k, n, **case)) for k in places]
                np.testing.assert_array_equal(exact, stored[f"values_{number}"], str(case))


if __name__ == "__main__":
    main()
