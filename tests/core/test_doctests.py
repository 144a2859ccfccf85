"""The examples in docstrings do what they say."""

import doctest
import importlib
import pkgutil

import pytest

import skinsource

MODULES = [
    name
    for _, name, _ in pkgutil.walk_packages(skinsource.__path__, "skinsource.")
    if not name.endswith("__main__")
]


@pytest.mark.parametrize("name", ["skinsource", *MODULES])
def test_the_examples_of_a_module_are_true(name):
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_there_are_examples():
    assert doctest.testmod(skinsource).attempted > 5
