"""What all editors share: their protocol, gestures, marks of errors, and units beside numbers."""

from collections.abc import Callable
from itertools import count
from typing import Any, Protocol

from PySide6.QtCore import QObject, QRect, QRectF, Qt, QTimer
from PySide6.QtGui import QColor, QFont, QPainter, QPen, QTextCharFormat, QTextCursor
from PySide6.QtWidgets import (
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QStyle,
    QStyleOptionFrame,
    QTextEdit,
    QWidget,
)

from skinsource.specs.spec import Spec
from skinsource_gui.qt.theme import Theme, current_theme


class Editor(Protocol):
    """Edits one value with the widget ``field``.

    Attributes
    ----------
    label
        The label, where the widget contains it and takes the whole width; else None.
    edited
        Signal: the new value, number of the gesture or None.
    problem_changed
        Signal: why the input is not allowed, or "".
    """

    @property
    def field(self) -> QWidget: ...

    @property
    def label(self) -> QLabel | None: ...

    @property
    def edited(self) -> Any: ...

    @property
    def problem_changed(self) -> Any: ...

    def set_value(self, value: Any) -> None:
        """Show a value without a signal."""

    def set_spec(self, spec: Any) -> None:
        """Change the allowed values."""

    def advice(self) -> str:
        """Return a remark on the present value, or ""."""

    def mark_error(self, reason: str) -> None:
        """Mark the error in the input for which an edit was refused."""

    def cancel(self) -> None:
        """Forget what is being typed."""


#: Makes the editor for a field.
NewEditor = Callable[[Spec, QWidget], Editor]


_numbers = count(1)


def new_gesture() -> int:
    """Return a new number for a gesture; edits that share it are one step of undo."""
    return next(_numbers)


#: A pause as long as this ends a burst.
PAUSE_MS = 600


class Burst(QObject):
    """Gives quick successive steps one gesture number, so that they are one step of undo."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._gesture = 0
        self._pause = QTimer(self)
        self._pause.setSingleShot(True)
        self._pause.setInterval(PAUSE_MS)

    @property
    def active(self) -> bool:
        """Whether the next step has the same number as the last one."""
        return self._pause.isActive()

    def gesture(self) -> int:
        """Return the gesture number of a step that happens now."""
        if not self.active:
            self._gesture = new_gesture()
        self._pause.start()
        return self._gesture

    def end(self) -> None:
        """Let the next step begin a new burst."""
        self._pause.stop()


class TextMark:
    """Underlines the place in ``text`` where reading stopped, and frames the text."""

    def __init__(self, text: QPlainTextEdit) -> None:
        self._text = text
        self.column: int | None = None

    def put(self, column: int | None) -> None:
        """Mark a letter, counted from 1; None: there is no error."""
        self.column = column
        letters, marks = self._text.toPlainText(), []
        if column is not None and letters:
            mark = QTextEdit.ExtraSelection()
            # At the end of the text the last letter is underlined.
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
        """Frame the text, while it is painted, if there is an error."""
        if self.column is not None:
            painter = QPainter(self._text.viewport())
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(QPen(QColor(current_theme().error), 2))
            inside = QRectF(self._text.viewport().rect()).adjusted(1, 1, -1, -1)
            painter.drawRoundedRect(inside, 4, 4)
            painter.end()


_GAP_PX = 4
# Qt leaves this at each side of the text of a line edit.
_TEXT_EDGE_PX = 2


class UnitBeside:
    """Keeps room for a unit at the right end of ``line``, and paints it there.

    There is at least room for the unit ``widest``, so that digits of several lines align.
    """

    def __init__(self, line: QLineEdit, widest: str) -> None:
        self._line, self._widest = line, widest

    @property
    def room_px(self) -> int:
        """Width for the number."""
        margins = self._line.textMargins()
        return _inside(self._line).width() - margins.right() - 2 * _TEXT_EDGE_PX

    def width_px(self, number: str) -> int:
        """Return the width of a line that just fits a number."""
        edges_px = self._line.width() - self.room_px
        return edges_px + self._line.fontMetrics().horizontalAdvance(number)

    def make_room(self, symbol: str) -> None:
        """Keep room for a unit, or for the widest unit."""
        widths = map(self._line.fontMetrics().horizontalAdvance, (symbol, self._widest))
        self._line.setTextMargins(0, 0, max(widths) + _GAP_PX, 0)

    def paint(self, painter: QPainter, symbol: str, theme: Theme) -> None:
        """Paint the unit."""
        place = _inside(self._line)
        place.setLeft(place.right() - self._line.textMargins().right() + _GAP_PX)
        painter.setPen(QColor(theme.dim))
        painter.drawText(place, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, symbol)


def _inside(line: QLineEdit) -> QRect:
    """Return the area of the text and the unit."""
    option = QStyleOptionFrame()
    line.initStyleOption(option)
    return line.style().subElementRect(QStyle.SubElement.SE_LineEditContents, option, line)
