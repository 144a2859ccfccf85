"""Words to search for, and a tag."""

from collections.abc import Iterable

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QWidget

from skinsource_gui.widgets.fields.drop_down import DropDown
from skinsource_gui.widgets.keys import KEYS

_ALL = "All tags"


class SearchRow(QWidget):
    """A line to type in, and the tags that there are."""

    changed = Signal()
    #: Enter was pressed; Down was pressed.
    accepted = Signal()
    left_downwards = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.line, self.tags = QLineEdit(), DropDown()
        self.line.setObjectName("preset_search")
        self.line.setPlaceholderText("Search")
        self.line.setAccessibleName("Search presets")
        self.line.setToolTip(
            "Words of the name, tags, description or source; "
            f"{KEYS['library'].gestures['place'].shown} places"
        )
        self.line.setClearButtonEnabled(True)
        self.line.textChanged.connect(self.changed)
        self.line.returnPressed.connect(self.accepted)
        self.line.installEventFilter(self)
        self.tags.setObjectName("preset_tags")
        self.tags.setAccessibleName("Tag")
        self.tags.setToolTip("Only presets with this tag")
        self.tags.addItem(_ALL)
        self.tags.currentIndexChanged.connect(self.changed)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.line, 3)
        row.addWidget(self.tags, 2)

    @property
    def words(self) -> str:
        """What is searched for."""
        return self.line.text()

    @property
    def tag(self) -> str:
        """The tag that is chosen, or ""."""
        return self.tags.currentText() if self.tags.currentIndex() > 0 else ""

    def show_tags(self, tags: Iterable[str]) -> None:
        """Offer these; the chosen one stays, if it is among them."""
        offered, chosen = [_ALL, *sorted(set(tags), key=str.casefold)], self.tag
        if offered == [self.tags.itemText(k) for k in range(self.tags.count())]:
            return
        self.tags.blockSignals(True)
        self.tags.clear()
        self.tags.addItems(offered)
        self.tags.setCurrentIndex(offered.index(chosen, 1) if chosen in offered[1:] else 0)
        self.tags.blockSignals(False)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.KeyPress and isinstance(event, QKeyEvent):
            if event.key() == Qt.Key.Key_Down:
                self.left_downwards.emit()
                return True
            if event.key() == Qt.Key.Key_Escape and self.words:
                self.line.clear()
                return True
        return super().eventFilter(watched, event)
