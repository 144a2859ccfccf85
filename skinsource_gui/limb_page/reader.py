"""Reads what belongs to a limb away from the GUI thread, in child processes with limits."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

from skinsource.base.errors import SkinSourceError
from skinsource.limbs.limb_import import read_points
from skinsource.readers.reading_process import ReadingProcess
from skinsource_gui.limb_page import photograph


class LimbReader(QObject):
    """Looks at responses, and reads outlines and places; one file after another."""

    #: Path, and what the file says: ``header`` and ``arrays``.
    looked = Signal(object, object)
    #: Path, what it is for ("outline", "inputs", "outputs"), and `Points`.
    read = Signal(object, str, object)
    #: Path of a photograph, and the picture, `QImage`.
    pictured = Signal(object, object)
    #: A sentence.
    failed = Signal(str)
    _told = Signal(object, object)  # from the worker thread: a signal and its arguments

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._process = ReadingProcess()
        self._pictures = photograph.reading_process()
        self._pool = ThreadPoolExecutor(1, thread_name_prefix="skinsource-limb")
        self._waiting = 0
        self._told.connect(self._tell, Qt.ConnectionType.QueuedConnection)

    @property
    def busy(self) -> bool:
        """Whether a file is being read."""
        return self._waiting > 0

    def look(self, path: Path) -> None:
        """Find out what a file of responses says."""
        self._do(
            lambda: (
                self.looked,
                (path, self._process.ask(path, {"do": "limb"})["limb"]),
            )
        )

    def read_points(self, path: Path, what: str) -> None:
        """Read an outline, or places."""
        self._do(lambda: (self.read, (path, what, read_points(path, self._process))))

    def read_photograph(self, path: Path) -> None:
        """Read a picture."""
        self._do(lambda: (self.pictured, (path, photograph.read(path, self._pictures))))

    def end(self) -> None:
        """Give up what is being read."""
        self._process.close()
        self._pictures.close()
        self._pool.shutdown(wait=True, cancel_futures=True)

    def _do(self, work: Callable[[], tuple[Any, tuple[Any, ...]]]) -> None:
        self._waiting += 1

        def run() -> None:
            try:
                told = work()
            except SkinSourceError as error:
                told = self.failed, (str(error),)
            self._told.emit(*told)

        self._pool.submit(run)

    def _tell(self, signal: Any, arguments: tuple[Any, ...]) -> None:
        self._waiting -= 1
        signal.emit(*arguments)
