"""Do the tests still notice the one-line faults that they noticed once?  ``make faults``.

The faults are in ``planted_faults.json``: changed lines of functions, as texts without numbers, so
that each is planted wherever its line stands now.  They are planted one after the other in a copy
of the project; the first test that fails ends it.  First that file of tests runs that noticed it
before, then the whole suite.  It ends with 1 if fewer than 97 % are noticed.
"""

import ast
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

PROJECT = Path(__file__).resolve().parents[2]
STORED = Path(__file__).with_suffix(".json")
PRODUCT = ("core/skinsource", "skinsource_gui")
LEAST_SHARE = 0.97
WHOLE = ["-n", "auto", "tests/core", "tests/gui"]


class Fault(NamedTuple):
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
    entries = json.loads(STORED.read_text("utf-8"))["faults"]
    faults = [
        Fault(*(entry[name] for name in Fault._fields)) for entry in entries if entry["noticed"]
    ]
    told = {"noticed": 0, "SURVIVED": 0, "gone": 0}
    with tempfile.TemporaryDirectory(prefix="skinsource-faults-") as name:
        copy = copy_of_project(Path(name))
        for fault in faults:
            place = find(copy, fault)
            by = noticed_in(copy, fault, place) if place else None
            what = "gone" if place is None else "noticed" if by else "SURVIVED"
            told[what] += 1
            about = by or f"\n    - {fault.line}\n    + {fault.changed}"
            print(f"{what:9} {fault.file} {fault.function}: {about}", flush=True)
    print(told)
    return 1 if told["noticed"] < LEAST_SHARE * (len(faults) - told["gone"]) else 0


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
    listed = subprocess.check_output(["git", "ls-files", "-z"], cwd=PROJECT, text=True)
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


def noticed_in(copy: Path, fault: Fault, place: Place) -> str | None:
    """Plant a fault, and name the first test that fails with it and passes without it."""
    text = (copy / place.file).read_text("utf-8")
    before = fault.by.partition("::")[0]
    failing: list[str] = []
    for tests in ([before] if before and (copy / before).is_file() else [], WHOLE):
        while tests:
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
