"""When a person goes on to something else."""

from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication

_KEY_EVENTS = (QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress)
_PRESSES = (QEvent.Type.MouseButtonPress, QEvent.Type.MouseButtonDblClick)
_HELD = frozenset(
    {
        Qt.Key.Key_Shift,
        Qt.Key.Key_Control,
        Qt.Key.Key_Alt,
        Qt.Key.Key_AltGr,
        Qt.Key.Key_Meta,
        Qt.Key.Key_CapsLock,
    }
)
_COMMAND = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier


class NextAct(QObject):
    """Tells once of the next click, wherever it is, or of the next key that types nothing.

    What is said about something that is over stands until then: long enough to be read by who
    types on in the next field, and no longer.  A click is over when it can no longer become a
    double click, or a drag: what goes then may move what was clicked.
    """

    came = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._begin = QTimer(self, singleShot=True, interval=0)
        self._begin.timeout.connect(self._watch)
        self._click = QTimer(self, singleShot=True)
        self._click.timeout.connect(self._end_click)

    def wait(self) -> None:
        """Wait for what is done after what is being done now."""
        self._click.stop()
        self._begin.start()

    def stop(self) -> None:
        """Wait no longer."""
        self._begin.stop()
        self._click.stop()
        application = QApplication.instance()
        if application is not None:
            application.removeEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() in _PRESSES:
            self._click.start(QApplication.doubleClickInterval())
        elif event.type() in _KEY_EVENTS and _goes_on(event):
            self._end()
        return super().eventFilter(watched, event)

    def _end_click(self) -> None:
        if QApplication.mouseButtons():
            self._click.start()
        else:
            self._end()

    def _end(self) -> None:
        self.stop()
        self.came.emit()

    def _watch(self) -> None:
        application = QApplication.instance()
        if application is not None:
            application.installEventFilter(self)


def _goes_on(event: QEvent) -> bool:
    """Whether a key does something else than to write on."""
    if not isinstance(event, QKeyEvent) or event.key() in _HELD:
        return False
    writes = event.text().isprintable() and event.text() != ""
    return not writes or bool(event.modifiers() & _COMMAND)
