"""Hands that do things to a window at random, always the same things for one seed."""

from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from time import monotonic
from unittest.mock import patch

import numpy as np
from PySide6.QtCore import QCoreApplication, QEvent, QPoint, QPointF, Qt, QTimer
from PySide6.QtGui import QContextMenuEvent, QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractScrollArea,
    QApplication,
    QDialog,
    QFileDialog,
    QInputDialog,
    QMenu,
    QMessageBox,
)

from tests.gui.wheel import NOTCH, turn_wheel

NONE, SHIFT = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier
CONTROL, ALT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.AltModifier
LEFT, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton
MIDDLE = Qt.MouseButton.MiddleButton
#: Most deeds that are remembered, to be told of when something is wrong.
_REMEMBERED = 60
_GIVE_UP_MS, _PATIENCE_S = 60, 60.0


class Hands:
    """Uses mouse, keys and dialogs of one window.

    Attributes
    ----------
    random
        Where all chances come from.
    done
        The last deeds, in words.
    recordings
        Files that can be imported.
    """

    def __init__(self, window, seed: int, folder: Path, recordings: tuple[Path, ...] = ()):
        self.window, self.document = window, window.document
        self.random = np.random.default_rng(seed)
        self.done: deque[object] = deque(maxlen=_REMEMBERED)
        self.recordings, self._folder = recordings, folder

    def one_of(self, things):
        things = tuple(things)
        return things[self.random.integers(len(things))]

    def chance(self, share: float) -> bool:
        return bool(self.random.random() < share)

    def number(self, low: float, high: float) -> float:
        return float(self.random.uniform(low, high))

    def place_in(self, widget) -> QPoint:
        size = widget.rect()
        return QPoint(
            int(self.random.integers(0, max(size.width(), 1))),
            int(self.random.integers(0, max(size.height(), 1))),
        )

    def key(self, key: Qt.Key, held=NONE) -> None:
        """Press a key wherever the keyboard is."""
        self._remember("key", key.name, held.name)
        QTest.keyClick(QApplication.focusWidget() or self.window, key, held)

    def type(self, text: str) -> None:
        """Type wherever the keyboard is."""
        self._remember("type", text)
        QTest.keyClicks(QApplication.focusWidget() or self.window, text)

    def click(self, widget, at: QPoint | None = None, held=NONE, button=LEFT) -> None:
        self._remember("click", widget.objectName(), at, held.name)
        QTest.mouseClick(_surface(widget), button, held, at or widget.rect().center())

    def double_click(self, widget, at: QPoint) -> None:
        self._remember("double click", widget.objectName(), at)
        surface = _surface(widget)
        QTest.mouseClick(surface, LEFT, NONE, at)
        QTest.mouseDClick(surface, LEFT, NONE, at)

    def drag(self, widget, start: QPoint, end: QPoint, held=NONE, button=LEFT) -> None:
        """Press, move in a few steps, and let go; now and then give up by Esc, half way."""
        self._remember("drag", widget.objectName(), start, end, held.name, button.name)
        surface = _surface(widget)
        QTest.mousePress(surface, button, held, start)
        steps = int(self.random.integers(2, 5))
        given_up = int(self.random.integers(1, steps + 1)) if self.chance(0.12) else 0
        for step in range(1, steps + 1):
            here = QPointF(start + (end - start) * step / steps)
            QApplication.sendEvent(
                surface,
                QMouseEvent(
                    QEvent.Type.MouseMove, here, surface.mapToGlobal(here), button, button, held
                ),
            )
            if step == given_up:
                self.key(Qt.Key.Key_Escape)
            if step == 1:
                QApplication.processEvents()
        QTest.mouseRelease(surface, button, held, end)

    def wheel(self, widget, at: QPoint, notches: int, held=NONE) -> None:
        self._remember("wheel", widget.objectName(), at, notches, held.name)
        turn_wheel(_surface(widget), at, (0, NOTCH * notches), held)

    def menu_of(self, widget, at: QPoint) -> None:
        """Press the right button, and choose a line of the menu that opens, or none."""
        self._remember("menu", widget.objectName(), at)
        surface = _surface(widget)
        QTest.mouseClick(surface, RIGHT, NONE, at)
        place = QContextMenuEvent.Reason.Mouse
        QApplication.sendEvent(surface, QContextMenuEvent(place, at, surface.mapToGlobal(at)))
        self.choose_of_popup()

    def choose_of_popup(self) -> None:
        """Choose a line of the open menu by key."""
        menu = QApplication.activePopupWidget()
        if not isinstance(menu, QMenu):
            return
        lines = [
            action
            for action in menu.actions()
            if action.isEnabled()
            and action.text()
            and action.menu() is None
            and not action.isSeparator()
        ]
        if not lines or self.chance(0.1):
            menu.close()
            return
        chosen = self.one_of(lines)
        menu.setActiveAction(chosen)
        self._remember("choose", chosen.text())
        QTest.keyClick(menu, Qt.Key.Key_Return)

    def _remember(self, *what: object) -> None:
        self.done.append(what)

    def wait(self, holds: Callable[[], bool]) -> None:
        """Let the window live until something holds; a minute at most."""
        end = monotonic() + _PATIENCE_S
        while not holds():
            if monotonic() > end:
                raise TimeoutError(f"still not so after {_PATIENCE_S} s")
            QTest.qWait(5)

    def close_what_opened(self) -> None:
        """Give up menus and pages that stand in front of the window."""
        while (popup := QApplication.activePopupWidget()) is not None:
            popup.close()
        for dialog in self.window.findChildren(QDialog):
            if dialog.isVisible():
                dialog.close()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)

    @contextmanager
    def answering(self) -> Iterator[None]:
        """Answer all questions at random."""
        guard = QTimer(interval=_GIVE_UP_MS)
        guard.timeout.connect(self._end_waiting)
        guard.start()
        with (
            patch.object(QFileDialog, "getOpenFileName", self._open_which),
            patch.object(QFileDialog, "getOpenFileNames", self._open_several),
            patch.object(QFileDialog, "getSaveFileName", self._save_where),
            patch.object(QMessageBox, "question", self._answer),
            patch.object(QInputDialog, "getDouble", lambda *_, **__: (300.0, self.chance(0.8))),
            patch.object(
                QInputDialog, "getText", lambda *_, **__: ("Other name", self.chance(0.8))
            ),
        ):
            yield
        guard.stop()

    def _open_several(self, *given) -> tuple[list[str], str]:
        return list(filter(None, self._open_which(*given)[:1])), ""

    def _open_which(self, _parent, title: str, *_: object) -> tuple[str, str]:
        known = (
            self.recordings if "recording" in title else sorted(self._folder.glob("*.skinsource"))
        )
        return (str(self.one_of(known)) if known and self.chance(0.95) else "", "")

    def _save_where(self, _parent, _title: str, start: str, *_: object) -> tuple[str, str]:
        if self.chance(0.05):
            return "", ""
        return str(self._folder / f"kept {self.random.integers(3)}{Path(start).suffix}"), ""

    def _answer(self, _parent, _title: str, _words: str, buttons, *_: object):
        kinds = QMessageBox.StandardButton
        known = (kinds.Save, kinds.Discard, kinds.Yes, kinds.Ok, kinds.Cancel)
        offered = [button for button in known if buttons & button]
        # Whoever says Cancel each time gets nowhere.
        return self.one_of(offered[:-1]) if self.chance(0.85) else offered[-1]

    def _end_waiting(self) -> None:
        """End what waits in a loop of its own: the menu of a button."""
        if QApplication.activePopupWidget() is not None:
            self.choose_of_popup()


def _surface(widget):
    return widget.viewport() if isinstance(widget, QAbstractScrollArea) else widget
