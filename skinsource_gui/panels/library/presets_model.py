"""Presets as rows."""

from typing import Any

from PySide6.QtCore import (
    QAbstractListModel,
    QMimeData,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    Qt,
    QUrl,
    Signal,
)

from skinsource.design.presets.presets import Entry

_Role = Qt.ItemDataRole
#: `Entry`; whether it is the user's own; tags in a line.
ENTRY, OWN, TAGS = (_Role.UserRole + k for k in range(1, 4))

_Index = QModelIndex | QPersistentModelIndex


class PresetsModel(QAbstractListModel):
    """A row for each preset that was found; the user's own can be given other names."""

    #: An `Entry`, and its new name.
    rename_wanted = Signal(object, str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._entries: tuple[tuple[Entry, bool], ...] = ()

    @property
    def entries(self) -> tuple[tuple[Entry, bool], ...]:
        """What is listed, and whether it is the user's own."""
        return self._entries

    def show_entries(self, entries: tuple[tuple[Entry, bool], ...]) -> None:
        """List others."""
        if entries != self._entries:
            self.beginResetModel()
            self._entries = entries
            self.endResetModel()

    def rowCount(self, parent: _Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self._entries)

    def data(self, index: _Index, role: int = _Role.DisplayRole) -> Any:
        if not 0 <= index.row() < len(self._entries):
            return None
        entry, own = self._entries[index.row()]
        preset = entry.preset
        found = {
            _Role.DisplayRole: preset.name,
            _Role.EditRole: preset.name,
            ENTRY: entry,
            OWN: own,
            TAGS: ", ".join(preset.tags),
        }
        if role == _Role.AccessibleTextRole:
            return f"{preset.name}{', your own' if own else ''}, {found[TAGS]}"
        return found.get(role)

    def setData(self, index: _Index, value: Any, role: int = _Role.EditRole) -> bool:
        entry = index.data(ENTRY)
        if role != _Role.EditRole or entry is None or value == entry.preset.name:
            return False
        # What is listed follows from the files.
        self.rename_wanted.emit(entry, str(value))
        return False

    def flags(self, index: _Index) -> Qt.ItemFlag:
        flags = super().flags(index)
        if index.isValid():
            flags |= Qt.ItemFlag.ItemIsDragEnabled
            if index.data(OWN):
                flags |= Qt.ItemFlag.ItemIsEditable
        return flags

    def supportedDragActions(self) -> Qt.DropAction:
        return Qt.DropAction.CopyAction

    def mimeData(self, indexes: Any) -> QMimeData:
        """The files: the window takes them, and so do other programs."""
        data = QMimeData()
        data.setUrls([QUrl.fromLocalFile(str(one.data(ENTRY).path)) for one in indexes])
        return data
