"""Esc Esc: whatever else Esc means where the keyboard is, twice in a row it stops what plays."""

from time import monotonic

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication, QWidget

_WITHIN_S = 0.6


class EscapeTwice(QObject):
    """Listens where the keyboard is, while it is asked to.

    Parameters
    ----------
    window
        Where it listens if no widget has the keyboard; also the parent.
    """

    #: Esc was pressed twice within 0.6 s.
    pressed = Signal()

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._window = window
        self._watched: QWidget | None = None
        self._on = False
        self._last_s = -_WITHIN_S

    def watch(self, on: bool) -> None:
        """Listen, or no longer."""
        if on == self._on:
            return
        self._on, self._last_s = on, -_WITHIN_S
        application = QApplication.instance()
        if not isinstance(application, QApplication):
            return
        if on:
            application.focusChanged.connect(self._follow)
            self._take(QApplication.focusWidget())
        else:
            application.focusChanged.disconnect(self._follow)
            self._forget()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # Each press sends one of these, wherever it goes then.
        if (
            event.type() == QEvent.Type.ShortcutOverride
            and isinstance(event, QKeyEvent)
            and not event.isAutoRepeat()
        ):
            self._press(event.key() == Qt.Key.Key_Escape)
        return super().eventFilter(watched, event)

    def _press(self, escape: bool) -> None:
        now_s = monotonic()
        twice = escape and now_s - self._last_s <= _WITHIN_S
        self._last_s = now_s if escape and not twice else -_WITHIN_S
        if twice:
            self.pressed.emit()

    def _follow(self, _old: QWidget | None, new: QWidget | None) -> None:
        self._take(new)

    def _take(self, widget: QWidget | None) -> None:
        self._forget()
        self._watched = widget or self._window
        self._watched.installEventFilter(self)
        self._watched.destroyed.connect(self._lose)

    def _forget(self) -> None:
        if self._watched is not None:
            self._watched.removeEventFilter(self)
            self._watched.destroyed.disconnect(self._lose)
            self._watched = None

    def _lose(self) -> None:
        self._watched = None
