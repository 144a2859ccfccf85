"""No attribute of a class of the studio hides what Qt calls by that name."""

import ast
import importlib
from pathlib import Path

import skinsource_gui

TOP = Path(skinsource_gui.__file__).parent
OF_QT = ("PySide6", "Shiboken", "pyqtgraph")


def set_attributes(definition: ast.ClassDef) -> set[str]:
    """Names that methods of a class set on ``self``."""
    return {
        node.attr
        for node in ast.walk(definition)
        if isinstance(node, ast.Attribute)
        and isinstance(node.ctx, ast.Store)
        and isinstance(node.value, ast.Name)
        and node.value.id == "self"
    }


def test_no_attribute_hides_what_qt_calls_by_its_name():
    sample = ast.parse(
        "class Some:\n    def __init__(self):\n        self.mine, self.parent = 1, 2"
    )
    assert set_attributes(sample.body[0]) == {"mine", "parent"}
    hidden, n_classes = {}, 0
    for path in sorted(TOP.rglob("*.py")):
        definitions = [
            node for node in ast.parse(path.read_text()).body if isinstance(node, ast.ClassDef)
        ]
        if path.stem == "__main__" or not definitions:
            continue
        parts = path.relative_to(TOP.parent).with_suffix("").parts
        module = importlib.import_module(".".join(part for part in parts if part != "__init__"))
        for definition in definitions:
            owner = getattr(module, definition.name)
            bases = [base for base in owner.__mro__ if base.__module__.startswith(OF_QT)]
            n_classes += bool(bases)
            for base in bases:
                if names := set_attributes(definition) & set(vars(base)):
                    hidden[owner.__qualname__] = names
    assert n_classes > 100
    assert hidden == {}
