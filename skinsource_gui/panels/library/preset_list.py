"""The list of presets."""

from PySide6.QtCore import QEvent, QModelIndex, Qt, Signal
from PySide6.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter
from PySide6.QtWidgets import QAbstractItemView, QListView, QWidget

from skinsource.presets import Entry
from skinsource_gui.panels.library.preset_delegate import PresetDelegate
from skinsource_gui.panels.library.presets_model import ENTRY, OWN, PresetsModel
from skinsource_gui.theme import LIGHT, UNIT_PX, Theme
from skinsource_gui.widgets.key_table import meant

_PLACE = "library"


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
        self._theme, self._words = LIGHT, ""
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

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = self._delegate.theme = theme
        self.viewport().update()

    def go_to(self, row: int) -> None:
        """Let the keys be at this row."""
        self.setCurrentIndex(self.model().index(row, 0))

    def rename(self) -> None:
        """Let the user type another name, where it is the user's own."""
        if self.current_is_own:
            self.edit(self.currentIndex())

    def currentChanged(self, current: QModelIndex, previous: QModelIndex) -> None:
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
        if (
            event.type() == QEvent.Type.ShortcutOverride
            and isinstance(event, QKeyEvent)
            and meant(_PLACE, event)
        ):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        name, entry = meant(_PLACE, event), self.current
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

    def paintEvent(self, event) -> None:
        super().paintEvent(event)
        if self.model().rowCount() == 0 and self._words:
            painter = QPainter(self.viewport())
            painter.setPen(QColor(self._theme.dim))
            room = self.viewport().rect().adjusted(UNIT_PX, UNIT_PX, -UNIT_PX, -UNIT_PX)
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(room, flags, self._words)

    def _place(self, index: QModelIndex) -> None:
        self.place_wanted.emit(index.data(ENTRY))

    def _look(self, under: Entry | None) -> None:
        if under != self._under:
            self._under = under
            self.looked_at.emit(under or self.current)
