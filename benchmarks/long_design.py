"""Twenty inputs of ten minutes: time, memory above idle, and how soon a computation can be stopped.

Tones, noise and taps at all places, with upstream's scaling, each part in a fresh process, which is
idle once everything is imported, the limb is open and a small design was computed.  Measured are
the levels and the map alone; the map with traces and spectra of two outputs in three axes;
and what the panels of the studio ask for, which is more.  Then the second is stopped at random
moments; and in one run to the end, the longest times between two questions whether to stop are
listed with where they were asked.  Promised, whatever the machine: at most so many times a fixed
number of transforms, in processor time, which does not count how long other programs keep it
waiting; 1.4 times what is played and remembered; and a fiftieth of the whole run.

    python benchmarks/long_design.py [--minutes 10] [--tries 20]
"""

import argparse
import json
import platform
import subprocess
import sys
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from time import perf_counter, process_time

import numpy as np
import scipy.fft
from resident import resident_mb

from skinsource.base.allocation import keep_freed_memory
from skinsource.base.errors import Stopped
from skinsource.design.design import Design, Input, View, track
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.graph import Graph
from skinsource.engine.quantities import new_graph, sources
from skinsource.limbs.catalog import default_limb

#: Processor time of the whole in times that of the transforms beside it; memory in times what is
#: played and what the engine may remember; the longest wait as a part of the whole: once 10 s,
#: 500 MB and 100 ms.
MOST_TRANSFORMS, MOST_TIMES_HELD, LONGEST_PART = 40.0, 1.4, 1 / 50
WHOLE_S = 10.0
REMEMBERED_MB = 256 * 2**20 / 1e6
MAP = ("output_levels_db", "surface_levels_db")
SHOWN = (*MAP, "axis_traces", "axis_spectra")
STUDIO = (*MAP, "selected_extremes", "response_time_s", "selected_spectra", "input_waveforms")
WANTED = {"map": MAP, "shown": SHOWN, "studio": STUDIO}
SEED = 20240607
LISTED = 5
VIEW = View(axes="xyz", method="mag", outputs=(29, 52), selected_inputs=(5,))


def long_design(duration_s: float) -> Design:
    """Sixteen inputs as long as the design, and taps all along it."""

    def sounding(k: int) -> Input:
        how = {"amplitude": 0.5 + 0.1 * k, "colour": k}
        if k % 5 == 4:
            return track(k + 1, Tap(), **how, onset_s=(k + 1) / 20 * duration_s - 0.1)
        if k % 2:
            return track(k + 1, Noise(seed=k, duration_s=duration_s), **how)
        return track(k + 1, Tone(frequency_hz=40.0 + 25.0 * k, duration_s=duration_s), **how)

    return Design(limb=default_limb(), inputs=tuple(map(sounding, range(20))), scaling="upstream")


def idle_graph() -> Graph:
    """A graph after a small evaluation, so that everything is imported and the limb is open."""
    keep_freed_memory()  # as the studio does at its start
    small = Design(limb=default_limb(), inputs=(track(location=1, waveform=Tone()),))
    graph = new_graph()
    graph.evaluate((*SHOWN, *STUDIO), sources(small, VIEW))
    return graph


def peak_mb() -> float:
    """Most memory that this process ever occupied, in MB."""
    # The standard library's figure may be that of the process that started this one.
    lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    return next(int(line.split()[1]) * 1024 / 1e6 for line in lines if line.startswith("VmHWM"))


def transforms_s() -> float:
    """Processor time of a thousand transforms of 65 536 samples: a fixed piece of work."""
    signals = np.random.default_rng(SEED).standard_normal((10, 2**16))
    scipy.fft.rfft(signals)
    begin = process_time()
    for _ in range(100):
        scipy.fft.rfft(signals)
    return process_time() - begin


def measure(quantities: tuple[str, ...], duration_s: float) -> dict[str, float]:
    """Seconds, and MB above idle at the peak and at the end, of one evaluation.

    ``processor_s`` is the time of all its threads together.
    """
    graph = idle_graph()
    design = long_design(duration_s)
    played = (round(track.clips[0].waveform.duration_s * 1300) for track in design.inputs)
    played_mb = 8 * sum(played) / 1e6
    before_s = transforms_s()
    idle_mb = resident_mb()
    begin, begin_processor_s = perf_counter(), process_time()
    result = graph.evaluate(quantities, sources(design, VIEW))
    processor_s, time_s = process_time() - begin_processor_s, perf_counter() - begin
    return {
        "time_s": time_s,
        "processor_s": processor_s,
        "transforms_s": (before_s + transforms_s()) / 2,
        "held_mb_at_least": played_mb + REMEMBERED_MB,
        "idle_mb": idle_mb,
        "peak_mb": peak_mb() - idle_mb,
        "held_mb": resident_mb() - idle_mb,
        "loudest_db": float(result["output_levels_db"].max()),
    }


