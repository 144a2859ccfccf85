"""Prepares a stimulus for the page: away from the GUI thread, and only what is wanted last."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Event, Lock

from PySide6.QtCore import QObject, Qt, Signal

from skinsource.design import Design
from skinsource.errors import SkinSourceError, Stopped
from skinsource.stimulus_export import overview_of, prepared
from skinsource_gui.stimulus_page.order import Order


class PreparingWorker(QObject):
    """Computes how an order would look, for one design.

    Parameters
    ----------
    design
        What is exported.
    """

    #: The `Order` and its `skinsource.stimulus_export.Overview`.
    ready = Signal(object, object)
    #: The `Order`, and why it cannot be.
    failed = Signal(object, str)
    _told = Signal(object, object)  # from the worker thread: a signal and its arguments

    def __init__(self, design: Design, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._design = design
        self._pool = ThreadPoolExecutor(1, thread_name_prefix="skinsource-stimulus")
        self._lock = Lock()
        self._wanted: Order | None = None
        self._working = False
        self._closed = Event()
        self._told.connect(self._tell, Qt.ConnectionType.QueuedConnection)

    def prepare(self, order: Order) -> None:
        """Look at ``order``, instead of whatever was wanted before."""
        with self._lock:
            self._wanted = order
            if self._working:
                return
            self._working = True
        self._pool.submit(self._work)

    def close(self) -> None:
        """Give up what is being done, and wait until it has ended."""
        self._closed.set()
        self._pool.shutdown(wait=True)

    def _tell(self, signal: Signal, arguments: tuple[object, ...]) -> None:
        if not self._closed.is_set():
            signal.emit(*arguments)

    def _work(self) -> None:
        while True:
            with self._lock:
                order, self._wanted = self._wanted, None
                if order is None or self._closed.is_set():
                    self._working = False
                    return
            try:
                name = Path(f"stimulus{order.format.suffix}")
                made = prepared(
                    self._design,
                    name,
                    order.format,
                    order.rate_hz,
                    order.options,
                    rig=order.rig,
                    equaliser=order.equaliser,
                    stop=self._is_outdated,
                )
                self._told.emit(self.ready, (order, overview_of(made)))
            except Stopped:
                continue
            except Exception as error:  # noqa: BLE001  shown to the user
                self._told.emit(self.failed, (order, _sentence(error)))

    def _is_outdated(self) -> bool:
        return self._closed.is_set() or self._wanted is not None


def _sentence(error: Exception) -> str:
    if isinstance(error, SkinSourceError):
        return str(error)
    return f"The studio made a mistake ({type(error).__name__}: {error}). Please report this."
