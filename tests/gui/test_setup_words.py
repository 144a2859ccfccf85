"""What the choices above the panels say of themselves."""

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
    for name, label, sentence, entries in CHOICES:
        if name == "scaling":  # beside the amplitude
            continue
        field = fields.pop(label)
        assert " ".join(field.toolTip().split()) == f"{label} {sentence}"
        for index, word in enumerate(entries):
            hint = field.itemData(index, Qt.ItemDataRole.ToolTipRole)
            assert (field.itemData(index), field.itemText(index)) == (word.name, word.title)
            assert " ".join(hint.split()) == word.sentence
    assert not fields
