"""Steps that follow each other quickly belong together."""

from PySide6.QtCore import QObject, QTimer

from skinsource_gui.widgets.fields.gesture import new_gesture

#: A pause as long as this ends a burst.
PAUSE_MS = 600


class Burst(QObject):
    """One gesture number for all steps between two pauses, so that they undo as one."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._gesture = 0
        self._pause = QTimer(self)
        self._pause.setSingleShot(True)
        self._pause.setInterval(PAUSE_MS)

    @property
    def active(self) -> bool:
        """Whether the next step belongs to the last one."""
        return self._pause.isActive()

    def gesture(self) -> int:
        """Gesture number of a step that happens now."""
        if not self.active:
            self._gesture = new_gesture()
        self._pause.start()
        return self._gesture

    def end(self) -> None:
        """Let the next step begin a new burst."""
        self._pause.stop()
