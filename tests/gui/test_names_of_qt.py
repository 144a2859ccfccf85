"""No attribute of a class of the studio hides what Qt calls by that name."""

import ast
import importlib
import inspect
import textwrap
from pathlib import Path

from PySide6.QtCore import QObject

import skinsource_gui

TOP = Path(skinsource_gui.__file__).parent


def modules():
    for path in sorted(TOP.rglob("*.py")):
        if path.stem != "__main__":
            parts = path.relative_to(TOP.parent).with_suffix("").parts
            yield importlib.import_module(".".join(part for part in parts if part != "__init__"))


def classes():
    for module in modules():
        for _, cls in inspect.getmembers(module, inspect.isclass):
            if cls.__module__ == module.__name__:
                yield cls


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
    assert {name: attributes for name, attributes in hidden.items() if attributes} == {}
