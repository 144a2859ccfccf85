"""Which of 60 one-line faults do the tests notice?  ``make faults``, which runs ``again``.

The faults are in ``planted_faults.json``.  They are planted one after the other in copies of the
project; the first test that fails ends it.  Tests are run whose names are near; what they do not
notice is run with those that reach the line, which one run of the whole suite shows, and what still
survives with the whole suite.

- ``draw`` draws faults by lot, by the seed that is given, and forgets what was noticed.
- ``baseline`` notes which of them the tests notice; it goes on where it was ended.
- ``again`` plants those that were noticed, wherever their lines stand now, and ends with 1 if
  fewer than 97 % of them are noticed.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from importlib.util import cache_from_source
from pathlib import Path
from queue import SimpleQueue
from xml.etree import ElementTree

from coverage import CoverageData

from tests.nightly.fault_places import Fault, Place, draw, find, plant

PROJECT = Path(__file__).resolve().parents[2]
STORED = Path(__file__).with_suffix(".json")
COUNT = 60
LEAST_SHARE = 0.97
#: How many of the tests that reach a line are tried first.
CHOSEN = 150
#: Cases of a test that are tried before others: they are often alike.
CASES = 3
WHOLE = ["tests/core", "tests/gui"]
#: Steps: which tests run.
STEPS = ("near", "chosen", "covering", "whole")
#: How many files of tests are near.
NEAR = 8


@dataclass
class Planted:
    """A fault, and whether the tests noticed it: which one, and how many of them were run."""

    fault: Fault
    noticed: bool | None = None
    by: str = ""
    ran: str = ""


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("deed", choices=("draw", "baseline", "again"))
    parser.add_argument("--seed", type=int, default=23, help="of draw")
    parser.add_argument("--at-once", type=int, default=2)
    parser.add_argument("--most", choices=STEPS, default="whole", help="of what survivors run")
    parser.add_argument("--measured", type=Path, help="folder of what the whole run measured")
    options = parser.parse_args()
    if options.deed == "draw":
        store(options.seed, [Planted(fault) for fault in draw(PROJECT, options.seed, COUNT)])
        return 0
    seed, stored = load()
    if options.deed == "baseline":
        todo = [one for one in stored if not one.noticed and one.ran != options.most]
    else:
        todo = [Planted(one.fault, by=one.by) for one in stored if one.noticed]
    gone = [one for one in todo if find(PROJECT, one.fault) is None]
    todo = [one for one in todo if one not in gone]
    with tempfile.TemporaryDirectory(prefix="skinsource-faults-") as name:
        copies = [copy_of_project(Path(name) / f"copy-{k}") for k in range(options.at_once)]
        suite = Suite()
        for step in STEPS[: STEPS.index(options.most) + 1]:
            left = [one for one in todo if not one.noticed and step not in done_before(one)]
            if step == "chosen" and left:
                measured = options.measured or Path(name) / "measured"
                if not (measured / "seconds.xml").exists():
                    measure(copies[0], measured, left)
                suite.read(measured)
            for tried in try_in_turn(left, copies, suite, step):
                print(describe(tried), flush=True)
                if options.deed == "baseline":
                    store(seed, stored)
    for one in gone:
        print(f"gone      {one.fault.file} {one.fault.function}: {one.fault.line}")
    noticed = sum(one.noticed is True for one in todo)
    print(f"{noticed} of {len(todo)} noticed, {len(gone)} gone")
    return 1 if options.deed == "again" and noticed < LEAST_SHARE * len(todo) else 0


def done_before(planted: Planted) -> tuple[str, ...]:
    """Steps that a fault has survived."""
    return STEPS[: STEPS.index(planted.ran) + 1] if planted.ran else ()


def load() -> tuple[int, list[Planted]]:
    """Read the seed and the faults."""
    tree = json.loads(STORED.read_text("utf-8"))
    outcomes = ("noticed", "by", "ran")
    return tree["seed"], [
        Planted(
            Fault(**{key: value for key, value in entry.items() if key not in outcomes}),
            **{key: entry[key] for key in outcomes},
        )
        for entry in tree["faults"]
    ]


def store(seed: int, faults: Sequence[Planted]) -> None:
    """Write the seed and the faults."""
    entries = [
        {**asdict(one.fault), "noticed": one.noticed, "by": one.by, "ran": one.ran}
        for one in faults
    ]
    text = json.dumps({"seed": seed, "faults": entries}, indent=1, ensure_ascii=False)
    STORED.write_text(text + "\n", "utf-8")


def describe(planted: Planted) -> str:
    """One line, and for a survivor what was changed."""
    fault = planted.fault
    place = f"{fault.file} {fault.function}"
    if planted.noticed:
        return f"noticed   {place}: {planted.by}"
    return f"SURVIVED  {place} ({planted.ran})\n    - {fault.line}\n    + {fault.changed}"


def copy_of_project(folder: Path) -> Path:
    """Copy the files that git knows, as they are now."""
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=PROJECT, check=True, capture_output=True, text=True
    ).stdout
    for name in listed.rstrip("\0").split("\0"):
        if (PROJECT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(PROJECT / name, folder / name)
    return folder


def run_tests(copy: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run tests of a copy, with its own code."""
    paths = os.pathsep.join((str(copy / "core"), str(copy)))
    return subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "--tb=no", "-p", "no:cacheprovider", *arguments],
        cwd=copy,
        env={**os.environ, "PYTHONPATH": paths, "QT_QPA_PLATFORM": "offscreen"},
        capture_output=True,
        text=True,
        errors="replace",
    )


