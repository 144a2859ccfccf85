"""What a sweep of 400 stimuli costs, as a ratio to ``scipy.signal.fftconvolve`` over all channels.

Four inputs of 1 s each; all waveforms new in every stimulus, or one input varying.  The plain way
convolves each drive with its 216 responses and adds them up: it has then no metric yet, the sweep
has all of them.  Both run in turn, some stimuli at a time, in one process by one thread; medians of
the ratios of processor times, which other programs on the computer change little.  Then two
processes against one, from the first stimulus that each has measured on.

    python benchmarks/sweeps.py [--stimuli 400]
"""

import argparse
import statistics
import sys
from time import perf_counter, process_time

import numpy as np
from scipy.signal import fftconvolve

import skinsource as ss
from skinsource.base.allocation import keep_freed_memory
from skinsource.studies.sweeps.measuring import Measurer
from skinsource.studies.sweeps.plan import BATCH_SIZE, Plan
from skinsource.studies.sweeps.workers import measured

RATE_HZ = 1300
PLACES = (3, 7, 12, 18)
PROMISED = {"all new": 2.5, "one varies": 5.0, "two processes": 1.7}
_AT_A_TIME = 2 * BATCH_SIZE
_WARM = 2 * BATCH_SIZE


def plan_of(which: str, count: int) -> Plan:
    """As many stimuli, of which the waveforms of all inputs differ, or those of the second."""
    name = "frequency_hz" if which == "all new" else "2.frequency_hz"
    inputs = tuple(
        ss.track(place, ss.waveforms.Tone(frequency_hz=60.0 + 20.0 * k, duration_s=1.0))
        for k, place in enumerate(PLACES)
    )
    design = ss.Design(limb="synthetic-1", inputs=inputs)
    values = tuple(np.linspace(40.0, 500.0, count).tolist())
    return Plan(designs=(("four", design),), variables=((name, values),))


def plain(limb: ss.Limb, drives: np.ndarray) -> np.ndarray:
    """Convolve each drive with its responses, and sum."""
    total = 0.0
    for place, drive in zip(PLACES, drives, strict=True):
        total = total + fftconvolve(limb.response_to(place), drive[None, None], axes=-1)
    return total


def ratio_to_plain(which: str, count: int) -> tuple[float, float, float]:
    """Milliseconds of a stimulus the plain way and by the sweep, and the median of the ratios."""
    limb = ss.load_limb("synthetic-1")
    drives = np.random.default_rng(1).standard_normal((len(PLACES), RATE_HZ))
    plain(limb, drives)
    measurer = Measurer(plan_of(which, count + BATCH_SIZE))
    numbers = range(1, BATCH_SIZE + count + 1)
    for number in numbers[:BATCH_SIZE]:
        measurer.measure(number)
    times = []
    for first in range(BATCH_SIZE, len(numbers), _AT_A_TIME):
        these = numbers[first : first + _AT_A_TIME]
        start = process_time()
        for number in these:
            measurer.measure(number)
        between = process_time()
        for _ in these:
            plain(limb, drives)
        times.append(((process_time() - between) / len(these), (between - start) / len(these)))
    ratio = statistics.median(slow / quick for slow, quick in times)
    slow, quick = (1e3 * statistics.median(column) for column in zip(*times, strict=True))
    return slow, quick, ratio


def seconds_after_start(plan: Plan, processes: int) -> float:
    """How long the stimuli after the first few take, in as many processes."""
    start = 0.0
    numbers = range(1, len(plan) + 1)
    for n_measured, _ in enumerate(measured(plan, numbers, processes), start=1):
        if n_measured == _WARM * processes:
            start = perf_counter()
    return (perf_counter() - start) / (len(plan) - _WARM * processes)


def main() -> int:
    """Print a table; 1 where a promise is broken."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--stimuli", type=int, default=400)
    count = parser.parse_args().stimuli
    keep_freed_memory()
    ratios = {}
    print("stimuli       plain ms  sweep ms  ratio  promised")
    for which in ("all new", "one varies"):
        slow, quick, ratios[which] = ratio_to_plain(which, count)
        print(f"{which:12}  {slow:8.1f}  {quick:8.2f}  {ratios[which]:5.1f}  {PROMISED[which]:8g}")
    plan = plan_of("all new", max(count, 200))
    single_s, two = (seconds_after_start(plan, processes) for processes in (1, 2))
    ratios["two processes"] = single_s / two
    print(f"two processes: {single_s / two:.2f} times one (promised {PROMISED['two processes']:g})")
    return int(any(ratios[name] < promised for name, promised in PROMISED.items()))


if __name__ == "__main__":
    sys.exit(main())
