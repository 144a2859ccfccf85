"""Mouse and keys, as events that Qt is handed, or as those of a real screen."""

import shutil
import subprocess

from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QKeySequence, QMouseEvent, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QApplication,
    QWidget,
)

from skinsource_gui.shell.window import MainWindow

_LEFT, _NONE = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
#: What xdotool calls keys that Qt calls otherwise.
_X_NAMES = {
    **{"Enter": "Return", "PgDown": "Next", "PgUp": "Prior", "Esc": "Escape"},
    **{"Ins": "Insert", "Space": "space"},
}


class EventHands:
    """Mouse and keys as events that Qt is handed: runs offscreen."""

    def press_key(self, keys: str) -> None:
        """Press a key, with those that are held: Ctrl+K."""
        combination = QKeySequence(keys)[0]
        QTest.keyClick(_with_keyboard(), combination.key(), combination.keyboardModifiers())

    def type(self, text: str) -> None:
        """Type a text."""
        for letter in text:
            QTest.keyClick(_with_keyboard(), letter)

    def click(self, widget: QWidget, at: QPoint, *, double: bool = False) -> None:
        """Click, once or twice."""
        QTest.mouseClick(widget, _LEFT, _NONE, at)
        if double:
            QTest.mouseDClick(widget, _LEFT, _NONE, at)

    def drag(self, widget: QWidget, start: QPoint, end: QPoint) -> None:
        """Press, move, and let go."""
        QTest.mousePress(widget, _LEFT, _NONE, start)
        for step in range(1, 11):
            here = QPointF(start + (end - start) * step / 10)
            there = QPointF(widget.mapToGlobal(here))
            QApplication.sendEvent(
                widget, QMouseEvent(QEvent.Type.MouseMove, here, there, _LEFT, _LEFT, _NONE)
            )
            QApplication.processEvents()
        QTest.mouseRelease(widget, _LEFT, _NONE, end)

    def wheel(self, widget: QWidget, at: QPoint, notches: int) -> None:
        """Turn the wheel by so many notches, up where they are positive."""
        where = QPointF(at)
        event = QWheelEvent(
            *(where, QPointF(widget.mapToGlobal(where)), QPoint(), QPoint(0, 120 * notches)),
            *(Qt.MouseButton.NoButton, _NONE, Qt.ScrollPhase.NoScrollPhase, False),
        )
        QApplication.sendEvent(widget, event)


class ScreenHands:
    """Mouse and keys of the screen that DISPLAY names, by xdotool; a window manager runs there."""

    def press_key(self, keys: str) -> None:
        """Press a key, with those that are held: Ctrl+K."""
        *held, key = keys.split("+")
        key = key.lower() if len(key) == 1 else _X_NAMES.get(key, key)
        self._do("key", "+".join([*(modifier.lower() for modifier in held), key]))

    def type(self, text: str) -> None:
        """Type a text."""
        self._do("type", "--delay", "25", "--", text)

    def click(self, widget: QWidget, at: QPoint, *, double: bool = False) -> None:
        """Click, once or twice."""
        self._go(widget, at)
        self._do("click", *(("--repeat", "2", "--delay", "80") if double else ()), "1")

    def drag(self, widget: QWidget, start: QPoint, end: QPoint) -> None:
        """Press, move, and let go."""
        self._go(widget, start)
        self._do("mousedown", "1")
        for step in range(1, 11):
            self._go(widget, start + (end - start) * step / 10)
        self._do("mouseup", "1")

    def wheel(self, widget: QWidget, at: QPoint, notches: int) -> None:
        """Turn the wheel by so many notches, up where they are positive."""
        self._go(widget, at)
        self._do("click", "--repeat", str(abs(notches)), "4" if notches > 0 else "5")

    def _go(self, widget: QWidget, at: QPoint) -> None:
        there = widget.mapToGlobal(at)
        self._do("mousemove", str(there.x()), str(there.y()))

    def _do(self, *text: str) -> None:
        tool = shutil.which("xdotool")
        if tool is None:
            raise SystemExit("xdotool is missing; it moves the mouse of a real screen")
        subprocess.run([tool, *text], check=True, timeout=10)  # noqa: S603  found above
        QTest.qWait(60)


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
