"""An engine that lets the window be painted first."""

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtWidgets import QWidget

from skinsource.engine.graph import Graph
from skinsource_gui.state.engine import Engine, Purpose, Request, Slot


class FirstPaintEngine(Engine):
    """Begins when its window has been painted once.

    The first evaluation imports most of scipy and opens the limb: half a second in which the
    window would have to share Python's lock with the worker, just when it is painted first.

    Parameters
    ----------
    new_graph
        Makes the graph of a slot.
    window
        What is painted first; also the parent.
    """

    def __init__(self, new_graph: Callable[[], Graph], window: QWidget) -> None:
        super().__init__(new_graph, window)
        self._painted = False
        self._first: dict[tuple[Slot, Purpose], Request] = {}
        window.installEventFilter(self)

    @property
    def busy(self) -> bool:
        """Whether a request is being evaluated or waits."""
        return bool(self._first) or super().busy

    def request(self, request: Request) -> None:
        """Evaluate ``request`` as soon as possible, unless a newer one arrives first."""
        if self._painted:
            super().request(request)
        else:
            self._first[request.place] = request

    def close(self) -> None:
        """Stop at the next rule and wait for the worker to end."""
        # What is asked from now on is refused there.
        self._painted = True
        self._first.clear()
        super().close()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Paint:
            watched.removeEventFilter(self)
            # All of the window is painted before the next event is looked at.
            QTimer.singleShot(0, self._begin)
        return super().eventFilter(watched, event)

    def _begin(self) -> None:
        self._painted = True
        first, self._first = self._first, {}
        for request in first.values():
            self.request(request)
