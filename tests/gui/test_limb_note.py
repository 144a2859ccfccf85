"""What the status bar says of a limb has room for all of its letters."""

from types import SimpleNamespace

import pytest
from PySide6.QtGui import QTextDocument

from skinsource_gui.qt.theme import scaled
from skinsource_gui.shell.limb_note import LimbNote


@pytest.mark.parametrize("scale", [1.0, 2.0, 3.0])
def test_a_limb_that_is_not_verified_is_said_to_be_so_in_whole_words(qtbot, scale):
    note, written = LimbNote(), QTextDocument()
    qtbot.addWidget(note)
    note.setFont(scaled(note.font(), scale))
    note.show_limb("measured-1")
    limb = SimpleNamespace(note="made from files that are not the published ones.")
    note.show_outcome(SimpleNamespace(values={"limb_data": limb}))
    written.setDefaultFont(note.font())
    written.setDocumentMargin(0)
    least, preferred = note.minimumSizeHint().width(), note.sizeHint().width()
    for width in (least, (least + preferred) // 2, preferred):
        note.resize(width, note.sizeHint().height())
        written.setHtml(note.text())
        assert written.idealWidth() <= width
        whole = "NOT VERIFIED AS PUBLISHED" if width == preferred else "NOT VERIFIED"
        assert written.toPlainText() == whole
