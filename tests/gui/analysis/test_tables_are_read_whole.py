"""Names in tables are cut where they must be, and never below their letters."""

import pytest
from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QStyleOptionViewItem, QTableWidget, QTableWidgetItem

from skinsource_gui.panels.regions.table import RegionTable
from skinsource_gui.widgets.name_column import SHORT_NAME, NameDelegate, dress_table


@pytest.fixture
def table(qtbot):
    table = QTableWidget(2, 1)
    qtbot.addWidget(table)
    dress_table(table)
    for row, name in enumerate(("8  hand V", "12  IV middle ulnar")):
        item = QTableWidgetItem(name)
        item.setData(SHORT_NAME, name.split()[0])
        table.setItem(row, 0, item)
    return table


def painted(table, row, width):
    option = QStyleOptionViewItem()
    option.initFrom(table)
    option.rect, option.widget = QRect(0, 0, width, 20), table
    NameDelegate(table).initStyleOption(option, table.model().index(row, 0))
    return option.text


def test_one_long_name_takes_the_place_from_no_other_output(table):
    room = table.fontMetrics().horizontalAdvance("12  IV mid") + 20
    assert painted(table, 0, room) == "8  hand V"
    assert painted(table, 1, room) == "12  IV middle ulnar"  # Qt ends it with dots
    assert painted(table, 1, 30) == "12"
    assert painted(table, 0, 30) == "8"


def test_rows_of_regions_are_as_high_as_their_names(qtbot):
    table = RegionTable("regions", "Regions")
    qtbot.addWidget(table)
    font = table.font()
    font.setPointSizeF(2 * font.pointSizeF())
    for size in (table.font(), font):
        table.fit_words(size)
        rows = table.verticalHeader()
        for row in range(rows.count()):
            item = table.verticalHeaderItem(row)
            assert item.font() == table.font()
            assert table.rowHeight(row) > QFontMetrics(item.font()).height() + 2
            assert table.rowHeight(row) > rows.sectionSizeFromContents(row).height()
        assert table.model().headerData(0, Qt.Orientation.Vertical) == "Digit I"
