"""The presets that there are: those of the user, and those that are shipped."""

from pathlib import Path

from PySide6.QtCore import QObject, Signal

from skinsource.base.errors import SkinSourceError
from skinsource.design.presets import presets
from skinsource.design.presets.presets import Entry, Fault, Shelf
from skinsource_gui.panels.library.folder_watch import FolderWatch


class Shelves(QObject):
    """Reads both folders, and the user's again when it changes; renames and deletes there."""

    changed = Signal()
    #: Why something was not done.
    failed = Signal(str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._shipped: Shelf | None = None
        self._own = Shelf()
        self._watch = FolderWatch(presets.SUFFIX, self)
        self._watch.changed.connect(self.read)

    @property
    def folder(self) -> Path:
        """Where those of the user lie."""
        return presets.users_folder()

    @property
    def entries(self) -> tuple[tuple[Entry, bool], ...]:
        """All of them, the user's own first, and whether they are."""
        shipped = self._shipped or Shelf()
        own = tuple((entry, True) for entry in self._own.entries)
        return (*own, *((entry, False) for entry in shipped.entries))

    @property
    def faults(self) -> tuple[Fault, ...]:
        """What was left out."""
        return (*self._own.faults, *(self._shipped or Shelf()).faults)

    def read(self) -> None:
        """Read them, and watch the user's."""
        if self._shipped is None:
            self._shipped = presets.read_shelf(presets.shipped_folder())
        # Watched before it is read: nothing is missed between.
        self._watch.watch(self.folder)
        self._own = presets.read_shelf(self.folder)
        self.changed.emit()

    def rest(self) -> None:
        """Notice no changes."""
        self._watch.rest()

    def rename(self, entry: Entry, name: str) -> Path:
        """Give a preset of the user another name; returns its file."""
        path = entry.path
        try:
            path = presets.rename_preset(self.folder, path, name)
        except SkinSourceError as error:
            self.failed.emit(str(error))
        self.read()
        return path

    def delete(self, entry: Entry) -> None:
        """Delete a preset of the user."""
        try:
            presets.delete_preset(self.folder, entry.path)
        except SkinSourceError as error:
            self.failed.emit(str(error))
        self.read()
