"""No class of the studio has more than fifteen methods of its own, besides what Qt calls."""

import importlib
import inspect
from pathlib import Path
from types import FunctionType

from PySide6.QtCore import QObject

import skinsource_gui

MOST_METHODS = 15
TOP = Path(skinsource_gui.__file__).parent


def modules():
    for path in sorted(TOP.rglob("*.py")):
        if path.stem != "__main__":
            parts = path.relative_to(TOP.parent).with_suffix("").parts
            yield importlib.import_module(".".join(part for part in parts if part != "__init__"))


def classes():
    for module in modules():
        for _, found in inspect.getmembers(module, inspect.isclass):
            if found.__module__ == module.__name__:
                yield found


def own_methods(owner: type) -> set[str]:
    """Functions and properties of a class that no class of Qt among its bases has."""
    of_qt = {name for base in owner.__mro__ if _is_qt(base) for name in vars(base)}
    kinds = (FunctionType, property, classmethod, staticmethod)
    return {
        name
        for name, value in vars(owner).items()
        if isinstance(value, kinds) and name not in of_qt and not name.startswith("__")
    }


def _is_qt(base: type) -> bool:
    return base.__module__.startswith(("PySide6", "Shiboken", "pyqtgraph"))


def test_no_class_of_the_studio_has_too_many_methods_of_its_own():
    found = {owner.__qualname__: len(own_methods(owner)) for owner in classes()}
    assert len(found) > 100
    assert {name: n for name, n in found.items() if n > MOST_METHODS} == {}


def test_what_qt_calls_is_not_counted_and_all_else_is():
    class Some(QObject):
        def __init__(self):
            super().__init__()

        def event(self, event):
            return super().event(event)

        @property
        def size(self):
            return 1

        def _help(self):
            return 2

    assert own_methods(Some) == {"size", "_help"}
