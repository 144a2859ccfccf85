"""What the choices above the panels say of themselves."""

import ast
import re
from pathlib import Path

import pytest
from PySide6.QtCore import Qt

from skinsource.design.labels import CHOICES
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.shell.bars import SetupBar


@pytest.fixture
def bar(qtbot):
    bar = SetupBar()
    qtbot.addWidget(bar)
    return bar


def test_every_choice_and_every_value_of_it_is_explained_in_the_words_of_the_page(bar):
    fields = {field.accessibleName(): field for field in bar.findChildren(ChoiceField)}
    for _, label, sentence, entries in CHOICES:
        field = fields.pop(label)
        assert " ".join(field.toolTip().split()) == f"{label} {sentence}"
        for index, word in enumerate(entries):
            hint = field.itemData(index, Qt.ItemDataRole.ToolTipRole)
            assert (field.itemData(index), field.itemText(index)) == (word.name, word.title)
            assert " ".join(hint.split()) == word.sentence
    assert not fields


def test_no_line_of_a_tooltip_is_longer_than_the_eye_follows(bar):
    for field in bar.findChildren(ChoiceField):
        assert max(map(len, field.toolTip().splitlines())) <= 64


def test_the_studio_speaks_of_sides_as_the_page_of_words_does():
    """Nothing that people read says dorsal, palmar or volar, nor that a skin is heard."""
    texts = [
        (path, node.value)
        for path in (Path(__file__).parents[2] / "skinsource_gui").rglob("*.py")
        for node in _shown_texts(ast.parse(path.read_text("utf-8")))
    ]
    assert len(texts) > 500
    for path, text in texts:
        assert not re.search(r"\b(dorsal|palmar|hear)\b", text, re.IGNORECASE), (path, text)


def _shown_texts(tree):
    """Texts of a module that are no docstrings."""
    docs = {
        id(node.body[0].value)
        for node in ast.walk(tree)
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef)
        and node.body
        and isinstance(node.body[0], ast.Expr)
    }
    return [
        node
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docs
    ]
