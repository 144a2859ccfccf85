"""The examples in docstrings do what they say."""

import doctest
import importlib
import pkgutil
from pathlib import Path

import pytest

import skinsource

#: Those with examples: to look through one without takes a seventh of a second.
MODULES = [
    name
    for finder, name, _ in pkgutil.walk_packages(skinsource.__path__, "skinsource.")
    if not name.endswith("__main__")
    and ">>>" in Path(finder.find_spec(name, None).origin).read_text("utf-8")
]


@pytest.mark.parametrize("name", ["skinsource", *MODULES])
def test_the_examples_of_a_module_are_true(name):
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_there_are_examples():
    assert doctest.testmod(skinsource).attempted > 5
