"""Panel of what was done, in which one goes back and forth."""

from functools import partial
from typing import ClassVar

from PySide6.QtCore import QEvent, QModelIndex, QSize, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractItemView, QListView, QVBoxLayout, QWidget

from skinsource_gui.history import History
from skinsource_gui.panel import Panel
from skinsource_gui.panels.history.step_delegate import StepDelegate
from skinsource_gui.panels.history.steps_model import StepsModel
from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.keys import claims_shortcut, meaning_of

_PLACE = "history"


class StepList(QListView):
    """Rows of the history; Enter goes to the one that the keys have reached."""

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, partial(meaning_of, _PLACE)) or super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if meaning_of(_PLACE, event) == "go" and self.currentIndex().isValid():
            self.clicked.emit(self.currentIndex())
        else:
            super().keyPressEvent(event)


class HistoryPanel(Panel):
    """Every step with its label and time; a click goes there."""

    title: ClassVar[str] = "History"
    name: ClassVar[str] = "history"
    lists_history: ClassVar[bool] = True

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.model = StepsModel(self)
        self._delegate = StepDelegate(self)
        self.rows = StepList()
        self.rows.setObjectName("history_rows")
        self.rows.setAccessibleName("Steps of the history")
        self.rows.setModel(self.model)
        self.rows.setItemDelegate(self._delegate)
        self.rows.setUniformItemSizes(True)
        self.rows.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.rows.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.rows.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.rows.clicked.connect(self._go)
        column = QVBoxLayout(self)
        column.setContentsMargins(UNIT_PX, UNIT_PX // 2, UNIT_PX, UNIT_PX // 2)
        column.addWidget(self.rows)
        self.setMinimumSize(204, 120)
        self.setFocusProxy(self.rows)

    def sizeHint(self) -> QSize:
        return QSize(260, 320)

    def show_history(self, history: History) -> None:
        if history == self.model.history:
            return
        self.model.show_history(history)
        present = self.model.index(history.present)
        self.rows.setCurrentIndex(present)
        self.rows.scrollTo(present)

    def _go(self, row: QModelIndex) -> None:
        if row.row() != self.model.history.present:
            self.step_wanted.emit(row.row())
