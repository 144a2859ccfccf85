"""The library: listed, searched, drawn."""

from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.design.presets.shipped import SHIPPED
from tests.gui.library.bench import KEY, names


def test_every_shipped_preset_is_listed_and_drawn(window, panel):
    assert set(names(panel)) == {preset.name for preset in SHIPPED}
    for row in range(panel.model.rowCount()):
        panel.rows.go_to(row)
        assert panel.preview.strip.message == ""
        assert panel.preview.preset.name in panel.preview.text.text()
        assert panel.preview.preset.name == panel.model.index(row).data()


def test_a_hidden_panel_reads_no_file(window):
    panel = window.panel("library")
    assert panel.model.rowCount() == 0
    assert panel.folders.entries == ()


def test_words_and_tags_narrow_the_list(window, panel):
    QTest.keyClicks(panel.search.line, "contracting equal")
    assert names(panel) == ["Contracting train, equal energy"]
    QTest.keyClick(panel.search.line, KEY.Key_Escape)
    assert len(names(panel)) == len(SHIPPED)
    panel.search.tags.setCurrentText("flutter")
    assert names(panel) == ["Tone 30 Hz"]
    panel.search.line.setText("noise")
    assert names(panel) == []
    assert panel.preview.isHidden()
    assert not panel.buttons.place.isEnabled()


def test_the_pointer_shows_what_it_is_over_and_leaving_shows_the_chosen_one(window, panel):
    panel.rows.go_to(0)
    other = panel.model.index(2)
    at = QPointF(panel.rows.visualRect(other).center())
    none, keys = Qt.MouseButton.NoButton, Qt.KeyboardModifier.NoModifier
    port = panel.rows.viewport()
    over = QMouseEvent(QEvent.Type.MouseMove, at, port.mapToGlobal(at), none, none, keys)
    QApplication.sendEvent(port, over)
    assert panel.preview.preset.name == other.data()
    assert panel.rows.currentIndex().row() == 0
    QApplication.sendEvent(panel.rows, QEvent(QEvent.Type.Leave))
    assert panel.preview.preset.name == panel.model.index(0).data()
