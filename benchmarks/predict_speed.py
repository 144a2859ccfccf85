"""What ``ss.predict`` costs, as a ratio to ``scipy.signal.fftconvolve`` over all channels.

Both ways run in turn in one process, in float64; medians of the ratios of the rounds, as many of
them as take a few seconds.  A first call finds nothing remembered: it transforms the responses of
the limb.  The second one of a place that is used alone still does, and keeps them; later ones
remember.  The clock on the wall counts what other programs take of a busy machine, processor time
counts what a second thread did meanwhile: both are printed, and the better one is judged.

    python benchmarks/predict_speed.py [--rounds 15]
"""

import argparse
import sys
from time import perf_counter, process_time

import numpy as np
from scipy.signal import fftconvolve

import skinsource as ss
from skinsource.base.allocation import keep_freed_memory
from skinsource.engine import prediction

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


def timed(work, *arguments) -> tuple[np.ndarray, np.ndarray]:
    """Seconds that a call takes, on the wall and of processors, and its result."""
    start = np.array([perf_counter(), process_time()])
    result = work(*arguments)
    return np.array([perf_counter(), process_time()]) - start, result


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
            for k in range(options.rounds * 20 // n_inputs):
                # A busy machine takes the processor away after about the same time: in turn from
                # each of them.
                if k % 2 == 0:
                    plain_s, expected = timed(plain, limb, drives)
                prediction._cached_spectra.cache_clear()
                prediction._cached_gains.cache_clear()
                first_s, _ = timed(ss.predict, limb, drives, places, None, "upstream")
                ss.predict(limb, drives, places, None, "upstream")
                later_s, response = timed(ss.predict, limb, drives, places, None, "upstream")
                if k % 2:
                    plain_s, expected = timed(plain, limb, drives)
                np.testing.assert_allclose(response, expected, rtol=0, atol=1e-12)
                times.append((plain_s, first_s, later_s))
            plain_s, first_s, later_s = np.median(times, axis=0)[:, 0]
            print(f"{n_inputs:6}  {length_s:4.2f} s", end="")
            print("".join(f"{1e3 * time_s:10.1f}" for time_s in (plain_s, first_s, later_s)))
            spent = np.array(times)
            first, later = np.median(spent[:, :1] / spent[:, 1:], axis=0)
            broken += not verdict("first calls", first, PROMISED_FIRST)
            broken += not verdict("later calls", later, PROMISED_LATER[n_inputs])
    return int(broken > 0)


def verdict(label: str, times: np.ndarray, least: float) -> bool:
    """Print how many times quicker than the plain way, on the wall and of processors; if kept."""
    holds = times.max() >= least
    wall, processors = times
    print(
        f"{label:>16} {wall:.2f} times as quick, {processors:.2f} by processor time, promised "
        f"{least:g}: {'kept' if holds else 'BROKEN'}"
    )
    return holds


if __name__ == "__main__":
    sys.exit(main())
