"""What every tool is."""

from typing import Protocol

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QMenu

from skinsource_gui.panels.clip_editor.content import EditorContent
from skinsource_gui.theme import Theme

Held = Qt.KeyboardModifier
Button = Qt.MouseButton


class Tool(Protocol):
    """Something that the pointer does."""

    cursor: Qt.CursorShape

    @property
    def hint(self) -> str:
        """How to begin, while nothing has begun; empty where that is clear."""

    def press(self, content: EditorContent, at: QPointF, button: Button, held: Held) -> None:
        """A button went down."""

    def move(self, content: EditorContent, at: QPointF, held: Held) -> None:
        """The pointer moved, with a button down or without."""

    def release(self, content: EditorContent) -> None:
        """The button went up."""

    def double_click(self, content: EditorContent, at: QPointF) -> None:
        """The left button was pressed twice."""

    def fill_menu(self, menu: QMenu, content: EditorContent, at: QPointF | None) -> None:
        """Fill the menu of the right button there, or that of what the keys are about.

        A tool that needs the button itself offers nothing.
        """

    def cancel(self) -> bool:
        """Give up what has begun; whether anything had."""

    def paint(self, painter: QPainter, content: EditorContent, theme: Theme) -> None:
        """Paint what belongs to the tool over the curve."""
