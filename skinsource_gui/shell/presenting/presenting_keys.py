"""Keys that mean the same while somebody presents, whatever has the keyboard."""

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QAction, QKeyEvent, QKeySequence
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QApplication,
    QComboBox,
    QLineEdit,
    QPlainTextEdit,
    QTextEdit,
    QWidget,
)

from skinsource_gui.widgets.keys import meaning_of

_ASKED, _PRESSED = QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress
# Where the keyboard may be by chance, as where a field went that was turned: the key of Play plays.
_PUSHED = (QAbstractButton, QComboBox, QAbstractItemView)
# They know by themselves whether Esc gives up what is typed.
_TEXTS = (QLineEdit, QPlainTextEdit, QTextEdit)


class PresentingKeys(QObject):
    """Takes keys from who has the keyboard, as long as it lives.

    Clickers send Page Down and Page Up: plots go through time with them and numbers take large
    steps; a shortcut of the window would come after those.  The key of Play plays, also on a list,
    and Esc leaves, also on a map whose outputs it would unselect: here too shortcuts of the window
    come after.  What is typed or dragged has both first.

    Parameters
    ----------
    following, previous
        What is done on Page Down, and on Page Up.
    play
        What is done by its shortcut, where no shortcut of the window is asked.
    leave
        What is done on Esc, where no shortcut of the window is asked.
    parent
        Its owner.
    """

    def __init__(
        self,
        following: Callable[[], None],
        previous: Callable[[], None],
        play: QAction,
        leave: Callable[[], None],
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._play = play
        self._doing = {
            "next": following,
            "previous": previous,
            "play": play.trigger,
            "leave": leave,
        }
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
        plays = QKeySequence(event.keyCombination()) in self._play.shortcuts()
        meaning = "play" if plays else meaning_of("presenting", event)
        do = self._doing.get(meaning)
        elsewhere = QApplication.activeModalWidget() or QApplication.activePopupWidget()
        if do is None or elsewhere or not _is_taken(watched, meaning):
            return super().eventFilter(watched, event)
        if event.type() == _PRESSED:
            do()
        elif meaning in ("play", "leave"):
            # Who listens for Esc Esc hears of it, and a shortcut of the window that is free.
            return super().eventFilter(watched, event)
        event.accept()
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


def unless_dragging(do: Callable[[], None]) -> Callable[[], None]:
    """Do it unless a button of the mouse is down: Esc is meant for what is dragged."""

    def act() -> None:
        if not QApplication.mouseButtons():
            do()

    return act


def _is_taken(watched: QObject, meaning: str) -> bool:
    """Whether a key is not for who has the keyboard."""
    if meaning == "play":
        return isinstance(watched, _PUSHED)
    if meaning == "leave":
        return not isinstance(watched, _TEXTS) and not QApplication.mouseButtons()
    return True
