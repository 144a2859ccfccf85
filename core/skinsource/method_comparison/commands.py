"""``skinsource bench``."""

import argparse
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from skinsource.dataset.progress_bar import ProgressBar, WithTimeLeft
from skinsource.errors import Stopped
from skinsource.files import make_folder, write_bytes
from skinsource.job import Progress
from skinsource.method_comparison.every_scene import EVERY_ENGINE, EVERY_SCENE
from skinsource.method_comparison.machine import facts
from skinsource.method_comparison.measure import FULL, QUICK, cases_of, measure
from skinsource.method_comparison.plot import write_plots
from skinsource.method_comparison.report import report_of
from skinsource.method_comparison.table import Row, write_table

_NAME = "work_precision"


def add_to(subparsers: Any) -> None:
    """Add the command ``bench``."""
    bench = subparsers.add_parser(
        "bench",
        help="measure error against run time on this machine",
        description="Measures this program and other ways of computing the same responses, of "
        "moving actuators and of resampling: how long they take, and how far they are from exact "
        "values. Writes "
        f"{_NAME}.csv, {_NAME}.svg, {_NAME}.png and report.md. Takes about ten minutes where "
        "nothing else runs, longer where something does, and shows the time left. Everything is "
        "measured once before anything is measured again; stopped earlier (Ctrl+C), it leaves "
        "table and report of what was measured until then.",
    )
    bench.add_argument("--quick", action="store_true", help="fewer scenes; under a minute")
    bench.add_argument(
        "--out",
        type=Path,
        default=Path("bench"),
        metavar="FOLDER",
        help="where to write (default: %(default)s)",
    )
    bench.add_argument(
        "--progress",
        choices=("bar", "lines"),
        default="bar",
        help="a bar in the terminal, or a line such as '3/51 S1 direct' for each step, which "
        "other programs can read (default: %(default)s)",
    )
    bench.set_defaults(run=_bench)


def _bench(arguments: argparse.Namespace) -> int:
    folder: Path = arguments.out
    # Before ten minutes of work, not after.
    make_folder(folder)
    effort = QUICK if arguments.quick else FULL
    cases = cases_of(EVERY_SCENE, EVERY_ENGINE, quick=arguments.quick)
    table, report = folder / f"{_NAME}.csv", folder / "report.md"
    rows: list[Row] = []

    def keep(found: list[Row]) -> None:
        rows[:] = found
        write_table(table, found)

    try:
        with _progress(arguments.progress) as tell:
            rows = measure(cases, effort, tell, keep=keep)
    except KeyboardInterrupt:
        if not rows:
            raise
        write_bytes(report, report_of(rows, facts(), effort, n_cases=len(cases)).encode())
        raise Stopped(f"stopped. What was measured until then is in {report}") from None
    write_table(table, rows)
    write_bytes(report, report_of(rows, facts(), effort).encode())
    failed = sum(bool(row.failure) for row in rows)
    broken = sum(row.engine == "this program" and "broken" in row.promise for row in rows)
    sys.stdout.write(
        f"{len(rows)} rows, {failed} of them could not be measured; this program breaks its "
        f"promises in {broken}. See {report}\n"
    )
    write_plots(rows, folder / _NAME)
    return 0


@contextmanager
def _progress(form: str) -> Iterator[Progress]:
    """What tells how far the work is."""
    if form == "lines":
        yield _write_line
    else:
        with ProgressBar(sys.stderr) as bar:
            yield WithTimeLeft(bar)


def _write_line(done: int, total: int, text: str) -> None:
    sys.stdout.write(f"{done}/{total} {text}\n")
    # A pipe would keep it back, and where nobody reads any more, the work ends here.
    sys.stdout.flush()
