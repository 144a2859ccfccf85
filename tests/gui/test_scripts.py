"""Benchmarks and examples keep up with the code: they are imported and run."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BENCHMARKS = sorted((ROOT / "benchmarks").glob("*.py"))
IMPORT_ALL = """
import importlib, sys
for name in sys.argv[1:]:
    importlib.import_module(name)
print("all", len(sys.argv) - 1)
"""
#: Of all in one process: to import the studio takes longer than to explain a benchmark.
EXPLAIN_ALL = """
import runpy, sys
for path in sys.argv[1:]:
    sys.argv[:] = [path, "--help"]
    try:
        runpy.run_path(path, run_name="__main__")
    except SystemExit as end:
        print("ended", end.code)
"""


def run(*arguments, paths=(), folder=ROOT):
    python_path = os.pathsep.join(str(path) for path in (ROOT / "core", ROOT, *paths))
    return subprocess.run(
        [sys.executable, *map(str, arguments)],
        capture_output=True,
        text=True,
        cwd=folder,
        env={**os.environ, "PYTHONPATH": python_path, "QT_QPA_PLATFORM": "offscreen"},
        timeout=300,
    )


def test_every_benchmark_can_be_imported():
    # The one left out speaks when it is imported.
    names = [path.stem for path in BENCHMARKS if path.stem != "start_imports"]
    done = run("-c", IMPORT_ALL, *names, paths=(ROOT / "benchmarks",))
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == f"all {len(names)}"


SPEAKING = ("compose", "many_edits", "engine_speed", "growth", "start")


def test_benchmarks_explain_themselves():
    paths = [ROOT / "benchmarks" / f"{name}.py" for name in SPEAKING]
    done = run("-c", EXPLAIN_ALL, *paths, paths=(ROOT / "benchmarks",))
    assert done.returncode == 0, done.stderr
    *outputs, rest = done.stdout.split("ended 0\n")
    assert rest == ""
    for path, usage in zip(paths, outputs, strict=True):
        assert usage.startswith(f"usage: {path.name} "), usage


@pytest.mark.parametrize("by", ["mouse", "keyboard"])
def test_four_stimuli_are_composed_by_mouse_alone_and_by_keyboard_alone(by, tmp_path):
    folders = ("--folder", tmp_path / "pictures")
    done = run(ROOT / "benchmarks" / "compose.py", "--by", by, *folders)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.count(f"By {by}: ") == 4
    assert "NOT SO" not in done.stdout


def test_the_watch_on_the_start_of_the_studio_sees_it_painted():
    done = run(ROOT / "benchmarks" / "start_watch.py", paths=(ROOT / "benchmarks",))
    assert done.returncode == 0, done.stderr
    noted = json.loads(done.stdout)
    assert noted["painted"] < noted["complete"]
