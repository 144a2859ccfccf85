"""Hands for the walkthrough: mouse, keys, pictures, and what was expected of them."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from unittest.mock import patch

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractScrollArea, QApplication, QFileDialog, QMessageBox, QWidget

from skinsource_gui.shell.window import MainWindow

NONE = Qt.KeyboardModifier.NoModifier
SHIFT = Qt.KeyboardModifier.ShiftModifier
CONTROL = Qt.KeyboardModifier.ControlModifier
LEFT = Qt.MouseButton.LeftButton
_PATIENCE_MS, _LOOK_MS = 30_000, 20


class Driver:
    """Uses a window as a person does, and takes a picture after each step.

    Parameters
    ----------
    window
        The studio.
    folder
        Where pictures go.
    """

    def __init__(self, window: MainWindow, folder: Path) -> None:
        self.window, self._folder = window, folder
        self._count = 0
        self.disappointments: list[str] = []

    def expect(self, holds: bool, sentence: str) -> None:
        """Note ``sentence`` if it does not hold."""
        if not holds:
            self.disappointments.append(sentence)
            print(f"  NOT SO: {sentence}")

    def settle(self) -> None:
        """Wait until everything is computed and painted."""
        for _ in range(3):
            QApplication.processEvents()
            self.window.catch_up()
        QApplication.processEvents()

    def waited(self, holds: Callable[[], bool]) -> bool:
        """Whether ``holds`` comes true within half a minute; the window lives meanwhile."""
        for _ in range(_PATIENCE_MS // _LOOK_MS):
            if holds():
                return True
            QTest.qWait(_LOOK_MS)
        return holds()

    def picture(self, label: str, widget: QWidget | None = None) -> None:
        """Photograph the window, or a part or dialog of it."""
        self.settle()
        self._count += 1
        name = f"{self._count:02d}-{label.replace(' ', '-')}.png"
        (widget or self.window).grab().save(str(self._folder / name))

    def widget(self, name: str, inside: QWidget | None = None) -> QWidget:
        """The visible widget called ``name``."""
        widgets = (inside or self.window).findChildren(QWidget, name)
        return next(widget for widget in widgets if widget.isVisible())

    def surface(self, name: str, inside: QWidget) -> QWidget:
        """What takes the mouse in a plot called ``name``."""
        widget = self.widget(name, inside)
        return widget.viewport() if isinstance(widget, QAbstractScrollArea) else widget

    def click(self, widget: QWidget, at: QPoint | None = None, modifiers=NONE) -> None:
        """Click; in the middle if no place is named."""
        QTest.mouseClick(widget, LEFT, modifiers, at or widget.rect().center())
        self.settle()

    def double_click(self, widget: QWidget, at: QPoint | None = None) -> None:
        """Double click, with the click that comes first."""
        where = at or widget.rect().center()
        QTest.mouseClick(widget, LEFT, NONE, where)
        QTest.mouseDClick(widget, LEFT, NONE, where)
        self.settle()

    def drag(
        self, widget: QWidget, start: QPoint, end: QPoint, label: str = "", modifiers=NONE
    ) -> None:
        """Press, move in ten steps, take a picture if it has ``words``, and let go."""
        QTest.mousePress(widget, LEFT, modifiers, start)
        for step in range(1, 11):
            here = QPointF(start + (end - start) * step / 10)
            event = QMouseEvent(
                QMouseEvent.Type.MouseMove,
                here,
                widget.mapToGlobal(here),
                LEFT,
                LEFT,
                modifiers,
            )
            QApplication.sendEvent(widget, event)
            QApplication.processEvents()
        if label:
            self.picture(label)
        QTest.mouseRelease(widget, LEFT, modifiers, end)
        self.settle()

    def hover(self, widget: QWidget, at: QPoint) -> None:
        """Move the mouse there; where it stands already, a move is no event."""
        for place in (at + QPoint(3, 0), at):
            QTest.mouseMove(widget, place)
            self.settle()

    def wheel(self, widget: QWidget, notches: int, at: QPoint | None = None, modifiers=NONE):
        """Turn the wheel."""
        here = QPointF(at or widget.rect().center())
        event = QWheelEvent(
            here,
            widget.mapToGlobal(here),
            QPoint(),
            QPoint(0, 120 * notches),
            Qt.MouseButton.NoButton,
            modifiers,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        QApplication.sendEvent(widget, event)
        self.settle()

    def key(self, key: Qt.Key, modifiers=NONE, times: int = 1) -> None:
        """Press a key, wherever the focus is."""
        if QApplication.activeWindow() is None:
            self.window.activateWindow()  # as a window manager does
            self.settle()
        for _ in range(times):
            QTest.keyClick(QApplication.focusWidget() or self.window, key, modifiers)
        self.settle()

    def type(self, text: str) -> None:
        """Type, wherever the focus is, after a moment that ends what was typed before."""
        QTest.qWait(QApplication.keyboardInputInterval() + 50)
        for letter in text:
            QTest.keyClick(QApplication.focusWidget(), letter)
        self.settle()

    def focus(self, widget: QWidget) -> None:
        """Go there as the Tab key does."""
        widget.setFocus(Qt.FocusReason.TabFocusReason)
        self.settle()

    @contextmanager
    def answering(
        self, path: Path | str = "", answer=QMessageBox.StandardButton.Cancel
    ) -> Iterator[list[tuple]]:
        """Answer file dialogs with ``path`` and questions with ``answer``; give what was asked."""
        asked: list[tuple] = []

        def name_file(*arguments: object) -> tuple[str, str]:
            asked.append(arguments)
            return str(path), ""

        def reply(*arguments: object) -> QMessageBox.StandardButton:
            asked.append(arguments)
            return answer

        with (
            patch.object(QFileDialog, "getOpenFileName", name_file),
            patch.object(QFileDialog, "getSaveFileName", name_file),
            patch.object(QMessageBox, "question", reply),
        ):
            yield asked
