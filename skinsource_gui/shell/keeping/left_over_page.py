"""The page on unsaved work that earlier studios left."""

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QIcon, QPixmap
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QLabel,
    QListWidget,
    QListWidgetItem,
    QVBoxLayout,
    QWidget,
)

from skinsource.base.files import named
from skinsource.design.recovery import LeftOver

_ICON = QSize(60, 90)
_ROLE = QDialogButtonBox.ButtonRole


def picture_of(left: LeftOver) -> QPixmap:
    """What the work looked like; empty where nobody knows."""
    picture = QPixmap()
    # The stubs of PySide ask for bytes, which it does not take.
    loaded: Any = picture
    loaded.loadFromData(left.picture(), "PNG")
    if picture.isNull():
        return picture
    keep, smooth = Qt.AspectRatioMode.KeepAspectRatio, Qt.TransformationMode.SmoothTransformation
    return picture.scaled(_ICON, keep, smooth)


def words_of(left: LeftOver) -> str:
    """What is known of it, in two lines."""
    where = named(left.file) if left.file else "never saved under a name"
    return f"{left.name}, kept {left.age()}\n{where}"


class LeftOverPage(QDialog):
    """Lists left-over work with its picture and age, to be opened or discarded.

    Parameters
    ----------
    look
        Gives what there is.
    open_it, discard
        Do it with one of them.
    parent
        In front of which the page opens.
    """

    def __init__(
        self,
        look: Callable[[], tuple[LeftOver, ...]],
        open_it: Callable[[LeftOver], None],
        discard: Callable[[LeftOver], None],
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle("Unsaved work of earlier sessions")
        self.resize(560, 420)
        self._look, self._open_it, self._discard = look, open_it, discard
        self._left: tuple[LeftOver, ...] = ()
        self._words = QLabel()
        self._words.setWordWrap(True)
        self.rows = QListWidget()
        self.rows.setObjectName("left_over_rows")
        self.rows.setAccessibleName("Unsaved work")
        self.rows.setIconSize(_ICON)
        self.rows.itemActivated.connect(self._open)
        self.rows.currentRowChanged.connect(self._follow)
        buttons = QDialogButtonBox()
        self.open_button = buttons.addButton("Open it", _ROLE.ActionRole)
        self.discard_button = buttons.addButton("Discard it", _ROLE.DestructiveRole)
        buttons.addButton(QDialogButtonBox.StandardButton.Close)
        self.open_button.clicked.connect(self._open)
        self.discard_button.clicked.connect(self._give_up)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        for part in (self._words, self.rows, buttons):
            layout.addWidget(part)
        self._fill()

    def _fill(self) -> None:
        self._left = self._look()
        self._words.setText(
            "The studio ended before this work was saved. A copy of each was kept."
            if self._left
            else "There is no unsaved work of earlier sessions."
        )
        self.rows.clear()
        for left in self._left:
            item = QListWidgetItem(QIcon(picture_of(left)), words_of(left))
            item.setSizeHint(_ICON + QSize(0, 12))
            self.rows.addItem(item)
        self.rows.setCurrentRow(0 if self._left else -1)
        self._follow()

    def _follow(self) -> None:
        chosen = 0 <= self.rows.currentRow() < len(self._left)
        self.open_button.setEnabled(chosen)
        self.discard_button.setEnabled(chosen)

    def _open(self) -> None:
        left = self._left[self.rows.currentRow()]
        self.accept()
        self._open_it(left)

    def _give_up(self) -> None:
        self._discard(self._left[self.rows.currentRow()])
        self._fill()
