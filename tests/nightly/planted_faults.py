"""Do the tests still notice the one-line faults that they noticed once?  ``make faults``.

The faults are in ``planted_faults.json``: changed lines of functions, as texts without numbers, so
that each is planted wherever its line stands now.  They are planted one after the other in copies
of the project; the first test that fails ends it.  First that file of tests runs that noticed it
before, then the whole suite.  It ends with 1 if fewer than 97 % are noticed.
"""

import argparse
import ast
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from queue import SimpleQueue
from typing import NamedTuple

PROJECT = Path(__file__).resolve().parents[2]
STORED = Path(__file__).with_suffix(".json")
PRODUCT = ("core/skinsource", "skinsource_gui")
LEAST_SHARE = 0.97
WHOLE = ["-n", "2", "tests/core", "tests/gui"]


@dataclass(frozen=True)
class Fault:
    """A line of a function and what it is changed to, without the blanks around them.

    ``by`` is the test that noticed it.
    """

    file: str
    function: str
    line: str
    changed: str
    by: str = ""


class Place(NamedTuple):
    """Where the line of a fault stands: its file and its number, from 1."""

    file: str
    number: int


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--at-once", type=int, default=2)
    options = parser.parse_args()
    faults = stored_faults()
    gone = [fault for fault in faults if find(PROJECT, fault) is None]
    to_plant = [fault for fault in faults if fault not in gone]
    n_noticed = 0
    with (
        tempfile.TemporaryDirectory(prefix="skinsource-faults-") as name,
        ThreadPoolExecutor(options.at_once) as pool,
    ):
        free: SimpleQueue[Path] = SimpleQueue()
        for k in range(options.at_once):
            free.put(copy_of_project(Path(name) / f"copy-{k}"))

        def try_next(fault: Fault) -> str | None:
            copy = free.get()
            try:
                return noticed_in(copy, fault)
            finally:
                free.put(copy)

        for fault, noticed_by in zip(to_plant, pool.map(try_next, to_plant), strict=True):
            n_noticed += noticed_by is not None
            place = f"{fault.file} {fault.function}"
            if noticed_by is None:
                print(f"SURVIVED  {place}\n    - {fault.line}\n    + {fault.changed}", flush=True)
            else:
                print(f"noticed   {place}: {noticed_by}", flush=True)
    for fault in gone:
        print(f"gone      {fault.file} {fault.function}: {fault.line}")
    print(f"{n_noticed} of {len(to_plant)} noticed, {len(gone)} gone")
    return 1 if n_noticed < LEAST_SHARE * len(to_plant) else 0


def stored_faults() -> list[Fault]:
    """Read the faults that were noticed."""
    entries = json.loads(STORED.read_text("utf-8"))["faults"]
    names = Fault.__dataclass_fields__
    return [Fault(**{name: entry[name] for name in names}) for entry in entries if entry["noticed"]]


def find(project: Path, fault: Fault) -> Place | None:
    """Look a fault's line up: in its file, else in any with a function of that name."""
    paths = [path for folder in PRODUCT for path in sorted((project / folder).rglob("*.py"))]
    for path in [project / fault.file, *paths]:
        text = path.read_text("utf-8") if path.exists() else ""
        if fault.line not in text:
            continue
        lines = text.splitlines()
        for name, function in _functions(ast.parse(text)):
            for number in range(function.lineno, (function.end_lineno or 0) + 1):
                if name == fault.function and lines[number - 1].strip() == fault.line:
                    return Place(path.relative_to(project).as_posix(), number)
    return None


def plant(project: Path, fault: Fault, place: Place) -> None:
    """Change the line in a copy of the project."""
    path = project / place.file
    lines = path.read_text("utf-8").splitlines(keepends=True)
    old = lines[place.number - 1]
    lines[place.number - 1] = old.replace(fault.line, fault.changed)
    path.write_text("".join(lines), "utf-8")


def _functions(tree: ast.AST, prefix: str = "") -> Iterator[tuple[str, ast.FunctionDef]]:
    """Functions and methods with their qualified names; one in a function belongs to it."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.FunctionDef):
            yield prefix + node.name, node
        elif isinstance(node, ast.ClassDef):
            yield from _functions(node, f"{prefix}{node.name}.")
        else:
            yield from _functions(node, prefix)


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
    # No compiled files: a fault may be as long as its line, and planted within the same second.
    own = {"PYTHONPATH": paths, "PYTHONDONTWRITEBYTECODE": "1", "QT_QPA_PLATFORM": "offscreen"}
    return subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "--tb=no", "-p", "no:cacheprovider", *arguments],
        cwd=copy,
        env={**os.environ, **own},
        capture_output=True,
        text=True,
        errors="replace",
    )


def noticed_before(copy: Path, test: str) -> list[str]:
    """Name the file of the test that noticed a fault, if it is still there."""
    file = test.partition("::")[0]
    return [file] if file and (copy / file).is_file() else []


def noticed_in(copy: Path, fault: Fault) -> str | None:
    """Plant a fault, and name the first test that fails with it and passes without it."""
    place = find(copy, fault)
    if place is None:
        raise RuntimeError(f"{fault} is in the project and not in its copy")
    text = (copy / place.file).read_text("utf-8")
    failing: list[str] = []
    for tests in filter(None, (noticed_before(copy, fault.by), WHOLE)):
        while True:
            plant(copy, fault, place)
            done = run_tests(copy, "-x", *(f"--deselect={test}" for test in failing), *tests)
            (copy / place.file).write_text(text, "utf-8")
            if done.returncode in (0, 5):  # 5: all of them are left out
                break
            failed = re.search(r"^(?:FAILED|ERROR) (.+?)(?: - .*)?$", done.stdout, re.MULTILINE)
            if failed is None:
                return "the process ended"
            if run_tests(copy, failed[1]).returncode == 0:
                return failed[1]
            failing.append(failed[1])
    return None


if __name__ == "__main__":
    sys.exit(main())