@dataclass
class Questions:
    """Asks nothing to stop, and notes when and where it was asked."""

    asked: list[tuple[float, str]] = field(default_factory=list)

    def __call__(self) -> bool:
        """Note who asks; never stop."""
        now, frame = perf_counter(), sys._getframe(1)
        place = frame.f_code.co_name
        # The graph asks before it runs a rule; rules that take long ask themselves.
        while frame is not None and frame.f_code.co_name != "_refresh":
            frame = frame.f_back
        rule = frame.f_locals["name"] if frame is not None else "?"
        where = f"before {rule}" if place == "_refresh" else f"in {rule} ({place})"
        self.asked.append((now, where))
        return False


def longest_silences(duration_s: float) -> list[tuple[float, str]]:
    """The longest times between two questions, in ms, and where they were asked."""
    graph, questions = idle_graph(), Questions()
    begin = perf_counter()
    graph.evaluate(SHOWN, sources(long_design(duration_s), VIEW), questions)
    asked = [(begin, "start"), *questions.asked, (perf_counter(), "end")]
    gaps = [
        (1e3 * (after - before), f"{where} … {there}")
        for (before, where), (after, there) in pairwise(asked)
    ]
    return sorted(gaps, reverse=True)[:LISTED]


def stops(duration_s: float, whole_s: float, tries: int) -> list[tuple[float, float]]:
    """When each try was stopped, in s, and after how many ms it returned; 0 if it was done."""
    random = np.random.default_rng(SEED)
    given = sources(long_design(duration_s), VIEW)
    idle_graph()
    stops = []
    # One moment in each part of the run, so that all of it is tried.
    for share in (np.arange(tries) + random.uniform(0, 1, tries)) / tries:
        begin = perf_counter()
        moment = begin + float(share) * whole_s
        waited_ms = 0.0
        try:
            new_graph().evaluate(SHOWN, given, lambda moment=moment: perf_counter() >= moment)
        except Stopped:
            waited_ms = 1e3 * (perf_counter() - moment)
        stops.append((moment - begin, waited_ms))
    return stops


def in_a_fresh_process(*arguments: object) -> object:
    """What this program prints last with these arguments."""
    command = [sys.executable, __file__, "--part", *map(str, arguments)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)  # noqa: S603
    return json.loads(done.stdout.splitlines()[-1])


def row(label: str, value: float, unit: str, share: tuple[float, str, float]) -> bool:
    """Print one figure and its ratio to what is beside it; whether that is kept."""
    beside, name, most = share
    holds = value / beside <= most
    print(
        f"{label:>44} {value:8.1f} {unit:<2} {value / beside:7.3g} x {name} "
        f"(promised {most:g}) {'kept' if holds else 'BROKEN'}"
    )
    return holds


def part(options: argparse.Namespace) -> object:
    """What a fresh process measures."""
    duration_s = 60.0 * options.minutes
    if options.part == "silences":
        return longest_silences(duration_s)
    if options.part == "stops":
        return stops(duration_s, options.whole, options.tries)
    return measure(WANTED[options.part], duration_s)


def main() -> int:
    """Print the figures; 1 if a promise is broken."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--tries", type=int, default=20)
    parser.add_argument("--part", help=argparse.SUPPRESS)
    parser.add_argument("--whole", type=float, default=WHOLE_S, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.part:
        print(json.dumps(part(options)))
        return 0
    print(f"{platform.platform()}, Python {platform.python_version()}, numpy {np.__version__}")
    print(f"{default_limb()}, 20 inputs of {options.minutes:g} min; MB are 10⁶ bytes")
    common = "--minutes", options.minutes
    holds, whole_s = True, WHOLE_S
    for name, label in (
        ("map", "map"),
        ("studio", "all that the panels of the studio show"),
        ("shown", "map, traces and spectra of 2 outputs"),
    ):
        measured = in_a_fresh_process(name, *common)
        print(f"{label:>44} {measured['time_s']:8.1f} s")
        beside = measured["transforms_s"], "1000 transforms", MOST_TRANSFORMS
        holds &= row("of all processors together", measured["processor_s"], "s", beside)
        beside = measured["held_mb_at_least"], "played and remembered", MOST_TIMES_HELD
        holds &= row(f"above {measured['idle_mb']:.0f} MB idle", measured["peak_mb"], "MB", beside)
        print(f"{'held afterwards':>44} {measured['held_mb']:8.1f} MB")
        whole_s = measured["time_s"]
    tried = in_a_fresh_process("stops", *common, "--tries", options.tries, "--whole", whole_s)
    at_s, longest_ms = max(tried, key=lambda stop: stop[1])
    stopped = sum(waited_ms > 0 for _, waited_ms in tried)
    label = f"longest of {stopped} stops, at {at_s:.1f} of {whole_s:.1f} s"
    beside = 1e3 * whole_s, "the whole", LONGEST_PART
    holds &= row(label, longest_ms, "ms", beside)
    silences = in_a_fresh_process("silences", *common)
    # On a busy machine a single one may be anything.
    holds &= row("third longest time without a question", silences[2][0], "ms", beside)
    for gap_ms, where in silences:
        print(f"{gap_ms:53.1f} ms  {where}")
    return int(not holds)


if __name__ == "__main__":
    sys.exit(main())
