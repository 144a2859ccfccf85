"""Benchmarks and examples use names that exist; not asked for before mypy has seen the library."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BENCHMARKS = sorted((ROOT / "benchmarks").glob("*.py"))
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
#: What a renamed thing leads to.  Other complaints are about types that only a run can tell.
RENAMED = re.compile(
    r'error: (Module .* has no attribute .*|Unexpected keyword argument .*|"(Design|View|Input|'
    r"Document|MainWindow|Conductor|PatientEngine|Graph|Limb)\" has no attribute .*|.*"
    r"\[(import-not-found|call-arg)\])"
)


def complaints(*paths):
    pytest.importorskip("mypy")
    options = ("--check-untyped-defs", "--no-error-summary", "--hide-error-context")
    done = subprocess.run(
        [sys.executable, "-m", "mypy", *options, *map(str, paths)],
        capture_output=True,
        text=True,
        cwd=ROOT,
        env={**os.environ, "MYPYPATH": str(ROOT / "benchmarks")},
        timeout=300,
    )
    assert done.returncode in (0, 1), done.stderr
    return [line for line in done.stdout.splitlines() if RENAMED.search(line)]


def test_benchmarks_and_examples_use_only_names_that_exist():
    assert complaints(*BENCHMARKS, *EXAMPLES) == []
