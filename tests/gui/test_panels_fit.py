"""Panels in narrow and wide docks: results are never cut, and nothing has to scroll sideways."""

from dataclasses import replace

from PySide6 import QtWidgets

from skinsource_gui.panels.analysis.settings import VIEWS
from skinsource_gui.plots.figure import NoteLabel
from skinsource_gui.plots.legend import LegendStrip
from tests.gui.analysis.analysis_bench import analysis

WIDTHS = (300, 420, 680)
OUTPUTS = (29, 30, 33, 35, 38, 52)
ANALYSIS = tuple(view.name for view in VIEWS)
PANELS = (*ANALYSIS, "output")


def room_of(combo):
    option = QtWidgets.QStyleOptionComboBox()
    combo.initStyleOption(option)
    field = QtWidgets.QStyle.SubControl.SC_ComboBoxEditField
    control = QtWidgets.QStyle.ComplexControl.CC_ComboBox
    return combo.style().subControlRect(control, option, field, combo).width()


def cut_texts(panel, but=()):
    """What of the words of a panel is not written, or lies outside; but for those of a kind."""
    cut = []
    visible = [item for item in panel.findChildren(object) if getattr(item, "isVisible", bool)()]
    for widget in visible:
        if isinstance(widget, NoteLabel):
            if widget.text() != widget.whole or widget.height() < widget.heightForWidth(
                widget.width()
            ):
                cut.append(widget.whole)
        elif isinstance(widget, QtWidgets.QComboBox) and widget.objectName() != "actuator_field":
            if widget.fontMetrics().horizontalAdvance(widget.currentText()) > room_of(widget):
                cut.append(widget.currentText())
        elif isinstance(widget, QtWidgets.QLabel) and not isinstance(widget, but):
            needed = (
                widget.heightForWidth(widget.width())
                if widget.wordWrap()
                else widget.sizeHint().height()
            )
            wide = 0 if widget.wordWrap() else widget.sizeHint().width()
            if wide > widget.width() or needed > widget.height() + 1:
                cut.append(widget.text())
        elif isinstance(widget, QtWidgets.QAbstractButton):
            if widget.fontMetrics().horizontalAdvance(widget.text()) > max(widget.width(), 1):
                cut.append(widget.text())
        elif isinstance(widget, QtWidgets.QTableView):
            cut += cut_cells(widget)
        elif isinstance(widget, LegendStrip) and widget.text.named:
            x, line = widget.text_layout.lines()[-1]
            if widget.height() < (line + 1) * widget.fontMetrics().height() or x > widget.width():
                cut.append(widget.text.lines())
    return cut


def cut_cells(table):
    cut = ["scrolls sideways"] if table.horizontalScrollBar().maximum() else []
    model, header = table.model(), table.horizontalHeader()
    for column in range(model.columnCount()):
        width = header.sectionSize(column)
        for row in range(model.rowCount()):
            index = model.index(row, column)
            text = str(index.data())
            # Names are elided, but not the numbers with which they begin.
            number, _, name = text.partition("  ")
            text = f"{number}…" if name else text
            if table.fontMetrics().horizontalAdvance(text) > width:
                cut.append(text)
    return cut


def test_no_result_is_cut_in_a_dock_of_any_width(window, settle, qtbot):
    window.document.look(replace(window.document.view, outputs=OUTPUTS))
    cut = {}
    for name in PANELS:
        if name in ANALYSIS:
            panel, dock = analysis(window, name), window.docks["analysis"]
        else:
            panel, dock = window.panel(name), window.docks[name]
            dock.bring_forward()
        dock.setFloating(True)
        settle()
        if name == "regions":
            qtbot.waitUntil(lambda shown=panel: len(shown.columns) == 6, timeout=60_000)
        for width in WIDTHS:
            dock.resize(width, 460)
            # A height that follows from a width, and what stands below it, take several turns.
            for _ in range(4):
                QtWidgets.QApplication.processEvents()
            assert panel.width() <= width, name
            texts = cut_texts(panel)
            if name == "statistics":
                # Names yield to numbers, and only where they have to.
                whole = panel.table.fontMetrics().horizontalAdvance("29  II nail rad.")
                assert (panel.table.columnWidth(0) < whole) == (width == 300)
            if dock.widget().horizontalScrollBar().maximum():
                texts.append("the dock scrolls sideways")
            if texts:
                cut[name, width] = texts
        dock.setFloating(False)
        dock.hide()
    assert cut == {}


def test_words_take_lines_keep_them_while_read_and_count_what_does_not_fit(qtbot):
    label = NoteLabel("words")
    qtbot.addWidget(label)
    line = label.heightForWidth(1000)
    label.resize(200, line)
    label.say("first · second")
    assert label.heightForWidth(200) == line
    label.say(" · ".join(f"{number}: −20.1, 0.97" for number in range(6)), holding=True)
    high = label.heightForWidth(200)
    assert high > 2 * line
    assert label.text() == label.whole
    label.say("read", holding=True)
    assert label.heightForWidth(200) == high
    label.say("found")
    assert label.heightForWidth(200) == line
    label.say(" · ".join(f"{number}: −20.1, 0.97" for number in range(72)))
    shown, _, more = label.text().rpartition(" · +")
    assert label.whole.startswith(shown)
    assert len(shown.split(" · ")) + int(more) == 72
    assert label.toolTip() == label.whole
