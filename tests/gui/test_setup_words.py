"""What the choices above the panels say of themselves."""

import pytest
from PySide6.QtCore import Qt

from skinsource.words import CHOICES
from skinsource_gui.shell.setup_bar import SetupBar
from skinsource_gui.widgets.fields.choice_field import ChoiceField


@pytest.fixture
def bar(qtbot):
    bar = SetupBar()
    qtbot.addWidget(bar)
    return bar


def test_every_choice_and_every_value_of_it_is_explained_in_the_words_of_the_page(bar):
    fields = {field.accessibleName(): field for field in bar.findChildren(ChoiceField)}
    for _, label, sentence, words in CHOICES:
        field = fields.pop(label)
        assert " ".join(field.toolTip().split()) == f"{label} {sentence}"
        for index, word in enumerate(words):
            hint = field.itemData(index, Qt.ItemDataRole.ToolTipRole)
            assert (field.itemData(index), field.itemText(index)) == (word.name, word.title)
            assert " ".join(hint.split()) == word.sentence
    assert not fields


def test_no_line_of_a_tooltip_is_longer_than_the_eye_follows(bar):
    for field in bar.findChildren(ChoiceField):
        assert max(map(len, field.toolTip().splitlines())) <= 64
