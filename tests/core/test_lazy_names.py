"""Packages whose names are imported when they are first asked for."""

import importlib
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
