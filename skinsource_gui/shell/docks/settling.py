"""Whether docks stand as they were arranged, and what becomes of those that do."""

from collections.abc import Mapping

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QMainWindow

from skinsource_gui.shell.docks.arrangements import Arrangements
from skinsource_gui.shell.docks.dock import Dock
from skinsource_gui.shell.docks.standing import Standing


class Settling(QObject):
    """Shares the room once panels are as wide as they will be, and knows whether they were moved.

    Parameters
    ----------
    window
        Whose docks; also the parent.
    docks, arrangements
        Its docks, and what arranges them.
    """

    def __init__(
        self, window: QMainWindow, docks: Mapping[str, Dock], arrangements: Arrangements
    ) -> None:
        super().__init__(window)
        self._window, self._docks, self._arrangements = window, docks, arrangements
        arrangements.chosen.connect(self._begin)
        # How the docks stand where nobody has moved them; None: they may have been.
        self._untouched: Standing | None = None
        # How high some panels must be is known once they have their width.
        self._widened = QTimer(self, singleShot=True, interval=0)
        self._widened.timeout.connect(self._share_room)
        # Qt shares the room a moment after it was told how.
        self._settled = QTimer(self, singleShot=True, interval=0)
        self._settled.timeout.connect(self._note)

    @property
    def untouched(self) -> bool:
        """Whether nobody has moved a dock since they were arranged."""
        if self._settled.isActive() or self._widened.isActive():
            return True
        now = Standing.of(self._window, self._docks)
        return self._untouched is not None and now.is_like(self._untouched)

    def refit(self) -> None:
        """Words have another size: what nobody has moved is arranged anew for them."""
        if self.untouched:
            self._arrangements.refit()
            self._begin()

    def forget(self) -> None:
        """The docks were put elsewhere."""
        self._settled.stop()
        self._widened.stop()
        self._untouched = None

    def _begin(self) -> None:
        self._settled.stop()
        self._widened.start()

    def _share_room(self) -> None:
        self._arrangements.share_room()
        self._settled.start()

    def _note(self) -> None:
        self._untouched = Standing.of(self._window, self._docks)
