"""Packages whose names are imported when they are first asked for."""

import importlib
import subprocess
import sys
from pathlib import Path

import pytest

TOP = Path(__file__).parents[2]
STUBS = [
    path
    for folder in ("core/skinsource", "skinsource_gui")
    for path in sorted((TOP / folder).rglob("__init__.pyi"))
]


def dotted(path: Path) -> str:
    top = TOP / "core" if (TOP / "core") in path.parents else TOP
    return ".".join(path.parent.relative_to(top).parts)


@pytest.mark.parametrize("path", STUBS, ids=dotted)
def test_all_that_a_package_offers_is_there(path):
    package = importlib.import_module(dotted(path))
    assert package.__all__
    for name in package.__all__:
        assert getattr(package, name) is not None
        assert name in dir(package)


def test_the_library_imports_nothing_before_something_is_asked_for():
    probe = "import sys, skinsource; print([m for m in sys.modules if m.startswith('numpy')])"
    done = subprocess.run(
        [sys.executable, "-c", probe], capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout.strip() == "[]"
