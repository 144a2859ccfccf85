"""The playhead while it runs: in step with what is heard, and back where it began at the end."""

from collections.abc import Callable
from dataclasses import replace

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from skinsource_gui.state.document import Document

# Sixty times a second.
_STEP_MS = 16
# At least as long as what fades in before the place where it begins.
_FADE_IN_S = 0.01


class RunningPlayhead(QObject):
    """Puts the playhead where playing is; makes no steps of the history.

    Parameters
    ----------
    document
        Whose playhead it is.
    """

    #: The user has put it elsewhere, s.
    moved_away = Signal(float)
    #: It has moved by itself.
    stepped = Signal()

    def __init__(self, document: Document, parent: QObject) -> None:
        super().__init__(parent)
        self._document = document
        self._position: Callable[[], float | None] | None = None
        self._from_s = self._put_s = 0.0
        self._timer = QTimer(self, interval=_STEP_MS, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._step)

    def run(self, position: Callable[[], float | None]) -> None:
        """Follow ``position``, which tells a time of the design in s, or None."""
        if self._position is None:
            self._from_s = self._put_s = self._document.view.playhead_s
            self._document.playhead_moved.connect(self._look)
            self._document.changed.connect(self._look)
        self._position = position
        self._timer.start()

    def rest(self) -> None:
        """Go back to where it ran from; the same can then be played once more."""
        if self._position is None:
            return
        self._timer.stop()
        self._position = None
        self._document.playhead_moved.disconnect(self._look)
        self._document.changed.disconnect(self._look)
        self._put(self._from_s)

    def stay(self) -> None:
        """Come to rest where it is now, not where it ran from."""
        self._from_s = self._put_s

    def _step(self) -> None:
        time_s = None if self._position is None else self._position()
        if time_s is not None:
            fades_in = 0.0 < self._from_s - time_s < _FADE_IN_S
            self._put(self._from_s if fades_in else time_s)
        self.stepped.emit()

    def _put(self, time_s: float) -> None:
        self._put_s = time_s
        view = self._document.view
        if view.playhead_s != time_s:
            self._document.look(replace(view, playhead_s=time_s))

    def _look(self) -> None:
        time_s = self._document.view.playhead_s
        if time_s != self._put_s:
            self._from_s = self._put_s = time_s
            self.moved_away.emit(time_s)
