"""The list of presets."""

from functools import partial

from PySide6.QtCore import (
    QEvent,
    QModelIndex,
    QPersistentModelIndex,
    QPoint,
    QRect,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import QColor, QDrag, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPixmap
from PySide6.QtWidgets import QAbstractItemView, QListView, QWidget

from skinsource.design.presets.presets import Entry
from skinsource_gui.panels.library.preset_delegate import PresetDelegate
from skinsource_gui.panels.library.presets_model import ENTRY, OWN, PresetsModel
from skinsource_gui.theme import UNIT_PX, current_theme
from skinsource_gui.widgets.keys import claims_shortcut, meaning_of

_PLACE = "library"
# How far from the pointer a dragged preset is shown, and how wide its name may be.
_ASIDE_PX, _WIDEST_TAG_PX = 14, 180


class PresetList(QListView):
    """Rows that are looked at by pointer or keys, dragged away, and placed."""

    #: An `Entry`.
    place_wanted = Signal(object)
    delete_wanted = Signal(object)
    search_wanted = Signal()
    #: The `Entry` under the pointer, else the one that the keys have reached, or None.
    looked_at = Signal(object)

    def __init__(self, model: PresetsModel, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._words = ""
        self._under: Entry | None = None
        self._delegate = PresetDelegate(self)
        self.setObjectName("preset_rows")
        self.setAccessibleName("Presets")
        self.setModel(model)
        self.setItemDelegate(self._delegate)
        self.setUniformItemSizes(True)
        self.setMouseTracking(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setDragEnabled(True)
        self.setDragDropMode(QAbstractItemView.DragDropMode.DragOnly)
        self.setDefaultDropAction(Qt.DropAction.CopyAction)
        self.doubleClicked.connect(self._place)

    @property
    def current(self) -> Entry | None:
        """The one that the keys have reached."""
        return self.currentIndex().data(ENTRY)

    @property
    def current_is_own(self) -> bool:
        """Whether it is the user's."""
        return bool(self.currentIndex().data(OWN))

    def show_words(self, words: str) -> None:
        """Say why there are no rows."""
        self._words = words
        self.viewport().update()

    def go_to(self, row: int) -> None:
        """Let the keys be at this row."""
        self.setCurrentIndex(self.model().index(row, 0))

    def rename(self) -> None:
        """Let the user type another name, where it is the user's own."""
        if self.current_is_own:
            self.edit(self.currentIndex())

    def startDrag(self, actions: Qt.DropAction) -> None:
        chosen = self.selectedIndexes()
        if chosen:
            drag = QDrag(self)
            drag.setMimeData(self.model().mimeData(chosen))
            drag.setPixmap(self._tag(str(chosen[0].data())))
            # Beside the pointer: below it lies what it is dragged to.
            drag.setHotSpot(QPoint(-_ASIDE_PX, -_ASIDE_PX))
            drag.exec(actions, Qt.DropAction.CopyAction)

    def _tag(self, name: str) -> QPixmap:
        """A small label with a name on it."""
        metrics, ratio = self.fontMetrics(), self.devicePixelRatioF()
        words = metrics.elidedText(name, Qt.TextElideMode.ElideRight, _WIDEST_TAG_PX)
        size = QSize(metrics.horizontalAdvance(words) + 2 * UNIT_PX, metrics.height() + UNIT_PX)
        tag = QPixmap(size * ratio)
        tag.setDevicePixelRatio(ratio)
        tag.fill(QColor(current_theme().accent))
        painter = QPainter(tag)
        painter.setFont(self.font())
        painter.setPen(QColor(current_theme().on_accent))
        painter.drawText(QRect(QPoint(), size), Qt.AlignmentFlag.AlignCenter, words)
        painter.end()
        return tag

    def currentChanged(
        self,
        current: QModelIndex | QPersistentModelIndex,
        previous: QModelIndex | QPersistentModelIndex,
    ) -> None:
        super().currentChanged(current, previous)
        self._under = None
        self.looked_at.emit(self.current)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        super().mouseMoveEvent(event)
        self._look(self.indexAt(event.position().toPoint()).data(ENTRY))

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self._look(None)

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, partial(meaning_of, _PLACE)) or super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        name, entry = meaning_of(_PLACE, event), self.current
        if name == "search":
            self.search_wanted.emit()
        elif name == "rename":
            self.rename()
        elif name in ("place", "remove"):
            wanted = self.place_wanted if name == "place" else self.delete_wanted
            if entry is not None and (name == "place" or self.current_is_own):
                wanted.emit(entry)
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        super().paintEvent(event)
        if self.model().rowCount() == 0 and self._words:
            painter = QPainter(self.viewport())
            painter.setPen(QColor(current_theme().dim))
            room = self.viewport().rect().adjusted(UNIT_PX, UNIT_PX, -UNIT_PX, -UNIT_PX)
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(room, flags, self._words)

    def _place(self, index: QModelIndex) -> None:
        self.place_wanted.emit(index.data(ENTRY))

    def _look(self, under: Entry | None) -> None:
        if under != self._under:
            self._under = under
            self.looked_at.emit(under or self.current)
