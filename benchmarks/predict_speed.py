"""What ``ss.predict`` costs, as a ratio to ``scipy.signal.fftconvolve`` over all channels.

Both ways run in turn in one process, in float64; medians of the ratios of the rounds, as many of
them as take a few seconds.  A first call finds nothing remembered: it transforms the responses of
the limb.  The second one of a place that is used alone still does, and keeps them; later ones
remember.

    python benchmarks/predict_speed.py [--rounds 15]
"""

import argparse
import statistics
import sys
from time import perf_counter

import numpy as np
from scipy.signal import fftconvolve

import skinsource as ss
from skinsource import response
from skinsource.allocation import keep_freed_memory

RATE_HZ = 1300
#: First calls are no slower than the plain way; later ones with twenty inputs so many times
#: quicker, with one no slower.
PROMISED_FIRST, PROMISED_LATER = 1.0, {1: 1.0, 20: 3.0}


def plain(limb: ss.Limb, drives: np.ndarray) -> np.ndarray:
    """Convolve each drive with its 216 responses, divide by the maximum, sum."""
    total = 0.0
    for place, drive in enumerate(drives, start=1):
        caused = fftconvolve(limb.response_to(place), drive[None, None], axes=-1)
        total = total + caused / caused.max()
    return total


def timed(work, *arguments) -> tuple[float, np.ndarray]:
    """Seconds that a call takes, and its result."""
    start = perf_counter()
    result = work(*arguments)
    return perf_counter() - start, result


def main() -> int:
    """Print a table; 1 where a promise is broken."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=15)
    options = parser.parse_args()
    keep_freed_memory()
    limb = ss.load_limb(ss.available_limbs()[0])
    limb.impulse_responses.sum()
    broken = 0
    print(f"{limb}\ninputs  length  plain ms  first ms  later ms")
    for n_inputs in (1, 20):
        for length_s in (0.25, 1.0):
            drives = np.random.default_rng(1).standard_normal((n_inputs, round(RATE_HZ * length_s)))
            places = range(1, n_inputs + 1)
            times = []
            # One input takes a twentieth of the time.
            for _ in range(options.rounds * 20 // n_inputs):
                plain_s, expected = timed(plain, limb, drives)
                response._remembered.cache_clear()
                response._known_gains.cache_clear()
                first_s, _ = timed(ss.predict, limb, drives, places)
                ss.predict(limb, drives, places)
                later_s, found = timed(ss.predict, limb, drives, places)
                np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)
                times.append((plain_s, first_s, later_s))
            milliseconds = "".join(
                f"{1e3 * statistics.median(k):10.1f}" for k in zip(*times, strict=True)
            )
            print(f"{n_inputs:6}  {length_s:4.2f} s{milliseconds}")
            first = statistics.median(row[0] / row[1] for row in times)
            later = statistics.median(row[0] / row[2] for row in times)
            broken += not verdict("first calls", first, PROMISED_FIRST)
            broken += not verdict("later calls", later, PROMISED_LATER[n_inputs])
    return int(broken > 0)


def verdict(words: str, times: float, least: float) -> bool:
    """Print how many times quicker than the plain way; whether that is kept."""
    kept = times >= least
    word = "kept" if kept else "BROKEN"
    print(f"{words:>16} {times:.2f} times as quick, promised {least:g}: {word}")
    return kept


if __name__ == "__main__":
    sys.exit(main())
