"""``skinsource bench``."""

import argparse
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from skinsource.dataset.progress_bar import ProgressBar, WithTimeLeft
from skinsource.errors import Stopped
from skinsource.files import make_folder, write_bytes
from skinsource.job import Progress
from skinsource.method_comparison.compared_limb import MADE_UP, limb_called
from skinsource.method_comparison.direct_sums import EXACT_NAME, exact_response, write_references
from skinsource.method_comparison.every_scene import EVERY_ENGINE, EVERY_SCENE, Scene
from skinsource.method_comparison.machine import facts
from skinsource.method_comparison.measure import (
    FULL,
    QUICK,
    Case,
    Effort,
    cases_of,
    measure,
    processes_of,
)
from skinsource.method_comparison.plot import write_plots
from skinsource.method_comparison.report import report_of
from skinsource.method_comparison.scenes import ComparedScene, scenes_on
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
        "table and report of what was measured until then. With --limb, scenes are played on that "
        "limb: with its responses, places, outputs, axes and rate. Exact values are then computed "
        "first, by plain sums of products in whole numbers, and kept in "
        f"{EXACT_NAME}; actuators and resampling, which know no limb, are left out. On "
        "large limbs all takes longer: --quick is meant for them.",
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
        "--limb",
        default="",
        metavar="NAME",
        help="measure on this limb, such as one that was imported (default: made-up responses in "
        "the shape of the published limbs)",
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
    # What is not there is told before the work, and before a folder is made.
    limb = limb_called(arguments.limb) if arguments.limb else MADE_UP
    make_folder(folder)
    effort = QUICK if arguments.quick else FULL
    scenes: Sequence[Scene] = EVERY_SCENE if limb == MADE_UP else scenes_on(limb)
    cases = cases_of(scenes, EVERY_ENGINE, quick=arguments.quick)
    exact = None if limb == MADE_UP else folder / EXACT_NAME
    table, report = folder / f"{_NAME}.csv", folder / "report.md"
    rows: list[Row] = []
    bound: float | None = None

    def keep(found: list[Row]) -> None:
        rows[:] = found
        write_table(table, found)

    def tell_all(n_cases: int | None = None) -> None:
        about = facts(limb, exact)
        text = report_of(rows, about, effort, n_cases=n_cases, bound=bound)
        write_bytes(report, text.encode())

    try:
        with _progress(arguments.progress) as tell:
            if exact is not None:
                bound = _write_exact(exact, cases, effort, tell)
            rows = measure(cases, effort, tell, keep=keep, references=exact)
    except KeyboardInterrupt:
        if not rows:
            raise
        tell_all(len(cases))
        raise Stopped(f"stopped. What was measured until then is in {report}") from None
    write_table(table, rows)
    tell_all()
    failed = sum(bool(row.failure) for row in rows)
    broken = sum(row.engine == "this program" and "broken" in row.promise for row in rows)
    sys.stdout.write(
        f"{len(rows)} rows, {failed} of them could not be measured; this program breaks its "
        f"promises in {broken}. See {report}\n"
    )
    write_plots(rows, folder / _NAME)
    return 0


def _write_exact(path: Path, cases: Sequence[Case], effort: Effort, tell: Progress) -> float:
    """Write the exact values of all that is measured; how far they may be off at most."""
    total = processes_of(cases, effort)
    scenes = {case.scene.reference: case.scene for case in cases}
    found = {}
    for key, scene in scenes.items():
        if isinstance(scene, ComparedScene):
            tell(0, total, f"exact values of {key}")
            found[key] = exact_response(scene)
    write_references(path, found)
    return max(one.bound for one in found.values())


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
