"""``skinsource sweep``: many stimuli at once."""

import argparse
import sys
import time
from pathlib import Path
from typing import Any

from skinsource.dataset.progress_bar import ProgressBar
from skinsource.job import left_in_words, seconds_left
from skinsource.sweeps import read_sweep, run
from skinsource.sweeps.cluster import Cluster
from skinsource.sweeps.folder import TABLE

_MOST_SHOWN = 10


def add_to(subparsers: Any) -> None:
    """Add the command ``sweep``."""
    sweep = subparsers.add_parser(
        "sweep",
        help="measure many stimuli: designs x frequencies x places x ...",
        description="Measures all combinations that a TOML file names, on all cores, and writes "
        "stimuli.csv with one row for each. Run again after it was stopped, it goes on.",
    )
    sweep.add_argument("sweep", type=Path, metavar="SWEEP", help="a .toml file")
    sweep.add_argument(
        "--out", type=Path, required=True, metavar="DIR", help="where to write, and to go on"
    )
    sweep.add_argument(
        "--processes", type=int, metavar="N", help="how many measure at once (default: all cores)"
    )
    sweep.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="of a Dask cluster that measures instead: tcp://host:8786",
    )
    sweep.set_defaults(run=_sweep)


def _sweep(arguments: argparse.Namespace) -> int:
    wanted = read_sweep(arguments.sweep)
    cluster = None if arguments.scheduler is None else Cluster(arguments.scheduler)
    with ProgressBar(sys.stderr) as bar:
        table = run(
            wanted,
            arguments.out,
            processes=arguments.processes,
            measuring=cluster,
            progress=_WithTimeLeft(bar),
        )
    failed = table.failed
    for number in sorted(failed)[:_MOST_SHOWN]:
        sys.stderr.write(f"skinsource: stimulus {number} left out: {failed[number]}\n")
    if len(failed) > _MOST_SHOWN:
        sys.stderr.write(f"skinsource: … and {len(failed) - _MOST_SHOWN} more\n")
    left_out = f", {len(failed)} of them left out" if failed else ""
    sys.stdout.write(f"{len(table)} stimuli{left_out}\n{arguments.out / TABLE}\n")
    return 0


class _WithTimeLeft:
    """Shows progress with the time left, as seen since the start of this run."""

    def __init__(self, bar: ProgressBar) -> None:
        self._bar = bar
        self._start_s = time.monotonic()
        self._before: int | None = None

    def __call__(self, done: int, total: int, text: str) -> None:
        if self._before is None:
            self._before = done
        elapsed_s = time.monotonic() - self._start_s
        left = left_in_words(seconds_left(done - self._before, total - self._before, elapsed_s))
        self._bar(done, total, f"{text}  {left}".rstrip())
