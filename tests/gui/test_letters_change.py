"""Letters become larger while a panel is open, and nothing else changes."""

import pytest
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QBoxLayout, QGridLayout, QWidget

from skinsource_gui.panels.compare.panel import ComparePanel
from skinsource_gui.panels.perception.panel import PerceptionPanel
from skinsource_gui.panels.playback.panel import DeviceFields, OutputRow
from skinsource_gui.panels.spectrogram.panel import SpectrogramPanel
from skinsource_gui.qt.labels import FittingLabel


def enlarge(widget, scale=2.5):
    font = QFont(widget.font())
    font.setPointSizeF(scale * font.pointSizeF())
    widget.setFont(font)


@pytest.fixture
def host(qtbot):
    widget = QWidget()
    qtbot.addWidget(widget)
    return widget


def test_a_label_says_less_in_the_same_room(host):
    label = FittingLabel(host)
    label.show_phrases(("2 inputs · up to date", "2 inputs"))
    # Polished, it may have other letters.
    host.show()
    label.resize(label.sizeHint())
    assert label.text() == "2 inputs · up to date"
    enlarge(label, 1.6)
    assert label.text() == "2 inputs"


def test_the_row_of_an_output_keeps_room_for_its_number_and_the_longest_level(host):
    row = OutputRow(QGridLayout(host), 0, 7, 1, "synthetic-1")
    host.show()
    for part, inside, text in (
        (row.title, row.title, "7 · …"),
        (row.loudness, row.level, "\u2212100.0 dBFS"),
    ):
        enlarge(inside)
        assert part.minimumSizeHint().width() >= inside.fontMetrics().horizontalAdvance(text)


def fields_of_playback():
    around = QWidget()
    fields = DeviceFields(QGridLayout(around))
    return around, (fields.latency, fields.shift)


def field_of_an_output():
    around = QWidget()
    row = OutputRow(QGridLayout(around), 0, 7, 64, "synthetic-1")
    # It has no parent: its widgets stand in the grid.
    around.row = row
    return around, (row.output,)


def field_of_perception():
    panel = PerceptionPanel()
    return panel, (panel.area,)


def fields_of_the_spectrogram():
    panel = SpectrogramPanel()
    return panel, (panel.floor, panel.ceiling)


@pytest.mark.parametrize(
    "made",
    [fields_of_playback, field_of_an_output, field_of_perception, fields_of_the_spectrogram],
)
def test_a_number_keeps_its_digits(qtbot, made):
    around, fields = made()
    qtbot.addWidget(around)
    around.resize(900, 500)
    around.show()
    for field in fields:
        field.set_value(min(field.spec.maximum, 600.0))
        before = field.text()
        assert before.strip(".…")
        enlarge(field, 2.2)
        # Layouts follow once the event loop runs.
        qtbot.waitUntil(lambda label=field, old_text=before: label.text() == old_text)


def test_the_difference_goes_below_the_cards_where_it_has_no_room_beside_them(qtbot):
    panel = ComparePanel()
    qtbot.addWidget(panel)
    panel.resize(700, 600)
    panel.show()
    ways = QBoxLayout.Direction
    assert panel._halves.direction() == ways.LeftToRight
    enlarge(panel)
    assert panel._halves.direction() == ways.TopToBottom