def measure(copy: Path, folder: Path, faults: Sequence[Planted]) -> None:
    """Run the whole suite: which tests reach which lines of the files, and how long they take."""
    folder.mkdir(parents=True, exist_ok=True)
    settings = folder / "coverage.ini"
    places = [find(copy, one.fault) for one in faults]
    include = "".join(f"\n    {file}" for file in sorted({one.file for one in places if one}))
    settings.write_text(
        f"[run]\nrelative_files = true\ndata_file = {folder / 'coverage.db'}\ninclude ={include}\n"
    )
    coverage = ("--cov", f"--cov-config={settings}", "--cov-context=test", "--cov-report=")
    parallel = ("-n", "2", "--dist", "worksteal")
    run_tests(copy, *parallel, *coverage, f"--junitxml={folder / 'seconds.xml'}")


@dataclass
class Suite:
    """All tests: which reach a line, how many seconds each takes, which fail without a fault."""

    data: CoverageData = field(default_factory=CoverageData)
    seconds: dict[str, float] = field(default_factory=dict)
    failing: set[str] = field(default_factory=set)

    def read(self, folder: Path) -> None:
        """Read what the whole run measured."""
        self.data = CoverageData(str(folder / "coverage.db"))
        self.data.read()
        for case in ElementTree.parse(folder / "seconds.xml").iter("testcase"):  # noqa: S314
            test = f"{case.get('classname', '').replace('.', '/')}.py::{case.get('name')}"
            self.seconds[test] = float(case.get("time", 0.0))
            if case.find("failure") is not None or case.find("error") is not None:
                self.failing.add(test)

    def reaching(self, place: Place) -> list[str]:
        """Tests that reach a statement: the nearest by name first, then the quickest."""
        contexts = self.data.contexts_by_lineno(place.file)
        reach = {name.rpartition("|")[0] for k in place.statement for name in contexts.get(k, ())}
        parts = name_parts(place.file)
        ordered = sorted(
            reach & self.seconds.keys() - self.failing,
            key=lambda test: (
                -len(parts & name_parts(test.partition("::")[0])),
                self.seconds[test],
                test,
            ),
        )
        cases: Counter[str] = Counter()
        first: list[str] = []
        rest: list[str] = []
        for test in ordered:
            function = test.partition("[")[0]
            cases[function] += 1
            (first if cases[function] <= CASES else rest).append(test)
        return first + rest


def name_parts(path: str) -> set[str]:
    """What a path is about."""
    return set(re.split(r"[/_.]", path)) - {"tests", "test", "py", "skinsource", "panel", "panels"}


