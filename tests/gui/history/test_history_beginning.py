"""What the history says was before all steps."""

from pathlib import Path

from skinsource.design.view import View
from skinsource_gui.state.document import Document
from skinsource_gui.state.historian import Historian
from skinsource_gui.state.panel import PanelRegistry
from skinsource_gui.state.preferences import start_design


def test_a_design_that_is_saved_under_another_name_was_not_opened_by_that_name(qtbot):
    document = Document(start_design("any"))
    historian = Historian(document, PanelRegistry.of())
    assert historian.history().start == "New design"
    document.mark_saved(Path("b.skinsource"))
    assert historian.history().start == "New design"
    document.start_over(document.design, View(), Path("a.skinsource"))
    document.mark_saved(Path("b.skinsource"))
    assert historian.history().start == "Opened a.skinsource"
    document.start_over(document.design, View(), None)
    assert historian.history().start == "New design"
