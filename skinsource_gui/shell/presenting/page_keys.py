"""The Page keys while somebody presents: clickers send them, whatever has the keyboard."""

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication, QWidget

_ASKED, _PRESSED = QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress


class PageKeys(QObject):
    """Takes Page Down and Page Up from who has the keyboard, as long as it lives.

    Plots go through time with them and numbers take large steps; a shortcut of the window would
    come after those.

    Parameters
    ----------
    following, previous
        What is done on Page Down, and on Page Up.
    parent
        Its owner.
    """

    def __init__(
        self, following: Callable[[], None], previous: Callable[[], None], parent: QObject
    ) -> None:
        super().__init__(parent)
        self._doing = {Qt.Key.Key_PageDown: following, Qt.Key.Key_PageUp: previous}
        self._watched: QWidget | None = None
        # One widget at a time: a filter on all widgets would see each event of the studio.
        application = QApplication.instance()
        if isinstance(application, QApplication):
            application.focusChanged.connect(self._watch)
        self._watch(None, QApplication.focusWidget())

    def end(self) -> None:
        """Leave the keys to who has the keyboard."""
        application = QApplication.instance()
        if isinstance(application, QApplication):
            application.focusChanged.disconnect(self._watch)
        self._watch(None, None)
        self.deleteLater()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() not in (_ASKED, _PRESSED) or not isinstance(event, QKeyEvent):
            return super().eventFilter(watched, event)
        do = self._doing.get(Qt.Key(event.key()))
        held = event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
        elsewhere = QApplication.activeModalWidget() or QApplication.activePopupWidget()
        if do is None or held or elsewhere:
            return super().eventFilter(watched, event)
        event.accept()
        if event.type() == _PRESSED:
            do()
        return True

    def _watch(self, _old: QWidget | None, new: QWidget | None) -> None:
        if self._watched is not None:
            self._watched.removeEventFilter(self)
            self._watched.destroyed.disconnect(self._forget)
        self._watched = new
        if new is not None:
            new.installEventFilter(self)
            new.destroyed.connect(self._forget)

    def _forget(self) -> None:
        self._watched = None
