"""An engine that lets the window be painted first."""

from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtWidgets import QWidget

from skinsource.graph import Graph
from skinsource_gui.state.engine import Engine, Request


class PatientEngine(Engine):
    """Begins when its window has been painted once.

    The first evaluation imports most of scipy and opens the limb: half a second in which the
    window would have to share Python's lock with the worker, just when it is painted first.

    Parameters
    ----------
    graph
        What evaluates.
    window
        What is painted first; also the parent.
    """

    def __init__(self, graph: Graph, window: QWidget) -> None:
        super().__init__(graph, window)
        self._painted = False
        self._first: Request | None = None
        window.installEventFilter(self)

    @property
    def busy(self) -> bool:
        """Whether a request is being evaluated or waits."""
        return self._first is not None or super().busy

    def request(self, request: Request) -> None:
        """Evaluate ``request`` as soon as possible, unless a newer one arrives first."""
        if self._painted:
            super().request(request)
        else:
            self._first = request

    def close(self) -> None:
        """Stop at the next rule and wait for the worker to end."""
        # What is asked from now on is refused there.
        self._painted, self._first = True, None
        super().close()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Paint:
            watched.removeEventFilter(self)
            # All of the window is painted before the next event is looked at.
            QTimer.singleShot(0, self._begin)
        return super().eventFilter(watched, event)

    def _begin(self) -> None:
        self._painted = True
        first, self._first = self._first, None
        if first is not None:
            self.request(first)
