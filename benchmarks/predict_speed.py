"""What ``ss.predict`` costs, as a ratio to ``scipy.signal.fftconvolve`` over all channels.

Both ways run in turn in one process, in float64; medians of the ratios of the rounds.  The first
call transforms the responses of the limb, the later ones remember them.

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
#: Later calls with twenty inputs are so many times quicker than the plain way; others no slower.
PROMISED_OF_TWENTY = 3.0


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
    rounds = parser.parse_args().rounds
    keep_freed_memory()
    limb = ss.load_limb(ss.available_limbs()[0])
    limb.impulse_responses.sum()
    broken = 0
    print(f"{limb}\ninputs  length  plain ms  first ms  later ms  plain/first  plain/later")
    for n_inputs in (1, 20):
        for length_s in (0.25, 1.0):
            drives = np.random.default_rng(1).standard_normal((n_inputs, round(RATE_HZ * length_s)))
            places = range(1, n_inputs + 1)
            times = []
            for _ in range(rounds):
                plain_s, expected = timed(plain, limb, drives)
                response._remembered.cache_clear()
                response._known_gains.cache_clear()
                first_s, _ = timed(ss.predict, limb, drives, places)
                later_s, found = timed(ss.predict, limb, drives, places)
                np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)
                times.append((plain_s, first_s, later_s))
            of_first = statistics.median(row[0] / row[1] for row in times)
            of_later = statistics.median(row[0] / row[2] for row in times)
            promised = PROMISED_OF_TWENTY if n_inputs > 1 else 1.0
            kept = of_later >= promised
            broken += not kept
            milliseconds = "".join(
                f"{1e3 * statistics.median(k):10.1f}" for k in zip(*times, strict=True)
            )
            print(
                f"{n_inputs:6}  {length_s:4.2f} s{milliseconds}{of_first:12.2f}{of_later:13.2f}"
                f"   {'kept' if kept else f'BROKEN: {promised:g} promised'}"
            )
    return int(broken > 0)


if __name__ == "__main__":
    sys.exit(main())
