"""Work for a page: away from the GUI thread, and only what is wanted last."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from threading import Event, Lock
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

from skinsource.base.errors import SkinSourceError, Stopped

#: Does something in the worker thread; may raise `Stopped` once it is `LatestWins.outdated`.
Work = Callable[[], None]


class LatestWins(QObject):
    """Does one thing at a time; what is wanted meanwhile takes the place of what was wanted before.

    Parameters
    ----------
    name
        Of the thread.
    """

    #: What was wanted, and a sentence that says why it cannot be had.
    failed = Signal(object, str)
    _told = Signal(object, object)  # from the worker thread: a signal and its arguments

    def __init__(self, name: str, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._pool = ThreadPoolExecutor(1, thread_name_prefix=name)
        self._lock = Lock()
        self._wanted: tuple[object, Work] | None = None
        self._besides: Work | None = None
        self._working = False
        self._closed = Event()
        self._told.connect(self._tell, Qt.ConnectionType.QueuedConnection)

    @property
    def busy(self) -> bool:
        """Whether something is wanted that is not there yet."""
        with self._lock:
            return self._working

    @property
    def closed(self) -> bool:
        """Whether nobody wants anything any more."""
        return self._closed.is_set()

    @property
    def outdated(self) -> bool:
        """Whether what is being done is not what is wanted last."""
        return self.closed or self._wanted is not None

    def want(self, subject: object, work: Work) -> None:
        """Do ``work``, instead of whatever was wanted before; ``failed`` names the ``subject``."""
        with self._lock:
            self._wanted = subject, work
        self._begin()

    def want_besides(self, work: Work) -> None:
        """Do ``work`` once nothing else is wanted; what stops it begins it anew later."""
        with self._lock:
            self._besides = work
        self._begin()

    def tell(self, signal: Any, *arguments: object) -> None:
        """Emit a signal in the thread of the window, unless this is closed by then."""
        self._told.emit(signal, arguments)

    def close(self) -> None:
        """Give up what is being done, and wait until it has ended."""
        self._closed.set()
        self._pool.shutdown(wait=True)

    def _begin(self) -> None:
        with self._lock:
            if self._working or self.closed:
                return
            self._working = True
        self._pool.submit(self._work)

    def _tell(self, signal: Any, arguments: tuple[Any, ...]) -> None:
        if not self.closed:
            signal.emit(*arguments)

    def _work(self) -> None:
        """Do what is wanted until nothing is."""
        while True:
            with self._lock:
                wanted, self._wanted = self._wanted, None
                besides = self._besides
                if (wanted is None and besides is None) or self.closed:
                    self._working = False
                    return
            subject, work = wanted if wanted is not None else (None, besides)
            try:
                if work is not None:
                    work()
            except Stopped:
                continue
            except Exception as error:  # noqa: BLE001  shown to the user
                self.tell(self.failed, subject, _sentence(error))
            with self._lock:
                if wanted is None and self._besides is besides:
                    self._besides = None


def _sentence(error: Exception) -> str:
    if isinstance(error, SkinSourceError):
        return str(error)
    return f"The studio made a mistake ({type(error).__name__}: {error}). Please report this."
