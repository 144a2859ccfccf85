"""Somebody who composes by keys alone, and counts what it takes."""

from collections.abc import Callable
from pathlib import Path
from time import monotonic

from PySide6.QtCore import QTimer
from PySide6.QtGui import QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QDialog,
    QWidget,
)

from skinsource_gui.shell.window import MainWindow

_PATIENCE_S = 30.0
#: How often it is looked whether something holds.
_LOOK_MS = 4


class Composer:
    """Uses a window by keys, as events that Qt is handed, and counts what it takes.

    Parameters
    ----------
    window
        The studio.
    pictures
        Where a picture goes after each scene.

    Attributes
    ----------
    steps
        Keys so far; a typed text counts by its letters.
    disappointments
        Sentences that did not hold.
    """

    def __init__(self, window: MainWindow, pictures: Path) -> None:
        self.window, self.document = window, window.document
        self._pictures = pictures
        self.steps = 0
        self.disappointments: list[str] = []

    def expect(self, holds: bool, sentence: str) -> None:
        """Note ``sentence`` if it does not hold."""
        if not holds:
            self.disappointments.append(sentence)
            print(f"  NOT SO: {sentence}", flush=True)

    def wait(self, holds: Callable[[], object], sentence: str) -> None:
        """Let the window live until something holds."""
        end = monotonic() + _PATIENCE_S
        while not holds():
            if monotonic() > end:
                raise SystemExit(f"waited in vain: {sentence}")
            QTest.qWait(_LOOK_MS)

    def settle(self) -> None:
        """Wait until everything is computed and painted."""
        QTest.qWait(_LOOK_MS)
        while self.window.engine.busy or self.window.runner.busy:
            QTest.qWait(_LOOK_MS)
        QTest.qWait(_LOOK_MS)

    def picture(self, text: str) -> None:
        """Photograph the window."""
        self.settle()
        self.window.grab().save(str(self._pictures / f"{text.replace(' ', '-')}.png"))

    def key(self, keys: str, times: int = 1) -> None:
        """Press a key, wherever the keyboard is."""
        for _ in range(times):
            pressed = QKeySequence(keys)[0]
            QTest.keyClick(_with_keyboard(), pressed.key(), pressed.keyboardModifiers())
            self.steps += 1
        QTest.qWait(_LOOK_MS)

    def type(self, text: str) -> None:
        """Type, after the moment that ends what was typed before."""
        QTest.qWait(QApplication.keyboardInputInterval() + 50)
        for letter in text:
            QTest.keyClick(_with_keyboard(), letter)
        self.steps += len(text)
        QTest.qWait(_LOOK_MS)

    def tab_to(self, name: str) -> QWidget:
        """Press Tab until the keyboard is at the widget of that name."""
        for _ in range(120):
            here = QApplication.focusWidget()
            if here is not None and name in (here.objectName(), here.accessibleName(), _text(here)):
                return here
            self.key("Tab")
        raise SystemExit(f"Tab does not lead to {name}")

    def go_to_panel(self, name: str) -> None:
        """Press F6 until the keyboard is in the panel of that name."""
        panel = self.window.panel(name)
        for _ in range(12):
            here = QApplication.focusWidget()
            if here is not None and (here is panel or panel.isAncestorOf(here)):
                return
            self.key("F6")
        raise SystemExit(f"F6 does not lead to {name}")

    def answer(self, begin: Callable[[], None], kind: type, how: Callable[[QWidget], None]) -> None:
        """Begin something that waits for a dialog or menu of that kind, and deal with it there."""
        done: list[bool] = []
        timer = QTimer(interval=5 * _LOOK_MS)

        def look() -> None:
            waiting = QApplication.activePopupWidget() or QApplication.activeModalWidget()
            if isinstance(waiting, kind) and waiting.isVisible():
                timer.stop()
                how(waiting)
                done.append(True)

        timer.timeout.connect(look)
        timer.start()
        begin()
        self.wait(lambda: done, f"a {kind.__name__} opens")
        self.settle()

    @property
    def pages(self) -> list[QDialog]:
        """The dialogs that are open."""
        return [dialog for dialog in self.window.findChildren(QDialog) if dialog.isVisible()]

    def page(self) -> QDialog:
        """The dialog that opens."""
        self.wait(lambda: self.pages, "a page opens")
        QTest.qWait(5 * _LOOK_MS)
        return self.pages[-1]

    def widget(self, name: str, inside: QWidget | None = None) -> QWidget:
        """The widget called ``name`` that is shown."""
        widgets = (inside or self.window).findChildren(QWidget, name)
        return next(widget for widget in widgets if widget.isVisible())


def _is_studio(widget: QWidget) -> bool:
    return isinstance(widget, MainWindow)


def _with_keyboard() -> QWidget:
    if QApplication.activeWindow() is None and QApplication.activePopupWidget() is None:
        # As a window manager does when a dialog has closed.
        next(filter(_is_studio, QApplication.topLevelWidgets())).activateWindow()
        QApplication.processEvents()
    return (
        QApplication.activePopupWidget()
        or QApplication.focusWidget()
        or QApplication.activeModalWidget()
        or QApplication.activeWindow()
    )


def _text(widget: QWidget) -> str:
    return _plain(widget.text()) if isinstance(widget, QAbstractButton) else ""


def _plain(text: str) -> str:
    return text.replace("&", "").split("\t")[0]
