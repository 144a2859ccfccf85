"""What a cell asks of that which edits its value."""

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
    """A widget that edits one value, and what a cell has to know of it.

    Attributes
    ----------
    field
        The widget.
    label
        The label, where the widget holds it itself and takes the whole width; else None.
    edited
        Signal: the new value, number of the gesture or None.
    problem_changed
        Signal: why what is entered is not allowed, or "".
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
        """Show a value, and tell nobody."""

    def set_spec(self, spec: Any) -> None:
        """Change what is allowed."""

    def advice(self) -> str:
        """What one should know about the present value, or ""."""

    def refuse(self, reason: str) -> None:
        """Show where in what is entered the reason lies for which it was refused."""

    def cancel(self) -> None:
        """Forget what is being entered."""


#: Makes the editor for a field.
NewEditor = Callable[[Spec, QWidget], Editor]


# Numbers that tell one drag, or one turn of the wheel, from the next.

_numbers = count(1)


def new_gesture() -> int:
    """Return a number that no gesture had before; edits that share it undo as one step."""
    return next(_numbers)


# Steps that follow each other quickly belong together.

#: A pause as long as this ends a burst.
PAUSE_MS = 600


class Burst(QObject):
    """One gesture number for all steps between two pauses, so that they undo as one."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._gesture = 0
        self._pause = QTimer(self)
        self._pause.setSingleShot(True)
        self._pause.setInterval(PAUSE_MS)

    @property
    def active(self) -> bool:
        """Whether the next step belongs to the last one."""
        return self._pause.isActive()

    def gesture(self) -> int:
        """Gesture number of a step that happens now."""
        if not self.active:
            self._gesture = new_gesture()
        self._pause.start()
        return self._gesture

    def end(self) -> None:
        """Let the next step begin a new burst."""
        self._pause.stop()


# The place in a text where reading stopped.


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


# The unit that stands in a line of text, right of a number.

_GAP_PX = 4
# Qt leaves this at each side of the text of a line edit.
_TEXT_EDGE_PX = 2


class UnitBeside:
    """Keeps room for a unit at the right end of a line, and paints it there.

    Parameters
    ----------
    line
        Where it stands.
    widest
        Unit for which there is room at least, so that digits align with those of other lines.
    """

    def __init__(self, line: QLineEdit, widest: str) -> None:
        self._line, self._widest = line, widest

    @property
    def room_px(self) -> int:
        """Width that is left for the number."""
        margins = self._line.textMargins()
        return _inside(self._line).width() - margins.right() - 2 * _TEXT_EDGE_PX

    def width_px(self, number: str) -> int:
        """Width of a line that has just room for a number."""
        edges_px = self._line.width() - self.room_px
        return edges_px + self._line.fontMetrics().horizontalAdvance(number)

    def make_room(self, symbol: str) -> None:
        """Keep room for a unit, or for the widest one."""
        widths = map(self._line.fontMetrics().horizontalAdvance, (symbol, self._widest))
        self._line.setTextMargins(0, 0, max(widths) + _GAP_PX, 0)

    def paint(self, painter: QPainter, symbol: str, theme: Theme) -> None:
        """Write the unit."""
        place = _inside(self._line)
        place.setLeft(place.right() - self._line.textMargins().right() + _GAP_PX)
        painter.setPen(QColor(theme.dim))
        painter.drawText(place, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, symbol)


def _inside(line: QLineEdit) -> QRect:
    """Area of the text and the unit."""
    option = QStyleOptionFrame()
    line.initStyleOption(option)
    return line.style().subElementRect(QStyle.SubElement.SE_LineEditContents, option, line)
