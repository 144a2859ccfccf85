"""Whether docks stand as they were arranged, and what becomes of those that do."""

from collections.abc import Mapping

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QMainWindow

from skinsource_gui.shell.appearance import Appearance
from skinsource_gui.shell.docks.arrangements import Arrangements
from skinsource_gui.shell.docks.dock import Dock
from skinsource_gui.shell.docks.standing import Standing


class Settling(QObject):
    """Shares the room once panels are as wide as they will be, and knows whether they were moved.

    Parameters
    ----------
    window
        Whose docks; the parent.
    docks, arrangements
        Its docks, and what arranges them.
    """

    def __init__(
        self, window: QMainWindow, docks: Mapping[str, Dock], arrangements: Arrangements
    ) -> None:
        super().__init__(window)
        self._docks, self._arrangements = docks, arrangements
        arrangements.chosen.connect(self._begin)
        # How the docks stand where nobody has moved them; None: they may have been.
        self._untouched: Standing | None = None
        # Whether nobody had moved them before words took another size.
        self._to_refit = False
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
        now = Standing.of(self._docks)
        return self._untouched is not None and now.is_like(self._untouched)

    def follow(self, appearance: Appearance) -> None:
        """Arrange anew, whenever words have another size, what nobody has moved."""
        appearance.changing.connect(self._look)
        appearance.changed.connect(self._refit)

    def refit(self) -> None:
        """The window has another size: what nobody has moved is arranged anew for it."""
        self._look()
        self._refit()

    def forget(self) -> None:
        """The docks were put elsewhere."""
        self._settled.stop()
        self._widened.stop()
        self._untouched = None

    def _look(self) -> None:
        # Bars that grow with their words push docks, which then look as if they had been moved.
        self._to_refit = self.untouched

    def _refit(self) -> None:
        if self._to_refit:
            self._arrangements.refit()
            self._begin()

    def _begin(self) -> None:
        self._settled.stop()
        self._widened.start()

    def _share_room(self) -> None:
        self._arrangements.share_room()
        self._settled.start()

    def _note(self) -> None:
        self._untouched = Standing.of(self._docks)