@contextmanager
def planted_in(copy: Path, fault: Fault, place: Place) -> Iterator[None]:
    """Have the fault in the copy for a while."""
    path = copy / place.file
    text = path.read_text("utf-8")
    plant(copy, fault, place)
    try:
        yield
    finally:
        path.write_text(text, "utf-8")
        # Both may have been written within a second, and be equally long.
        Path(cache_from_source(str(path))).unlink(missing_ok=True)


def noticed_before(copy: Path, test: str) -> list[str]:
    """Name the test with all its cases, if there still is one."""
    file, _, name = test.partition("[")[0].partition("::")
    there = name and (copy / file).is_file()
    return [f"{file}::{name}"] if there and f"def {name}(" in (copy / file).read_text() else []


def near_tests(copy: Path, fault: Fault, place: Place) -> list[str]:
    """Files of tests that are nearest by their path and by what they name."""
    parts = name_parts(place.file)
    module = place.file.removeprefix("core/").removesuffix(".py").replace("/", ".")
    package, _, stem = module.rpartition(".")
    called = fault.function.split(".")[0].strip("_")
    named = {module: 3, called: 3, package: 1, stem: 1}

    def nearness(path: Path) -> int:
        text = path.read_text("utf-8")
        score = 2 * len(parts & name_parts(path.relative_to(copy).as_posix()))
        return score + sum(k for name, k in named.items() if re.search(rf"\b{name}\b", text))

    scores = {path: nearness(path) for path in (copy / "tests").glob("[cg]*/**/test_*.py")}
    files = sorted(scores, key=lambda path: (-scores[path], path))
    least = 0.6 * scores[files[0]]
    return [path.relative_to(copy).as_posix() for path in files[:NEAR] if scores[path] >= least]


def try_in_turn(
    faults: list[Planted], copies: list[Path], suite: Suite, step: str
) -> Iterator[Planted]:
    """Try faults, as many at once as there are copies."""
    free: SimpleQueue[Path] = SimpleQueue()
    for copy in copies:
        free.put(copy)

    def try_next(planted: Planted) -> Planted:
        copy = free.get()
        try:
            try_fault(planted, copy, suite, step)
        finally:
            free.put(copy)
        return planted

    with ThreadPoolExecutor(len(copies)) as pool:
        yield from pool.map(try_next, faults)


def try_fault(planted: Planted, copy: Path, suite: Suite, step: str) -> None:
    """Run the tests of a step with a fault, until one fails that passes without it."""
    place = find(copy, planted.fault)
    if place is None:
        raise RuntimeError(f"{planted.fault} is in the project and not in its copy")
    if step == "near":
        tests = [*noticed_before(copy, planted.by), *near_tests(copy, planted.fault, place)]
    elif step == "whole":
        tests = WHOLE
    else:
        reaching = suite.reaching(place)
        tests = reaching[:CHOSEN] if step == "chosen" else reaching[CHOSEN:]
    failed = first_failure(planted.fault, place, copy, tests, suite) if tests else None
    planted.noticed, planted.by, planted.ran = failed is not None, failed or "", step


def first_failure(
    fault: Fault, place: Place, copy: Path, tests: list[str], suite: Suite
) -> str | None:
    """Name the first test that fails with the fault and passes without it."""
    listed = copy / "tests-to-run.txt"
    at_once = ["-n", "2"] if tests == WHOLE or len(tests) > CHOSEN else []
    while True:
        leave_out = [f"--deselect={test}" for test in suite.failing]
        listed.write_text("\n".join([*leave_out, *tests]), "utf-8")
        with planted_in(copy, fault, place):
            done = run_tests(copy, "-x", *at_once, f"@{listed}")
        if done.returncode in (0, 5):  # 5: all of them are left out
            return None
        named = re.search(r"^(?:FAILED|ERROR) (.+?)(?: - .*)?$", done.stdout, re.MULTILINE)
        if "ImportError while loading conftest" in done.stderr:
            return "no test can be imported"
        if done.returncode == 4:
            raise RuntimeError(done.stdout + done.stderr)
        if named is None:
            return "the process ended"
        if run_tests(copy, named[1]).returncode == 0:
            return named[1]
        suite.failing.add(named[1])


if __name__ == "__main__":
    sys.exit(main())
