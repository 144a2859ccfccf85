"""Two limbs, or two designs on one limb, in turn: what an edit costs beside what it costs alone.

Each design in a graph of its own; the graphs share what they can, as the studio's slots do.  Alone
and in turn are measured alternately, in one process; the ratio of the medians is promised to be at
most 1.2.

    python benchmarks/slots.py
"""

import statistics
import sys
from collections.abc import Callable
from dataclasses import replace
from time import perf_counter

from skinsource.base.allocation import keep_freed_memory
from skinsource.design.clips import Clip
from skinsource.design.design import Design, View, track
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.graph import Graph
from skinsource.engine.quantities import graphs_that_share, sources

PROMISED = 1.2
ROUNDS, STEPS = 40, 10
WANTED = ("output_levels_db", "surface_levels_db", "selected_traces", "selected_spectra")
VIEW = View(axes="xyz", method="pca", outputs=(29, 52, 1, 2, 3, 4))

Edit = Callable[[Design, int], Design]
EDITS: dict[str, Edit] = {
    "amplitude": lambda design, k: design.with_input(0, amplitude=1.0 + k / 1000),
    "waveform": lambda design, k: design.with_input(
        0, clips=(Clip(waveform=Tone(frequency_hz=100.0 + k / 100, duration_s=1.0)),)
    ),
}


def twenty_inputs(limb: str, first_hz: float) -> Design:
    """A tone of 1 s at each place."""
    tones = (Tone(frequency_hz=first_hz + 7 * place, duration_s=1.0) for place in range(20))
    inputs = tuple(track(location=k, waveform=tone) for k, tone in enumerate(tones, start=1))
    return Design(limb=limb, inputs=inputs, scaling="upstream")


def main() -> int:
    """Print a row for each pair and edit; 1 if a promise is broken."""
    keep_freed_memory()
    design = twenty_inputs("synthetic-1", 60.0)
    pairs = {
        "two limbs": (design, replace(design, limb="synthetic-2")),
        "two designs": (design, twenty_inputs("synthetic-1", 63.0)),
    }
    print(f"{'':>12} {'edit':>10} {'alone, ms':>10} {'in turn, ms':>12} {'ratio':>6}  promised")
    holds = [row(pair, edit, *pairs[pair]) for pair in pairs for edit in EDITS]
    return 0 if all(holds) else 1


def row(pair: str, edit: str, left: Design, right: Design) -> bool:
    """Measure and print one row; whether the promise holds."""
    make = graphs_that_share()
    slots = [(make(), left), (make(), right)]
    for graph, design in slots:
        graph.evaluate(WANTED, sources(design, VIEW))
    alone_ms, turn_ms = [], []
    for k in range(ROUNDS):
        start = 2 * STEPS * k
        # As many edits each way: one design after the other, or both in turn.
        alone = [(slot, start + step) for slot in slots for step in range(STEPS)]
        turn = [(slot, start + STEPS + step) for step in range(STEPS) for slot in slots]
        alone_ms.append(timed_ms(edit, alone))
        turn_ms.append(timed_ms(edit, turn))
    ratio = statistics.median(turn_ms[2:]) / statistics.median(alone_ms[2:])
    mark = "" if ratio <= PROMISED else "  BROKEN"
    print(
        f"{pair:>12} {edit:>10} {statistics.median(alone_ms):10.3f} "
        f"{statistics.median(turn_ms):12.3f} {ratio:6.2f}  {PROMISED}{mark}"
    )
    return ratio <= PROMISED


def timed_ms(edit: str, steps: list[tuple[tuple[Graph, Design], int]]) -> float:
    """Time of one edit, as the mean over some."""
    begin = perf_counter()
    for (graph, design), k in steps:
        graph.evaluate(WANTED, sources(EDITS[edit](design, k), VIEW))
    return 1e3 * (perf_counter() - begin) / len(steps)


if __name__ == "__main__":
    sys.exit(main())
