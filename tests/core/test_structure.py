"""Sizes of folders, files, functions and classes of library and studio, read from their text.

What a class overrides of Qt does not count as its own; `tests/gui/test_structure.py` counts the
classes of the studio, because it takes Qt to know.
"""

import ast
from collections import Counter
from pathlib import Path

import pytest

TOP = Path(__file__).parents[2]
PACKAGES = (TOP / "core" / "skinsource", TOP / "skinsource_gui")
MOST_FILES, MOST_LINES, MOST_FUNCTION_LINES, MOST_METHODS = 30, 300, 60, 15

FILES = [path for package in PACKAGES for path in sorted(package.rglob("*.py"))]


def trees():
    for path in FILES:
        text = path.read_text()
        yield path.relative_to(TOP), text, ast.parse(text)


def lines_of(function) -> int:
    return function.end_lineno - function.lineno + 1


def methods_of(owner: ast.ClassDef) -> list[str]:
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef)
    names = [part.name for part in owner.body if isinstance(part, kinds)]
    return [name for name in names if not name.startswith("__")]


def too_long(tree: ast.AST) -> list[str]:
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef)
    functions = (node for node in ast.walk(tree) if isinstance(node, kinds))
    return [one.name for one in functions if lines_of(one) > MOST_FUNCTION_LINES]


def test_no_folder_holds_more_files_than_one_can_look_through():
    assert len(FILES) > 300
    in_folder = Counter(path.parent.relative_to(TOP) for path in FILES)
    assert {folder: n for folder, n in in_folder.items() if n > MOST_FILES} == {}


def test_no_file_and_no_function_is_longer_than_a_few_screens():
    files = {str(path): text.count("\n") for path, text, _ in trees()}
    assert {path: n for path, n in files.items() if n > MOST_LINES} == {}
    found = [f"{path}: {name}" for path, _, tree in trees() for name in too_long(tree)]
    assert found == []


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


@pytest.mark.parametrize(("n_lines", "found"), [(60, []), (61, ["long_one"])])
def test_a_function_is_counted_from_its_name_to_its_last_line(n_lines, found):
    body = "\n".join(["def long_one():", *["    x = 1"] * (n_lines - 1)])
    assert too_long(ast.parse(body)) == found
