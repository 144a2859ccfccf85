"""``skinsource sweep``: measure many stimuli."""

import argparse
import sys
from pathlib import Path
from typing import Any

from skinsource.limbs.dataset.commands import ProgressBar, WithTimeLeft
from skinsource.studies.sweeps.cluster import Cluster
from skinsource.studies.sweeps.running import read_sweep, run
from skinsource.studies.sweeps.table import TABLE

_MOST_SHOWN = 10


def add_to(subparsers: Any) -> None:
    """Add the command ``sweep``."""
    sweep = subparsers.add_parser(
        "sweep",
        help="measure many stimuli: designs x frequencies x places x ...",
        description="Measures all combinations that a TOML file names, on all cores, and writes "
        "stimuli.csv with one row for each. Run it again after a stop, and it continues.",
        epilog="A stimulus that cannot be measured is left out, and its row says why. Exit codes: "
        "0, all rows were measured; 1, one was left out or the sweep could not run; 130, it was "
        "stopped.",
    )
    sweep.add_argument("sweep", type=Path, metavar="SWEEP", help="a .toml file")
    sweep.add_argument(
        "--out", type=Path, required=True, metavar="FOLDER", help="folder to write or continue in"
    )
    sweep.add_argument(
        "--processes", type=int, metavar="N", help="number of processes (default: all cores)"
    )
    sweep.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="address of a Dask cluster that measures instead: tcp://host:8786",
    )
    sweep.set_defaults(run=_sweep)


def _sweep(arguments: argparse.Namespace) -> int:
    plan = read_sweep(arguments.sweep)
    cluster = None if arguments.scheduler is None else Cluster(arguments.scheduler)
    with ProgressBar(sys.stderr) as bar:
        table = run(
            plan,
            arguments.out,
            processes=arguments.processes,
            measuring=cluster,
            progress=WithTimeLeft(bar),
        )
    failed = table.failed
    for number in sorted(failed)[:_MOST_SHOWN]:
        sys.stderr.write(f"skinsource: stimulus {number} left out: {failed[number]}\n")
    if len(failed) > _MOST_SHOWN:
        sys.stderr.write(f"skinsource: … and {len(failed) - _MOST_SHOWN} more\n")
    left_out = f", {len(failed)} of them left out" if failed else ""
    sys.stdout.write(f"{len(table)} stimuli{left_out}\n{arguments.out / TABLE}\n")
    # Programs that use the table (make, a queue of jobs) must notice that it is incomplete.
    return int(bool(failed))
