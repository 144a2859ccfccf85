"""The menu of files that were opened or saved lately."""

from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QWidget

from skinsource_gui.files.recent_files import RecentFiles


class RecentMenu(QMenu):
    """Lists the recent files, newest first, each time it is shown."""

    #: The path of the file that was chosen.
    chosen = Signal(object)

    def __init__(self, recent: RecentFiles, parent: QWidget) -> None:
        super().__init__("Open recent", parent)
        self.setObjectName("open_recent")
        self.setToolTipsVisible(True)
        self._recent = recent
        self.aboutToShow.connect(self._fill)
        self.triggered.connect(self._choose)

    def _fill(self) -> None:
        self.clear()
        for path in self._recent.paths:
            entry = self.addAction(path.name)
            entry.setToolTip(str(path))
            entry.setData(str(path))
        if self.isEmpty():
            self.addAction("Nothing opened or saved yet").setEnabled(False)

    def _choose(self, entry: QAction) -> None:
        if entry.data():
            self.chosen.emit(Path(entry.data()))
