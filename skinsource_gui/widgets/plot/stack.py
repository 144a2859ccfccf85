"""Everything in the scene of a plot: rows over one x axis, words, and the band of a drag."""

from collections.abc import Callable, Sequence
from typing import TypeVar

import pyqtgraph
from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QFont, QPen
from PySide6.QtWidgets import QGraphicsRectItem

from skinsource_gui.theme import UNIT_PX, current_theme
from skinsource_gui.widgets.plot.axis import Axis
from skinsource_gui.widgets.plot.curve_points import CurvePoints
from skinsource_gui.widgets.plot.plot_layout import PlotLayout
from skinsource_gui.widgets.plot.plot_row import PlotRow
from skinsource_gui.widgets.plot.plot_words import HeaderLine, Message
from skinsource_gui.widgets.plot.ticks import Tick
from skinsource_gui.widgets.plot.view_box import PlotViewBox
from skinsource_gui.widgets.plot.x_window import XWindow

_NOTHING_HERE = "Nothing to see in this part. Press 0 to show everything."
_BAND_ALPHA = 48

_Part = TypeVar("_Part")


class Stack:
    """Equally high rows over one x axis, or a message.

    Attributes
    ----------
    rows
        Those in use, from the top.
    header, x_axis
        Above and below them.
    message, hint
        What is said in place of curves, and over them.
    band
        What a drag covers.
    """

    def __init__(
        self,
        scene: pyqtgraph.GraphicsScene,
        font: QFont,
        watch: Sequence[Callable[[PlotViewBox], None]],
    ) -> None:
        self._scene, self._watch = scene, watch
        self._font = font
        self._message_font = font
        self._window: XWindow | None = None
        self._n_axes = 0
        self._pool: list[PlotRow] = []
        self.rows: list[PlotRow] = []
        self.header = HeaderLine()
        self.x_axis = Axis("bottom", self._x_ticks)
        self.message, self.hint = Message(), Message()
        self.band = QGraphicsRectItem()
        self.band.setZValue(5)
        for item in (self.header, self.x_axis, self.message, self.hint, self.band):
            scene.addItem(item)
        self.say("")

    def show_fonts(self, font: QFont, message_font: QFont) -> None:
        """Take over fonts around the curves and in place of them, and the colours in use."""
        theme = current_theme()
        self._font, self._message_font = font, message_font
        self.header.show_font(font)
        self.x_axis.show_font(font)
        for row in self._pool:
            row.show_font(font)
        self.message.say(self.message.text, QColor(theme.dim), message_font)
        self.hint.say(self.hint.text, QColor(theme.dim), font)
        accent = QColor(theme.accent)
        self.band.setPen(QPen(accent, 0))
        accent.setAlpha(_BAND_ALPHA)
        self.band.setBrush(accent)

    def say(self, message: str) -> None:
        """Empty the picture and say ``message`` in its middle."""
        for row in self._pool:
            row.show_points(())
            row.show_crosshair(None, (), ())
        self._use(0)
        self.header.hide()
        self.x_axis.hide()
        self.band.hide()
        self.hint.say("", QColor(), self._font)
        self.message.say(message, QColor(current_theme().dim), self._message_font)

    def place(self, layout: PlotLayout, window: XWindow) -> None:
        """Show ``layout`` around ``window``, in place of a message."""
        new_window, self._window = window != self._window, window
        if self.message.text:
            self.message.say("", QColor(), self._message_font)
        self._use(layout.n_rows)
        self.header.setGeometry(QRectF(layout.left, 0, layout.right - layout.left, layout.top - 1))
        self.header.say(layout.header)
        for rank, row in enumerate(self.rows):
            row.place(layout, rank)
            row.show_range(window.shown)
        below = layout.height - layout.bottom
        self.x_axis.setHeight(below)
        self.x_axis.setGeometry(QRectF(0, layout.bottom, layout.width, below))
        self.x_axis.say(window.axis.titles, window.band)
        if new_window:
            self.x_axis.refresh()
        self.hint.setGeometry(layout.area)
        hint = "" if window.holds_data else _NOTHING_HERE
        self.hint.say(hint, QColor(current_theme().dim), self._font)

    def place_message(self, room: QRectF) -> None:
        """Say messages inside ``room``."""
        self.message.setGeometry(room.adjusted(2 * UNIT_PX, UNIT_PX, -2 * UNIT_PX, -UNIT_PX))

    def show_points(self, points: tuple[CurvePoints, ...]) -> None:
        """Draw curves: all of them in the one row, or one in each."""
        for row, of_row in zip(self.rows, self._by_row(points), strict=True):
            row.show_points(of_row)

    def show_colours(self, numbers: Sequence[int], *, stale: bool, n_axes: int = 0) -> None:
        """Give curves the pens of their ranks, and rows of a stack their ``numbers``, if any.

        Where each row has curves along ``n_axes``, they have the colours of axes.
        """
        self._n_axes = n_axes
        # One pixel of the screen: any wider line takes a hundred times as long.
        pens = [current_theme().output_pen(rank, 0.0) for rank in range(self._n_curves())]
        if n_axes:
            pens = [QPen(colour, 0.0) for colour in self._colours(len(pens))]
        for row, of_row in zip(self.rows, self._by_row(pens), strict=True):
            row.show_pens(of_row, stale=stale)
        for rank, row in enumerate(self.rows):
            text = str(numbers[rank] or "") if numbers else ""
            row.number.say(text, current_theme().output_colour(rank), self._font)

    def show_crosshair(self, position: float | None, heights: Sequence[float]) -> None:
        """Read each curve at ``position``, or nothing."""
        of_rows = zip(self._by_row(heights), self._by_row(self._colours(len(heights))), strict=True)
        for row, (of_row, of_dots) in zip(self.rows, of_rows, strict=True):
            row.show_crosshair(position, of_row, of_dots)

    def show_band(self, area: QRectF | None) -> None:
        """Show what a drag covers, or nothing."""
        self.band.setVisible(area is not None)
        if area is not None:
            self.band.setRect(area)

    def _by_row(self, parts: Sequence[_Part]) -> list[Sequence[_Part]]:
        if len(self.rows) == 1:
            return [parts]
        each = max(len(parts) // max(len(self.rows), 1), 1)
        return [parts[rank * each : (rank + 1) * each] for rank in range(len(self.rows))]

    def _colours(self, n_curves: int) -> list[QColor]:
        if not self._n_axes:
            return [current_theme().output_colour(rank) for rank in range(n_curves)]
        return [current_theme().axis_colour(rank % self._n_axes) for rank in range(n_curves)]

    def _n_curves(self) -> int:
        return sum(row.n_curves for row in self.rows)

    def _use(self, count: int) -> None:
        if count == len(self.rows):
            return
        while len(self._pool) < count:
            row = PlotRow(self._scene)
            row.show_font(self._font)
            for follow in self._watch:
                follow(row.view)
            self._pool.append(row)
        for rank, row in enumerate(self._pool):
            row.set_visible(rank < count)
        self.rows = self._pool[:count]
        self.header.setVisible(count > 0)
        self.x_axis.setVisible(count > 0)
        if self.rows:
            self.x_axis.set_views(*(row.view for row in self.rows))

    def _x_ticks(self, low: float, high: float, width_px: float) -> tuple[Tick, ...]:
        return () if self._window is None else self._window.axis.ticks(low, high, width_px)
