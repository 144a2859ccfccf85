"""Telling the eye that something is out of date, but not at once."""

from PySide6.QtCore import QObject, QTimer, Signal

# Results come many times a second while something is dragged; only lateness is worth a word.
_LATE_MS = 150


class Lateness(QObject):
    """Whether what is drawn has been out of date for a while.

    Attributes
    ----------
    late
        Whether that is so.
    """

    #: `late` is something else now.
    changed = Signal(bool)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.late = False
        self._timer = QTimer(self, interval=_LATE_MS, singleShot=True)
        self._timer.timeout.connect(self._be_late)

    def set_stale(self, stale: bool, *, at_once: bool = False) -> None:
        """Say whether what is drawn is out of date; being up to date is told at once.

        ``at_once``: so is being out of date.
        """
        if not stale:
            self._timer.stop()
            if self.late:
                self.late = False
                self.changed.emit(False)
        elif self.late:
            return
        elif at_once:
            self._timer.stop()
            self._be_late()
        elif not self._timer.isActive():
            self._timer.start()

    def count_anew(self) -> None:
        """Something newer is drawn: what was not late yet is not for a while from now."""
        if self._timer.isActive():
            self._timer.start()

    def _be_late(self) -> None:
        self.late = True
        self.changed.emit(True)
