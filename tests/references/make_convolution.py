"""Convolutions to 50 digits, rounded once: ``convolution.npz``, read by the tests of stability.

Drives and responses are stored beside the results, so that no other machine has to make the same
sines.  Every result is the sum of its products in mpmath, not a transform.

    python tests/references/make_convolution.py
"""

from pathlib import Path

import numpy as np
from mpmath import mp, mpf

RATE_HZ = 1300
N_TAPS, N_TIMES = 522, 1300
#: The second burst lies so far below the first, in dB.
QUIETER_DB = 120


def noise(n: int, seed: int) -> list[mpf]:
    """Uniform numbers between -1 and 1 of a linear congruential generator."""
    state, numbers = seed, []
    for _ in range(n):
        state = (6364136223846793005 * state + 1442695040888963407) % 2**64
        numbers.append(mpf(state >> 11) / 2**52 - 1)
    return numbers


def tone(n: int, frequency_hz: int) -> list[mpf]:
    """A sine with Hanning's window."""
    return [
        mp.sin(2 * mp.pi * frequency_hz * k / RATE_HZ) * mp.sin(mp.pi * (k + 1) / (n + 1)) ** 2
        for k in range(n)
    ]


def bursts() -> list[mpf]:
    """A burst of noise and, when nothing is left of its response, one that is much quieter."""
    burst = noise(130, 3)
    quieter = mpf(10) ** (-mpf(QUIETER_DB) / 20)
    samples = [mpf(0)] * N_TIMES
    samples[:130] = burst
    samples[900:1030] = [quieter * value for value in noise(130, 5)]
    return samples


def ringing(modes: tuple[tuple[int, int, str], ...]) -> list[mpf]:
    """Decaying sines: (frequency in Hz, decay per s, amplitude) each."""
    return [
        sum(
            mpf(amplitude) * mp.exp(-mpf(decay) * k / RATE_HZ) * mp.sin(2 * mp.pi * f * k / RATE_HZ)
            for f, decay, amplitude in modes
        )
        for k in range(N_TAPS)
    ]


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


def main() -> None:
    """Write the file."""
    mp.dps = 50
    drives = np.array(
        [
            [float(value) for value in row]
            for row in (tone(N_TIMES, 100), noise(N_TIMES, 1), bursts())
        ]
    )
    modes = (((60, 30, "1"), (180, 55, "0.7"), (410, 140, "1.3")), ((95, 18, "0.02"),))
    responses = np.array([[float(value) for value in ringing(some)] for some in modes])
    fields = np.array([[convolved(drive, row) for row in responses] for drive in drives])
    np.savez(
        Path(__file__).with_name("convolution.npz"),
        drives=drives,
        responses=responses,
        fields=fields,
    )


if __name__ == "__main__":
    main()
