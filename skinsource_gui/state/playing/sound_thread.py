"""One thread for all that may wait for a device."""

import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, wait
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

from skinsource.base.errors import SkinSourceError

_NAME = "skinsource-sound"
#: How long the end waits for a device; one that is stuck may never answer.
LONGEST_END_S = 3.0
#: Told the result, or the error where there is none.
Then = Callable[[Any, SkinSourceError | None], None]


def one_is_stuck() -> bool:
    """Whether a thread still waits for its device, though nobody plays any more."""
    return any(one.name.startswith(_NAME) for one in threading.enumerate())


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
            self._worker = ThreadPoolExecutor(1, thread_name_prefix=_NAME)
        self._worker.submit(self._work, work, then)

    def end(self, last: Callable[[], Any]) -> None:
        """Carry out ``last``, wait for it unless the device is stuck, and tell nobody any more."""
        if self._ended:
            return
        self._ended = True
        self._landed.disconnect(self._land)
        if self._worker is not None:
            ended = wait([self._worker.submit(last)], LONGEST_END_S).done
            self._worker.shutdown(wait=bool(ended))
            self._worker = None

    def _work(self, work: Callable[[], Any], then: Then) -> None:
        try:
            self._landed.emit(then, work(), None)
        except SkinSourceError as error:
            self._landed.emit(then, None, error)

    def _land(self, then: Then, result: Any, error: SkinSourceError | None) -> None:
        then(result, error)
