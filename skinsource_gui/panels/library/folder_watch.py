"""Notices that files of a folder change, come or go."""

from pathlib import Path

from PySide6.QtCore import QFileSystemWatcher, QObject, QTimer, Signal

#: Files are written in several steps: what follows this soon is one change.
_TOGETHER_MS = 150


class FolderWatch(QObject):
    """Watches a folder and its files, also one that is not there yet.

    Parameters
    ----------
    suffix
        Files with this ending are watched.
    """

    #: Something has changed; told once for many changes.
    changed = Signal()

    def __init__(self, suffix: str, parent: QObject) -> None:
        super().__init__(parent)
        self._suffix = suffix
        self._watcher: QFileSystemWatcher | None = None
        self._pause = QTimer(self)
        self._pause.setSingleShot(True)
        self._pause.setInterval(_TOGETHER_MS)
        self._pause.timeout.connect(self.changed)

    def watch(self, folder: Path) -> None:
        """Watch ``folder`` and what is in it now, and nothing else."""
        self.rest()
        self._watcher = QFileSystemWatcher(self)
        self._watcher.directoryChanged.connect(self._pause.start)
        self._watcher.fileChanged.connect(self._pause.start)
        try:
            files = [str(path) for path in folder.iterdir() if path.suffix == self._suffix]
            self._watcher.addPaths([str(folder), *files])
        except OSError:
            # What it comes to lie in is watched instead.
            there = next((one for one in folder.parents if one.is_dir()), None)
            if there is not None:
                self._watcher.addPath(str(there))

    def rest(self) -> None:
        """Watch nothing."""
        self._pause.stop()
        if self._watcher is not None:
            self._watcher.deleteLater()
            self._watcher = None
