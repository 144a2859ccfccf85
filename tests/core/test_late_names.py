"""Packages whose names are imported when they are first asked for."""

import ast
import importlib
import subprocess
import sys
from pathlib import Path

import pytest

import skinsource
from skinsource.design import motions

TOP = Path(__file__).parents[2]
LATE = [
    path
    for folder in ("core/skinsource", "skinsource_gui")
    for path in sorted((TOP / folder).rglob("__init__.py"))
    if "= late_names(" in path.read_text() and path.parent.name != "late"
]


def dotted(path: Path) -> str:
    top = TOP / "core" if (TOP / "core") in path.parents else TOP
    return ".".join(path.parent.relative_to(top).parts)


def typed_and_late(path: Path) -> tuple[dict[str, set[str]], dict[str, set[str]], set[str]]:
    """What a package tells type checkers, what it tells Python, and which modules it names."""
    branch = next(part for part in ast.parse(path.read_text()).body if isinstance(part, ast.If))
    typed: dict[str, set[str]] = {}
    for one in branch.body:
        names = {alias.name for alias in one.names}
        typed.setdefault(one.module.removeprefix(dotted(path)).lstrip("."), set()).update(names)
    call = branch.orelse[0].value
    late = {home: set(names.split()) for home, names in ast.literal_eval(call.args[1]).items()}
    modules = {name for keyword in call.keywords for name in ast.literal_eval(keyword.value)}
    return typed, late, modules


@pytest.mark.parametrize("path", LATE, ids=dotted)
def test_type_checkers_and_python_are_told_the_same_names(path):
    typed, late, modules = typed_and_late(path)
    assert typed.pop("", set()) == modules
    assert typed == late


@pytest.mark.parametrize("path", LATE, ids=dotted)
def test_each_name_is_what_its_module_calls_so_and_no_module_stands_in_its_place(path):
    package = importlib.import_module(dotted(path))
    _, late, modules = typed_and_late(path)
    named = {name for names in late.values() for name in names}
    assert set(package.__all__) >= named | modules
    assert named | modules <= set(dir(package))
    for home, names in late.items():
        module = importlib.import_module(f"{dotted(path)}.{home}")
        for name in names:
            assert getattr(package, name) is getattr(module, name), name
    beside = {one.stem for one in path.parent.iterdir()}
    assert named.isdisjoint(beside)


def test_all_that_the_library_offers_is_there():
    for name in skinsource.__all__:
        assert getattr(skinsource, name) is not None


def test_what_there_is_not_is_said_as_python_says_it():
    with pytest.raises(
        AttributeError, match=r"module 'skinsource.design.motions' has no attribute 'Hop'"
    ):
        motions.Hop  # noqa: B018


def test_a_name_brings_its_own_module_and_no_other():
    probe = (
        "import sys; from skinsource import recordings; recordings.UNITS;"
        "print([m for m in sys.modules if m.startswith('skinsource.design.recordings.')])"
    )
    done = subprocess.run(
        [sys.executable, "-c", probe], capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout.strip() == "['skinsource.readers.units']"
