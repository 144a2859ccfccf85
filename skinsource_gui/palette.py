"""Finds any action by a few letters of its name."""

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QAction, QKeyEvent
from PySide6.QtWidgets import QDialog, QLineEdit, QListWidget, QListWidgetItem, QVBoxLayout, QWidget


class Palette(QDialog):
    """A list of actions that narrows while one types; Enter runs the marked one."""

    def __init__(self, actions: Sequence[QAction], parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle("Search actions")
        self.setObjectName("palette")
        self.resize(460, 360)
        self._actions = actions
        self.line = QLineEdit()
        self.line.setPlaceholderText("Type a few letters…")
        self.line.setAccessibleName("Search actions")
        self.list = QListWidget()
        self.list.setAccessibleName("Matching actions")
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        layout = QVBoxLayout(self)
        layout.addWidget(self.line)
        layout.addWidget(self.list)
        self.line.textChanged.connect(self._narrow)
        self.line.returnPressed.connect(self._run)
        self.line.installEventFilter(self)
        self.list.itemActivated.connect(self._run)
        self.list.itemClicked.connect(self._run)
        self._narrow("")

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # Up and Down move in the list while the line keeps the keyboard.
        if event.type() == QEvent.Type.KeyPress and isinstance(event, QKeyEvent):
            step = {Qt.Key.Key_Down: 1, Qt.Key.Key_Up: -1}.get(Qt.Key(event.key()))
            if step:
                row = self.list.currentRow() + step
                self.list.setCurrentRow(max(0, min(self.list.count() - 1, row)))
                return True
        return super().eventFilter(watched, event)

    def _narrow(self, letters: str) -> None:
        self.list.clear()
        matching = [(score(letters, action.text()), action) for action in self._actions]
        for rank, action in sorted(matching, key=lambda pair: pair[0] or 0):
            if rank is None or not action.isEnabled():
                continue
            keys = action.shortcut().toString()
            item = QListWidgetItem(f"{action.text()}    {keys}" if keys else action.text())
            item.setToolTip(action.toolTip())
            item.setData(Qt.ItemDataRole.UserRole, action)
            self.list.addItem(item)
        self.list.setCurrentRow(0)

    def _run(self) -> None:
        item = self.list.currentItem()
        if item is not None:
            self.accept()
            item.data(Qt.ItemDataRole.UserRole).trigger()


def score(letters: str, text: str) -> int | None:
    """How far apart ``letters`` stand in ``text``, in this order; None where they do not."""
    place, gaps, lowered = -1, 0, text.lower()
    for letter in letters.lower().replace(" ", ""):
        found = lowered.find(letter, place + 1)
        if found < 0:
            return None
        gaps += found - place - 1
        place = found
    return gaps
