"""How the cost of an edit grows with length, inputs and outputs, beside what the machine allows.

After each edit the engine gives the levels of all 72 outputs, and traces and spectra of the
selected outputs in three axes, in float64.  Three edits:

- everything: a graph that remembers nothing; only the limb's responses are at hand;
- one waveform: another frequency of the selected input;
- one amplitude: of the selected input.

Beside each time stands the least that this machine needs for the least work: bytes that must be
read, at its best bandwidth, and transforms that must be done, at their best rate, both measured in
the same run; `growth_limit.py` says what is counted.

    python benchmarks/growth.py [--longest 600] [--folder build/growth]

Writes ``growth.csv``, ``growth.svg`` and ``growth.png``; the plot needs matplotlib.
"""

import argparse
import platform
import statistics
import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from time import perf_counter

import numpy as np
import scipy
from growth_limit import Machine, least_work, this_machine
from growth_plot import EDITS, Point, write

from skinsource.base.allocation import keep_freed_memory
from skinsource.design.design import Design, Input, View, track
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.graph import Graph
from skinsource.engine.quantities import new_graph, sources
from skinsource.limbs.catalog import default_limb, load_limb
from skinsource.limbs.limb import Limb

WANTED = frozenset({"output_rms", "axis_traces", "axis_spectra"})
LENGTHS_S = (0.1, 0.3, 1.0, 2.0, 4.0, 5.0, 10.0, 30.0, 100.0, 300.0, 600.0)
N_INPUTS = (1, 2, 5, 10, 20)
N_SHOWN = (1, 2, 6, 18, 36, 72)
#: What is held where something else grows.
LENGTH_S, INPUTS, SHOWN = 1.0, 20, 6
#: Runs per point: as many as fit the time, but at least the first, at most the second number.
BUDGET_S, FEWEST, MOST = 0.8, 3, 40
SELECTED = 0


def some_inputs(count: int, length_s: float) -> tuple[Input, ...]:
    """Tones, noise and taps; the first, which is edited, is a tone."""

    def waveform(k: int) -> Tone | Noise | Tap:
        if k % 4 == 3:
            return Tap()
        if k % 4 == 1:
            return Noise(seed=k, duration_s=length_s)
        return Tone(frequency_hz=40.0 + 25.0 * k, duration_s=length_s)

    return tuple(
        track(location=k + 1, waveform=waveform(k), amplitude=0.5 + 0.1 * k, colour=k)
        for k in range(count)
    )


def edited(design: Design, edit: str, k: int) -> Design:
    """The design after the k-th edit."""
    if edit == "one waveform":
        [clip] = design.inputs[SELECTED].clips
        waveform = replace(clip.waveform, frequency_hz=100.0 + k)
        return design.with_clip(clip.id, waveform=waveform)
    if edit == "one amplitude":
        return design.with_input(SELECTED, amplitude=1.0 + 0.01 * k)
    return design


def times_of(limb: Limb, edit: str, design: Design, view: View) -> list[float]:
    """Seconds of each run of an edit."""
    graph, times = new_graph(), []
    if edit != "everything":
        evaluate(graph, limb, design, view)
    for k in range(MOST):
        after = edited(design, edit, k + 1)
        if edit == "everything":
            graph = new_graph()
        begin = perf_counter()
        evaluate(graph, limb, after, view)
        times.append(perf_counter() - begin)
        if sum(times) > BUDGET_S and (len(times) >= FEWEST or times[0] > 5 * BUDGET_S):
            break
    return times


def evaluate(graph: Graph, limb: Limb, design: Design, view: View) -> None:
    """Compute what the window shows."""
    graph.evaluate(WANTED, {**sources(design, view), "limb_data": limb})


def measured(limb: Limb, grows: str, length_s: float, inputs: int, outputs: int) -> Iterator[Point]:
    """Yield one point of each edit."""
    design = Design(limb=limb.name, inputs=some_inputs(inputs, length_s), scaling="upstream")
    view = View(
        axes="xyz",
        method="mag",
        outputs=tuple(range(1, outputs + 1)),
        selected_inputs=(SELECTED + 1,),
    )
    given = {**sources(design, view), "limb_data": limb}
    size = new_graph().evaluate(("response_samples", "n_fft"), given)
    for edit in EDITS:
        moved, work = least_work(edit, size["response_samples"], size["n_fft"], inputs, outputs)
        times = times_of(limb, edit, design, view)
        yield Point(
            grows=grows,
            edit=edit,
            length_s=length_s,
            inputs=inputs,
            outputs=outputs,
            fastest_ms=1e3 * min(times),
            median_ms=1e3 * statistics.median(times),
            runs=len(times),
            streamed=size["n_fft"] is None,
            read_bytes=moved,
            operations=work,
        )


def all_points(limb: Limb, longest_s: float) -> list[Point]:
    """Measure everything, and print it on the way."""
    cases = [("length", length_s, INPUTS, SHOWN) for length_s in LENGTHS_S if length_s <= longest_s]
    cases += [("inputs", LENGTH_S, count, SHOWN) for count in N_INPUTS]
    cases += [("outputs", LENGTH_S, INPUTS, count) for count in N_SHOWN]
    print(f"{'grows':>8} {'length, s':>9} {'inputs':>6} {'outputs':>7}", end="")
    print("".join(f"{edit + ', ms':>20}" for edit in EDITS))
    points = []
    for grows, length_s, inputs, outputs in cases:
        row = list(measured(limb, grows, length_s, inputs, outputs))
        print(f"{grows:>8} {length_s:9g} {inputs:6d} {outputs:7d}", end="")
        print("".join(f"{cost.fastest_ms:20.3g}" for cost in row), flush=True)
        points += row
    return points


def summary(points: Sequence[Point], machine: Machine) -> Iterator[str]:
    """Yield one line for each edit and direction of growth."""
    for grows in ("length", "inputs", "outputs"):
        for edit in EDITS:
            mine = [p for p in points if p.grows == grows and p.edit == edit]
            times = sorted(point.times_limit(machine) for point in mine)
            growth = mine[-1].fastest_ms / mine[0].fastest_ms
            yield (
                f"{grows:>8}, {edit}: {mine[0].fastest_ms:.3g} to {mine[-1].fastest_ms:.3g} ms "
                f"({growth:.3g} x); {times[0]:.2g} to {times[-1]:.2g} times the limit, "
                f"median {statistics.median(times):.2g}"
            )


def main() -> int:
    """Measure, print, write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--longest", type=float, default=LENGTHS_S[-1], help="seconds")
    parser.add_argument("--folder", type=Path, default=Path("build") / "growth")
    options = parser.parse_args()
    # As the studio does at its start.
    keep_freed_memory()
    limb = load_limb(default_limb())
    _ = limb.impulse_responses
    machine = this_machine()
    print(
        f"{platform.platform()}, Python {platform.python_version()}, numpy {np.__version__}, "
        f"scipy {scipy.__version__}, {limb.name}"
    )
    points = all_points(limb, options.longest)
    machine = machine.better_of(this_machine())
    print(
        f"reading {machine.read_rate / 1e9:.1f} GB/s, "
        f"transforms {machine.transform_rate / 1e9:.1f} GFLOP/s"
    )
    write(points, machine, limb.name, options.folder)
    print("\n".join(summary(points, machine)))
    print(f"written: {options.folder / 'growth.csv'}, growth.svg, growth.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
