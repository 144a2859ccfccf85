"""What every tool is."""

from typing import Protocol

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QPainter

from skinsource_gui.panels.clip_editor.content import EditorContent
from skinsource_gui.theme import Theme

Held = Qt.KeyboardModifier
Button = Qt.MouseButton


class Tool(Protocol):
    """Something that the pointer does."""

    cursor: Qt.CursorShape

    def press(self, content: EditorContent, at: QPointF, button: Button, held: Held) -> None:
        """A button went down."""

    def move(self, content: EditorContent, at: QPointF, held: Held) -> None:
        """The pointer moved, with a button down or without."""

    def release(self, content: EditorContent) -> None:
        """The button went up."""

    def double_click(self, content: EditorContent, at: QPointF) -> None:
        """The left button was pressed twice."""

    def cancel(self) -> bool:
        """Give up what has begun; whether anything had."""

    def paint(self, painter: QPainter, content: EditorContent, theme: Theme) -> None:
        """Paint what belongs to the tool over the curve."""
