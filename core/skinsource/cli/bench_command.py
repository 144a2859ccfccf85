"""``skinsource bench``: measure error against run time on this machine."""

import argparse
import platform
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import scipy

from skinsource.base.errors import Stopped
from skinsource.base.files import make_folder, write_bytes
from skinsource.base.job import Progress
from skinsource.design.comparing import RANGE_BETWEEN_PEOPLE
from skinsource.limbs.catalog import load_limb
from skinsource.limbs.dataset.commands import ProgressBar, WithTimeLeft
from skinsource.limbs.dataset.store import is_installed
from skinsource.limbs.own_limbs import facts_of
from skinsource.people.trials import held_text, range_held
from skinsource.studies.accuracy.cases import cases_of
from skinsource.studies.accuracy.measuring import (
    MEANING,
    QUICK_REPEATS,
    REPEATS,
    Row,
    measure,
    table_csv,
    table_text,
    write_plots,
)
from skinsource.version import __version__

_NAME = "work_precision"


def add_to(subparsers: Any) -> None:
    """Add the command ``bench``."""
    bench = subparsers.add_parser(
        "bench",
        help="measure error against run time on this machine",
        description="Measures how far this program, SciPy and direct sums are from exact values, "
        "and how long they take, in convolutions, resampling, actuators and wanted drives. Writes "
        f"{_NAME}.csv, {_NAME}.svg, {_NAME}.png and report.md. If it is stopped early (Ctrl+C), "
        "table and report hold what was measured so far.",
    )
    bench.add_argument("--quick", action="store_true", help="fewer cases, fewer runs of each")
    where = "where to write (default: %(default)s)"
    bench.add_argument("--out", type=Path, default=Path("bench"), metavar="FOLDER", help=where)
    bench.add_argument(
        "--limb",
        default="",
        metavar="NAME",
        help="measure convolutions on this limb, such as one that was imported; their exact values "
        "are computed first (default: all cases, on synthetic responses in the shape of the "
        "published limbs)",
    )
    bench.add_argument(
        "--progress",
        choices=("bar", "lines"),
        default="bar",
        help="a bar in the terminal, or a line such as '3/51 20 inputs, 2 s: direct sums' for each "
        "step, which other programs can read (default: %(default)s)",
    )
    bench.set_defaults(run=_bench)


def _bench(arguments: argparse.Namespace) -> None:
    folder: Path = arguments.out
    limb = load_limb(arguments.limb) if arguments.limb else None
    make_folder(folder)
    rows: list[Row] = []
    try:
        with _progress(arguments.progress) as progress:
            cases = cases_of(limb, quick=arguments.quick, progress=progress)
            repeats = QUICK_REPEATS if arguments.quick else REPEATS
            for row in measure(cases, repeats=repeats, progress=progress):
                rows.append(row)
    except KeyboardInterrupt:
        if not rows:
            raise
        _write(folder, rows, arguments.limb, "It was stopped before the end.")
        raise Stopped(f"stopped. The results so far are in {folder}") from None
    # What the range between people held needs the measured limbs.
    between = [f"{RANGE_BETWEEN_PEOPLE}\n\n{held_text(range_held())}"] if is_installed() else []
    _write(folder, rows, arguments.limb, after=between)
    sys.stdout.write("\n".join((table_text(rows), MEANING, *between, "")))
    write_plots(rows, folder / _NAME)


def _write(
    folder: Path, rows: Sequence[Row], limb: str, *remarks: str, after: Sequence[str] = ()
) -> None:
    digest = facts_of(limb).digest if limb else ""
    where = f"limb {limb}" if limb else "synthetic responses"
    where += f", SHA-256 {digest}" if digest else ""
    machine = (
        f"SkinSource studio {__version__}, Python {platform.python_version()}, NumPy "
        f"{np.__version__}, SciPy {scipy.__version__}, {platform.platform()}; {where}."
    )
    parts = ("# Error against run time", machine, *remarks, MEANING, table_text(rows), *after)
    write_bytes(folder / "report.md", "\n\n".join(parts).encode())
    write_bytes(folder / f"{_NAME}.csv", table_csv(rows).encode())


@contextmanager
def _progress(form: str) -> Iterator[Progress]:
    if form == "lines":
        yield _write_line
    else:
        with ProgressBar(sys.stderr) as bar:
            yield WithTimeLeft(bar)


def _write_line(done: int, total: int, text: str) -> None:
    sys.stdout.write(f"{done}/{total} {text}\n")
    # A pipe would hold it back; and where nobody reads any more, the work ends here.
    sys.stdout.flush()
