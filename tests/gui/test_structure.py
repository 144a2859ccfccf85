"""No class of the studio has more than fifteen methods of its own, or hides those of Qt."""

import ast
import importlib
import inspect
import textwrap
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
    of_qt = names_of_qt(owner)
    kinds = (FunctionType, property, classmethod, staticmethod)
    return {
        name
        for name, value in vars(owner).items()
        if isinstance(value, kinds) and name not in of_qt and not name.startswith("__")
    }


def names_of_qt(owner: type) -> set[str]:
    return {name for base in owner.__mro__ if _is_qt(base) for name in vars(base)}


def set_attributes(owner: type) -> set[str]:
    """Names that methods of a class set on ``self``."""
    tree = ast.parse(textwrap.dedent(inspect.getsource(owner)))
    return {
        node.attr
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute)
        and isinstance(node.ctx, ast.Store)
        and isinstance(node.value, ast.Name)
        and node.value.id == "self"
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


def test_no_attribute_hides_what_qt_calls_by_its_name():
    class Some(QObject):
        def __init__(self):
            super().__init__()
            self.mine, self.parent = 1, 2

    assert set_attributes(Some) & names_of_qt(Some) == {"parent"}
    of_qt = {owner: names_of_qt(owner) for owner in classes()}
    hidden = {
        owner.__qualname__: set_attributes(owner) & names for owner, names in of_qt.items() if names
    }
    assert len(hidden) > 100
    assert {name: found for name, found in hidden.items() if found} == {}
