"""A pen that draws samples."""

from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QColor, QPainter, QPen
from PySide6.QtWidgets import QMenu

from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.signals.drawing import Stroke, drawn_over, zeroed
from skinsource_gui.panels.clip_editor.content import REACH, EditorContent
from skinsource_gui.panels.clip_editor.tools.tool import Button, Held
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.fields.gesture import new_gesture

_FULL = 1.0


class Pen(QObject):
    """Draws freehand; with Shift a straight line; with the right button back to zero.

    One stroke is one step of the history: all its edits share a number.
    """

    #: Samples in place of those before, and the number of the stroke.
    drawn = Signal(object, int)
    #: The stroke is given up: samples as they were, and its number.
    given_up = Signal(int)
    #: Why nothing can be drawn.
    refused = Signal(str)

    cursor = Qt.CursorShape.CrossCursor
    hint = ""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._before: Floats | None = None
        self._stroke = Stroke()
        self._first: tuple[float, float] | None = None
        self._last_s = 0.0
        self._zeroes = False
        self._number = 0
        self._changed = False

    def press(self, content: EditorContent, at: QPointF, button: Button, held: Held) -> None:
        if content.drawn is None or self._first is not None:
            return
        self._zeroes = button == Button.RightButton
        if not self._zeroes and button != Button.LeftButton:
            return
        self._before, self._number, self._changed = content.drawn, new_gesture(), False
        self._first = self._place(content, at)
        self._last_s, self._stroke = self._first[0], Stroke()
        self.move(content, at, held)

    def move(self, content: EditorContent, at: QPointF, held: Held) -> None:
        if self._first is None or self._before is None:
            return
        time_s, value = self._place(content, at)
        rate_hz = content.sample_rate_hz
        try:
            if self._zeroes:
                found = zeroed(self._before, self._first[0], time_s, rate_hz)
            else:
                if held & Held.ShiftModifier:
                    self._stroke = Stroke.through((self._first, (time_s, value)))
                else:
                    self._stroke = self._stroke.to(time_s, value, self._last_s)
                found = drawn_over(self._before, self._stroke, rate_hz)
        except InvalidInputError as error:
            self.refused.emit(str(error))
            return
        self._last_s, self._changed = time_s, True
        self.drawn.emit(found, self._number)

    def release(self, content: EditorContent) -> None:
        self._first = None

    def double_click(self, content: EditorContent, at: QPointF) -> None:
        """Nothing more than a click."""

    def fill_menu(self, menu: QMenu, content: EditorContent, at: QPointF | None) -> None:
        """The right button draws."""

    def cancel(self) -> bool:
        if self._first is None:
            return False
        self._first = None
        if self._changed:
            self.given_up.emit(self._number)
        return True

    def paint(self, painter: QPainter, content: EditorContent, theme: Theme) -> None:
        """Mark the points of the stroke."""
        if self._first is None or self._zeroes:
            return
        painter.setPen(QPen(QColor(theme.accent), 3))
        for time_s, value in self._stroke.points:
            painter.drawPoint(content.at(time_s, value))

    def _place(self, content: EditorContent, at: QPointF) -> tuple[float, float]:
        time_s, value = content.place(at)
        # As far as 1, or as far as is seen of what is louder.
        full = max(_FULL, content.reach) if content.reach > REACH else _FULL
        return max(time_s, 0.0), min(max(value, -full), full)
