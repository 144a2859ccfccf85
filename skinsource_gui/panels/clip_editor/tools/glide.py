"""Frequency and amplitude of a glide, as two curves over its waveform."""

from collections.abc import Callable
from dataclasses import fields
from functools import partial

from PySide6.QtCore import QObject, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QFontMetricsF, QPainter
from PySide6.QtWidgets import QMenu

from skinsource.base.arrays import Floats
from skinsource.design.effects.breakpoints import Points
from skinsource.signals.synthesis import Column
from skinsource_gui.panels.clip_editor.content import EditorContent
from skinsource_gui.panels.clip_editor.tools.curve_look import CurveLook
from skinsource_gui.panels.clip_editor.tools.envelope import EnvelopeTool
from skinsource_gui.panels.clip_editor.tools.tool import Button, Held
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.plot.ticks import linear_ticks

_HOW = "Drag the points of frequency and amplitude; a click on a line, or a double click, adds one"
LOOKS: dict[Column, CurveLook] = {
    "frequency": CurveLook(
        colour="error", mirrored=False, unit="Hz", label="Frequency", bends=False, how=_HOW
    ),
    "amplitude": CurveLook(label="Amplitude", highest=1.0, bends=False, how=_HOW),
}
_ROW_PX = 34.0


class FrequencyContent(EditorContent):
    """The same clip, with frequencies upright: 0 at the foot, half the sample rate at the top."""

    def y(self, value: float) -> float:
        return self.area.bottom() - value / self.top_hz * self.area.height()

    def curve(self, times_s: Floats, values: Floats) -> tuple[Floats, Floats]:
        x, _ = super().curve(times_s, values)
        return x, self.area.bottom() - values / self.top_hz * self.area.height()

    def value(self, y_px: float) -> float:
        return (self.area.bottom() - y_px) / self.area.height() * self.top_hz

    @property
    def top_hz(self) -> float:
        """The frequency at the upper edge."""
        return self.sample_rate_hz / 2.0


class GlideTool(QObject):
    """Edits both curves of a glide; the one that was touched last has the keys.

    Parameters
    ----------
    points
        Returns the points of one of them that there are now.

    Attributes
    ----------
    active
        The curve that was touched last.
    tools
        What is done to each.
    """

    #: Which curve, its points, and the number of the gesture or None.
    changed = Signal(str, object, object)
    #: The drag of this number is given up: all is as it was before.
    given_up = Signal(int)

    cursor = Qt.CursorShape.ArrowCursor

    def __init__(self, points: Callable[[Column], Points], parent: QObject) -> None:
        super().__init__(parent)
        self.active: Column = "frequency"
        self.tools: dict[Column, EnvelopeTool] = {}
        for column, look in LOOKS.items():
            tool = EnvelopeTool(partial(points, column), self, look)
            tool.changed.connect(partial(self.changed.emit, column))
            tool.given_up.connect(self.given_up)
            self.tools[column] = tool

    @property
    def other(self) -> Column:
        """The curve that was not."""
        return "amplitude" if self.active == "frequency" else "frequency"

    @property
    def hint(self) -> str:
        return self.tools[self.active].hint

    def flip(self) -> None:
        """Give the keys to the other curve."""
        self.cancel()
        self.active = self.other

    def press(self, content: EditorContent, at: QPointF, button: Button, held: Held) -> None:
        self._touch(content, at)
        self.tools[self.active].press(of_column(content, self.active), at, button, held)

    def move(self, content: EditorContent, at: QPointF, held: Held) -> None:
        for column, tool in self.tools.items():
            tool.move(of_column(content, column), at, held)

    def release(self, content: EditorContent) -> None:
        self.tools[self.active].release(of_column(content, self.active))

    def double_click(self, content: EditorContent, at: QPointF) -> None:
        self._touch(content, at)
        self.tools[self.active].double_click(of_column(content, self.active), at)

    def fill_menu(self, menu: QMenu, content: EditorContent, at: QPointF | None) -> None:
        if at is not None:
            self._touch(content, at)
        self.tools[self.active].fill_menu(menu, of_column(content, self.active), at)

    def cancel(self) -> bool:
        given_up = False
        for tool in self.tools.values():
            given_up = tool.cancel() or given_up
        return given_up

    def forget(self) -> None:
        """Let no point be chosen."""
        for tool in self.tools.values():
            tool.chosen = ()

    def paint(self, painter: QPainter, content: EditorContent, theme: Theme) -> None:
        """Paint both curves, the one that has the keys last, and what frequencies lie where."""
        own = of_column(content, "frequency")
        self._paint_scale(painter, own, theme)
        for column in (self.other, self.active):
            painter.setOpacity(1.0 if column == self.active else 0.6)
            self.tools[column].paint(painter, of_column(content, column), theme)
        painter.setOpacity(1.0)

    def _touch(self, content: EditorContent, at: QPointF) -> None:
        """Take the curve that passes here, if one does; of two, the one that was touched last."""
        for column in (self.active, self.other):
            if self.tools[column].is_near(of_column(content, column), at):
                if column != self.active:
                    self.tools[self.active].chosen = ()
                self.active = column
                return

    def _paint_scale(self, painter: QPainter, content: EditorContent, theme: Theme) -> None:
        area, metrics = content.area, QFontMetricsF(painter.font())
        painter.setPen(QColor(theme.error))
        top_hz = content.sample_rate_hz / 2.0
        for tick in linear_ticks(0.0, top_hz, max(area.height() / _ROW_PX, 2)):
            y = content.y(tick.value)
            words = f"{tick.label} Hz"
            width, height = metrics.horizontalAdvance(words), metrics.height()
            room = QRectF(area.right() - width - 4, y - height / 2, width, height)
            if room.top() >= area.top() and room.bottom() <= area.bottom():
                painter.drawText(room, Qt.AlignmentFlag.AlignCenter, words)


def of_column(content: EditorContent, column: Column) -> EditorContent:
    """The content with the values of a curve upright."""
    if column == "amplitude":
        return content
    return FrequencyContent(**{one.name: getattr(content, one.name) for one in fields(content)})
