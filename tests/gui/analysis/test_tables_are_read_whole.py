"""Names in tables are cut where they must be, and never below their letters."""

import pytest
from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QStyleOptionViewItem, QTableWidget, QTableWidgetItem

from skinsource_gui.panels.regions.panel import RegionTable
from skinsource_gui.qt.labels import SHORT_NAME, NameDelegate, fit_name_column, set_table_look


@pytest.fixture
def table(qtbot):
    table = QTableWidget(2, 1)
    qtbot.addWidget(table)
    set_table_look(table)
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
        table.fit_font(size)
        rows = table.verticalHeader()
        for row in range(rows.count()):
            item = table.verticalHeaderItem(row)
            assert item.font() == table.font()
            assert table.rowHeight(row) > QFontMetrics(item.font()).height() + 2
            assert table.rowHeight(row) > rows.sectionSizeFromContents(row).height()
        assert table.model().headerData(0, Qt.Orientation.Vertical) == "Digit I"


@pytest.fixture
def figures(qtbot):
    """A table of names and of one number each, as wide as it is made."""
    table = QTableWidget(2, 2)
    qtbot.addWidget(table)
    set_table_look(table)
    fit_name_column(table)
    for row, name in enumerate(("8  hand V", "12  IV middle ulnar")):
        table.setItem(row, 0, QTableWidgetItem(name))
        table.setItem(row, 1, QTableWidgetItem("0.123"))
    table.resize(900, 200)
    table.show()
    qtbot.waitExposed(table)
    return table


def test_numbers_stand_beside_the_names_however_wide_a_table_is(figures, qtbot):
    header, longest = figures.horizontalHeader(), "12  IV middle ulnar"
    needed = figures.fontMetrics().horizontalAdvance(longest)
    qtbot.waitUntil(lambda: needed < header.sectionSize(0) < needed + 40)
    figures.item(0, 0).setText("29  a name that is a good deal longer than the others")
    more = figures.fontMetrics().horizontalAdvance(figures.item(0, 0).text())
    qtbot.waitUntil(lambda: more < header.sectionSize(0) < more + 40)


def test_where_there_is_little_room_names_take_what_numbers_leave(figures, qtbot):
    header = figures.horizontalHeader()
    figures.resize(160, 200)
    qtbot.waitUntil(lambda: header.length() == figures.viewport().width())
    assert header.sectionSize(0) == figures.viewport().width() - header.sectionSize(1)
    # What is filled anew, as often as one likes, is so too.
    for _ in range(3):
        fit_name_column(figures)
    figures.resize(900, 200)
    qtbot.waitUntil(lambda: header.length() < 400)
