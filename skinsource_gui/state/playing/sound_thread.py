"""One thread for all that may wait for a device."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

from skinsource.errors import SkinSourceError

#: Told the result, or the error where there is none.
Then = Callable[[Any, SkinSourceError | None], None]


class SoundThread(QObject):
    """Carries out what it is given, in order, and tells in the GUI thread what came of it."""

    _landed = Signal(object, object, object)  # from the thread

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        # No thread before there is something to do.
        self._worker: ThreadPoolExecutor | None = None
        self._ended = False
        self._landed.connect(self._land, Qt.ConnectionType.QueuedConnection)

    def do(self, work: Callable[[], Any], then: Then) -> None:
        """Carry out ``work``, then tell ``then``; nothing any more once it has ended."""
        if self._ended:
            return
        if self._worker is None:
            self._worker = ThreadPoolExecutor(1, thread_name_prefix="skinsource-sound")
        self._worker.submit(self._work, work, then)

    def end(self, last: Callable[[], Any]) -> None:
        """Carry out ``last``, wait for it, and tell nobody anything more."""
        if self._ended:
            return
        self._ended = True
        self._landed.disconnect(self._land)
        if self._worker is not None:
            self._worker.submit(last)
            self._worker.shutdown(wait=True)
            self._worker = None

    def _work(self, work: Callable[[], Any], then: Then) -> None:
        try:
            self._landed.emit(then, work(), None)
        except SkinSourceError as error:
            self._landed.emit(then, None, error)

    def _land(self, then: Then, result: Any, error: SkinSourceError | None) -> None:
        then(result, error)
