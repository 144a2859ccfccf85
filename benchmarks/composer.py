"""Somebody who composes by mouse and keys, and counts what it takes."""

import os
from collections.abc import Callable
from pathlib import Path
from time import monotonic

from compose_hands import EventHands, ScreenHands
from PySide6.QtCore import QPoint, QTimer
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractScrollArea,
    QApplication,
    QDialog,
    QMenu,
    QScrollArea,
    QWidget,
)

from skinsource_gui.shell.window import MainWindow

_PATIENCE_S = 30.0
#: How often it is looked whether something holds; events that Qt is handed need no time.
_LOOK_MS = 4 if os.environ.get("QT_QPA_PLATFORM") == "offscreen" else 20


class Composer:
    """Uses a window by mouse and keys, and counts what it takes.

    Parameters
    ----------
    window
        The studio.
    hands
        What moves mouse and keys.
    pictures
        Where a picture goes after each scene.

    Attributes
    ----------
    steps
        Clicks, drags, turns of the wheel and keys so far; a typed text counts by its letters.
    disappointments
        Sentences that did not hold.
    """

    def __init__(self, window: MainWindow, hands: EventHands | ScreenHands, pictures: Path) -> None:
        self.window, self.document = window, window.document
        self._hands, self._pictures = hands, pictures
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
            self._hands.press_key(keys)
            self.steps += 1
        QTest.qWait(_LOOK_MS)

    def type(self, text: str) -> None:
        """Type, after the moment that ends what was typed before."""
        QTest.qWait(QApplication.keyboardInputInterval() + 50)
        self._hands.type(text)
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

    def click(self, widget: QWidget, at: QPoint | None = None, *, double: bool = False) -> None:
        """Click, in the middle if no place is named; what is out of sight is scrolled into it."""
        self._scroll_to(widget)
        surface = _surface(widget)
        self._hands.click(surface, at or surface.rect().center(), double=double)
        self.steps += 2 if double else 1
        QTest.qWait(_LOOK_MS)

    def drag(self, widget: QWidget, start: QPoint, end: QPoint) -> None:
        """Press, move, and let go."""
        self._hands.drag(_surface(widget), start, end)
        self.steps += 1
        QTest.qWait(_LOOK_MS)

    def wheel(self, widget: QWidget, notches: int) -> None:
        """Turn the wheel over the middle."""
        self._scroll_to(widget)
        self._hands.wheel(widget, widget.rect().center(), notches)
        self.steps += abs(notches)
        QTest.qWait(_LOOK_MS)

    def choose(self, *text: str) -> None:
        """Choose in a menu of the menu bar, and in the menus that open from there, by mouse."""
        bar = self.window.menuBar()
        first = next(action for action in bar.actions() if _plain(action.text()) == text[0])
        self.click(bar, bar.actionGeometry(first).center())
        self.choose_of_popup(*text[1:])

    def choose_of_popup(self, *text: str) -> None:
        """Choose in the menu that is open, by mouse."""
        for word in text:
            # A menu within a menu opens a moment later.
            self.wait(lambda w=word: _line(w) is not None, f"a menu opens that has {word}")
            menu, line = QApplication.activePopupWidget(), _line(word)
            self.click(menu, menu.actionGeometry(line).center())

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

    def _scroll_to(self, widget: QWidget) -> None:
        area = widget.parentWidget()
        while area is not None and not isinstance(area, QScrollArea):
            area = area.parentWidget()
        if area is None:
            return
        for _ in range(40):
            middle = widget.mapTo(area.viewport(), widget.rect().center())
            if area.viewport().rect().contains(middle):
                return
            down = middle.y() > area.viewport().rect().center().y()
            # Beside the fields, where the wheel turns no number.
            edge = QPoint(2, area.viewport().height() // 2)
            self._hands.wheel(area.viewport(), edge, -1 if down else 1)
            self.steps += 1
            QTest.qWait(_LOOK_MS)


def _line(word: str) -> QAction | None:
    """The line of the open menu with these words."""
    menu = QApplication.activePopupWidget()
    lines = menu.actions() if isinstance(menu, QMenu) else ()
    return next((line for line in lines if _plain(line.text()) == word), None)


def _surface(widget: QWidget) -> QWidget:
    return widget.viewport() if isinstance(widget, QAbstractScrollArea) else widget


def _text(widget: QWidget) -> str:
    return _plain(widget.text()) if isinstance(widget, QAbstractButton) else ""


def _plain(text: str) -> str:
    return text.replace("&", "").split("\t")[0]
