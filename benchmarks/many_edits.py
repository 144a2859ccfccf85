"""Memory over very many edits of every kind, at random but always the same ones.

The document and the quantities that the window shows.  Caches and history are bounded, so that once
they are full the process grows no more.  Printed: edits, seconds, resident memory in MB, and what
of it is held once all that is free is given back to the system; held memory is what must not grow.
That widgets do not grow in number is seen at night (`tests/nightly/monkey.py`).

    python benchmarks/many_edits.py [--edits 100000]
"""

import argparse
import os
import platform
import statistics
import sys
from collections import Counter
from collections.abc import Callable
from time import perf_counter

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")

from random_edits import RandomEdits
from resident import held_mb, resident_mb

from skinsource.design.design import Design, View, track
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.quantities import new_graph, sources
from skinsource.limbs.catalog import default_limb
from skinsource_gui.app.app import make_application
from skinsource_gui.state.document import Document
from skinsource_gui.state.preferences import start_design

#: What the panels of the window show, and the check of it.
SHOWN = frozenset(
    {
        "input_waveforms",
        "surface_levels_db",
        "selected_extremes",
        "selected_spectra",
        "response_time_s",
        "trace_error",
    }
)
MOST_GROWTH_MB = 10.0
#: Edits until all caches are full.
FILLING = 30_000
_SAMPLES = 50


def main() -> int:
    """Print memory at steps; 1 if a promise is broken."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--edits", type=int, default=100_000)
    options = parser.parse_args()
    make_application()
    print(f"{platform.platform()}, Python {platform.python_version()}, {default_limb()}")
    return int(not memory_stands_still(options.edits))


def memory_stands_still(count: int) -> bool:
    """Edit a document and evaluate after each edit."""
    document, graph = Document(start_design(default_limb())), new_graph()
    edits = RandomEdits(document)

    def evaluate() -> None:
        graph.evaluate(SHOWN, sources(document.design, document.view))

    def fill_caches() -> None:
        # They go up and down by a hundred megabytes as large old entries go for new ones: memory is
        # compared with the same in them, all places at the longest length.
        graph.evaluate(SHOWN, sources(full_design(), View()))

    for _ in range(FILLING):
        edits.make_one()
        evaluate()
    growth_mb = watched(edits, evaluate, count, fill_caches)
    holds = growth_mb < MOST_GROWTH_MB
    print(f"{document.undo_stack.count()} steps can be undone")
    print(
        f"held, from the first third to the last, after {FILLING} edits that filled the caches: "
        f"{growth_mb:+.1f} MB, "
        f"promised less than {MOST_GROWTH_MB:.0f}: {'kept' if holds else 'BROKEN'}"
    )
    return holds


def full_design() -> Design:
    """All places, four seconds each."""
    return Design(
        limb=default_limb(),
        inputs=tuple(
            track(location=place, waveform=Tone(frequency_hz=20.0 * place, duration_s=4.0))
            for place in range(1, 21)
        ),
    )


def watched(
    edits: RandomEdits,
    follow: Callable[[], object],
    count: int,
    settle: Callable[[], object],
) -> float:
    """Make ``count`` edits, each followed by ``follow``, and print memory at ten steps.

    Before memory is looked at, ``settle`` is called.

    Returns by how many MB what is held grew from the first third to the last.
    """
    made: Counter[str] = Counter()
    samples_mb: list[float] = []
    every = max(1, count // _SAMPLES)
    begin = perf_counter()
    for number in range(1, count + 1):
        made[edits.make_one()] += 1
        follow()
        if number % every == 0:
            settle()
            resident = resident_mb()
            samples_mb.append(held_mb())
            if number % (count // 10) == 0:
                took_s = perf_counter() - begin
                print(f"{number:8d} {took_s:6.0f} {resident:9.1f} {samples_mb[-1]:8.1f}")
    part = len(samples_mb) // 3
    print(", ".join(f"{name} {times}" for name, times in made.most_common()))
    return statistics.median(samples_mb[-part:]) - statistics.median(samples_mb[:part])


if __name__ == "__main__":
    sys.exit(main())
