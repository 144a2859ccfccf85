"""Benchmarks and examples keep up with the code: they are imported and run."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BENCHMARKS = sorted((ROOT / "benchmarks").glob("*.py"))
IMPORT_ALL = """
import importlib, sys
for name in sys.argv[1:]:
    importlib.import_module(name)
print("all", len(sys.argv) - 1)
"""


def run(*arguments, paths=()):
    python_path = os.pathsep.join(str(path) for path in (ROOT / "core", ROOT, *paths))
    return subprocess.run(
        [sys.executable, *map(str, arguments)],
        capture_output=True,
        text=True,
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": python_path, "QT_QPA_PLATFORM": "offscreen"},
        timeout=300,
    )


def test_every_benchmark_can_be_imported():
    # The one left out speaks when it is imported.
    names = [path.stem for path in BENCHMARKS if path.stem != "start_imports"]
    done = run("-c", IMPORT_ALL, *names, paths=(ROOT / "benchmarks",))
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == f"all {len(names)}"


def test_four_stimuli_are_composed_by_keyboard_alone(tmp_path):
    folders = ("--folder", tmp_path / "pictures")
    done = run(ROOT / "benchmarks" / "compose.py", *folders)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.count("By keyboard: ") == 4
    assert "NOT SO" not in done.stdout


def test_the_window_does_what_its_tutorial_says(tmp_path):
    done = run(ROOT / "benchmarks" / "tutorial.py", "--pictures", tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    pictures = {path.name for path in (ROOT / "docs" / "pictures").iterdir()}
    assert {path.name for path in tmp_path.iterdir()} == pictures
