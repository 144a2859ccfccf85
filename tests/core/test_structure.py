"""Sizes of folders of library and studio and of classes of the library, read from their text."""

import ast
from collections import Counter
from pathlib import Path

TOP = Path(__file__).parents[2]
PACKAGES = (TOP / "core" / "skinsource", TOP / "skinsource_gui")
MOST_FILES, MOST_METHODS = 30, 15

FILES = [path for package in PACKAGES for path in sorted(package.rglob("*.py"))]


def trees():
    for path in FILES:
        text = path.read_text()
        yield path.relative_to(TOP), text, ast.parse(text)


def methods_of(owner: ast.ClassDef) -> list[str]:
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef)
    names = [part.name for part in owner.body if isinstance(part, kinds)]
    return [name for name in names if not name.startswith("__")]


def test_no_folder_holds_more_files_than_one_can_look_through():
    assert len(FILES) > 300
    in_folder = Counter(path.parent.relative_to(TOP) for path in FILES)
    assert {folder: n for folder, n in in_folder.items() if n > MOST_FILES} == {}


def test_no_class_of_the_library_has_more_than_fifteen_methods():
    classes = [
        node
        for path, _, tree in trees()
        if path.parts[0] == "core"
        for node in ast.walk(tree)
        if isinstance(node, ast.ClassDef)
    ]
    large = [node.name for node in classes if len(methods_of(node)) > MOST_METHODS]
    assert large == []
