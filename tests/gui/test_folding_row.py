"""A row folds alike with a scroll bar beside it and without."""

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QApplication, QScrollArea, QVBoxLayout, QWidget

from skinsource_gui.qt.fitting import FoldingRow


class Part(QWidget):
    def minimumSizeHint(self):
        return QSize(50, 100)


def test_a_scroll_bar_folds_no_row_that_has_room_without_it(qtbot):
    parts = [Part() for _ in range(5)]
    area, inside = QScrollArea(), QWidget()
    column = QVBoxLayout(inside)
    column.setContentsMargins(0, 0, 0, 0)
    column.addWidget(FoldingRow(parts, 4))
    area.setFrameShape(QScrollArea.Shape.NoFrame)
    area.setWidgetResizable(True)
    area.setWidget(inside)
    qtbot.addWidget(area)
    area.resize(268, 60)
    area.show()
    qtbot.waitExposed(area)
    # There and back: what it was before makes no difference.
    for width, height, rows in ((268, 60, 1), (268, 150, 1), (240, 150, 2), (268, 150, 1)):
        area.resize(width, height)
        QApplication.processEvents()
        assert len({part.y() for part in parts}) == rows
        assert area.verticalScrollBar().isVisible() == (rows * 100 > height)
        assert not area.horizontalScrollBar().isVisible()
        assert parts[-1].geometry().right() < area.viewport().width()
