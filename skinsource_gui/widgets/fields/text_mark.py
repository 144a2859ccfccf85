"""The place in a text where reading stopped."""

from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QFont, QPainter, QPen, QTextCharFormat, QTextCursor
from PySide6.QtWidgets import QPlainTextEdit, QTextEdit

from skinsource_gui.theme import current_theme


class TextMark:
    """Underlines that place, and frames the text that could not be read.

    Parameters
    ----------
    text
        Where it is marked.
    """

    def __init__(self, text: QPlainTextEdit) -> None:
        self._text = text
        self.column: int | None = None

    def put(self, column: int | None) -> None:
        """Mark the letter of that number, from 1; None: all could be read."""
        self.column = column
        letters, marks = self._text.toPlainText(), []
        if column is not None and letters:
            mark = QTextEdit.ExtraSelection()
            # At the end there is nothing to underline but the last letter.
            start = min(column, len(letters)) - 1
            mark.cursor = QTextCursor(self._text.document())
            mark.cursor.setPosition(start)
            mark.cursor.setPosition(start + 1, QTextCursor.MoveMode.KeepAnchor)
            style = QTextCharFormat()
            style.setForeground(QColor(current_theme().error))
            style.setUnderlineColor(QColor(current_theme().error))
            style.setUnderlineStyle(QTextCharFormat.UnderlineStyle.SingleUnderline)
            style.setFontWeight(QFont.Weight.Bold)
            mark.format = style
            marks.append(mark)
        self._text.setExtraSelections(marks)
        self._text.viewport().update()

    def paint_frame(self) -> None:
        """Frame the text, while it is painted, if there is a mark."""
        if self.column is not None:
            painter = QPainter(self._text.viewport())
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(QPen(QColor(current_theme().error), 2))
            inside = QRectF(self._text.viewport().rect()).adjusted(1, 1, -1, -1)
            painter.drawRoundedRect(inside, 4, 4)
            painter.end()
