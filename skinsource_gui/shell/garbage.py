"""Garbage is collected in the GUI thread alone, at moments when nothing is dragged."""

import gc

from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtWidgets import QApplication

_LOOK_EVERY_MS = 1000
#: As Python has it: so many new objects are looked through, and of so many times one time older
#: ones too.
_NEW_OBJECTS, _TIMES = 700, 10
_YOUNG, _MIDDLE, _OLD = range(3)


def take_over_collection(owner: QObject) -> None:
    """Collect garbage from now on, except in what stands now.

    Modules, menus and panels live as long as the window.  To look through them again takes the
    collector fifty milliseconds.

    Parameters
    ----------
    owner
        Garbage is collected until it ends.
    """
    gc.collect()
    gc.freeze()
    GarbageCollector(owner)


class GarbageCollector(QObject):
    """Collects garbage from a timer, instead of wherever Python happens to make an object.

    Python's own collector runs in any thread.  In the worker's it would destroy widgets and plots,
    which are full of cycles, while the GUI thread paints; and in the GUI thread it would look
    through everything in the middle of a drag.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        gc.disable()
        self._young, self._middle = 0, 0
        timer = QTimer(self, interval=_LOOK_EVERY_MS)
        timer.timeout.connect(self.collect_what_is_due)
        timer.start()

    def collect_what_is_due(self) -> int | None:
        """Collect; return up to which generation, or None where too little is new."""
        if gc.get_count()[_YOUNG] < _NEW_OBJECTS:
            return None
        generation = self._due()
        gc.collect(generation)
        self._young = 0 if generation > _YOUNG else self._young + 1
        if generation > _YOUNG:
            self._middle = 0 if generation == _OLD else self._middle + 1
        return generation

    def _due(self) -> int:
        if self._young < _TIMES:
            return _YOUNG
        # This one takes long: it waits for the end of a drag.
        dragged = QApplication.mouseButtons() != Qt.MouseButton.NoButton
        return _MIDDLE if self._middle < _TIMES or dragged else _OLD
