"""What the choices above the panels say of themselves."""

import pytest
from PySide6.QtCore import Qt

from skinsource.design.labels import CHOICES
from skinsource.design.view import View
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.shell.bars import SetupBar
from skinsource_gui.state.document import Document
from skinsource_gui.state.preferences import start_design


@pytest.fixture
def bar(qtbot):
    bar = SetupBar(Document(start_design("synthetic-1")))
    qtbot.addWidget(bar)
    return bar


def test_every_choice_and_every_value_of_it_is_explained_in_the_words_of_the_page(bar):
    fields = {field.accessibleName(): field for field in bar.findChildren(ChoiceField)}
    for _, label, sentence, entries in CHOICES[:1]:
        field = fields.pop(label)
        assert " ".join(field.toolTip().split()) == f"{label} {sentence}"
        for index, word in enumerate(entries):
            hint = field.itemData(index, Qt.ItemDataRole.ToolTipRole)
            assert (field.itemData(index), field.itemText(index)) == (word.name, word.title)
            assert " ".join(hint.split()) == word.sentence
    assert not fields


def test_what_the_measure_line_offers_is_found_by_its_words(bar):
    document, asked = bar._document, []
    for view, enabled in ((View(axes="xyz"), True), (View(axes="z"), False)):
        document.look(view)
        found = {action.text(): action for action in bar.choices(bar)}
        assert found["Method: Magnitude"].isEnabled() == enabled
        for name in ("Levels: Loudest 100 ms", "Axes: x, y"):
            found[name].trigger()
            asked.append((document.view.axes, document.view.span))
    assert asked[:2] == [("xyz", "loudest"), ("xy", "loudest")]
