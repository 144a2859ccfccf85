"""Where curves are drawn: no toolbar, no legend, no mouse."""

import numpy as np
from PySide6.QtCore import QEvent, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFontMetricsF,
    QHelpEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
)
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from skinsource_gui.theme import LIGHT, Theme, tabular
from skinsource_gui.widgets.kept_picture import KeptPicture
from skinsource_gui.widgets.plot.crosshair import REACH_PX, CrosshairPicture, paint_crosshair
from skinsource_gui.widgets.plot.curve_lines import (
    CurveLine,
    curve_lines,
    drawn_curves,
    paint_lines,
)
from skinsource_gui.widgets.plot.curves import Curves
from skinsource_gui.widgets.plot.frame_layout import Content, Words, laid_out
from skinsource_gui.widgets.plot.plot_axis import ValueUnit, XAxis, value_unit
from skinsource_gui.widgets.plot.plot_frame import Frame, paint_frame, paint_message
from skinsource_gui.widgets.plot.plot_rows import Rows, row_count
from skinsource_gui.widgets.plot.ranges import HeldRange, Range
from skinsource_gui.widgets.plot.x_window import XWindow, x_window

_NOT_FINITE = "The response has values that are not finite numbers."


class PlotCanvas(QWidget):
    """Curves over one x axis, in one row or in one row each, with a crosshair.

    Ranges are decided once for each update.  What is around the curves is kept as a picture.

    Attributes
    ----------
    curves, message
        What is drawn, or ``None``; what is said in place of curves, or nothing.
    rows, unit
        Rows with the range of their values; how values are written.
    window
        Visible part of the x axis.
    frame
        What is around the curves.
    lines
        The curves as they are drawn, px.
    cursor
        Index of the sample under the crosshair, or ``None``.
    """

    #: The crosshair reads something else: `cursor` and what is drawn are up to date.
    reading_changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(160, 90)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        # All of it is painted: nothing behind needs to be.
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.theme = LIGHT
        self.curves: Curves | None = None
        self.message = ""
        self.rows = Rows(count=1, values=(0.0, 1.0))
        self.unit: ValueUnit = value_unit("amplitude", 0.0, 1.0)
        self.window: XWindow = x_window(XAxis(titles=("",), unit=""), (0.0, 1.0), None)
        self.frame = Frame(width=1, height=1, plot=(0, 0, 1, 1))
        self.lines: tuple[CurveLine, ...] = ()
        self.cursor: int | None = None
        self._font = tabular(self.font())
        self._font.setPointSizeF(self._font.pointSizeF() * 0.9)
        self._zoom: Range | None = None
        self._stacked = False
        self._words = Words()
        self._held = HeldRange()
        self._content: Content | None = None
        self._still = KeptPicture()

    def sizeHint(self) -> QSize:
        return QSize(256, 192)

    def set_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self.theme = theme
        self.update()

    def set_view(self, axis: XAxis, zoom: Range | None, *, stacked: bool) -> None:
        """X axis, its visible part in SI (``None``: all), and one row for each curve or one."""
        if (axis, zoom, stacked) != (self.window.axis, self._zoom, self._stacked):
            self.window = x_window(axis, self._data_range(), zoom)
            self._zoom, self._stacked = zoom, stacked
            self._draw()
            self.reading_changed.emit()

    def set_words(self, words: Words) -> None:
        """Words around the curves."""
        if words != self._words:
            self._words = words
            self._draw_frame()

    def show_curves(self, curves: Curves) -> None:
        """Draw ``curves`` in place of those before; zoom and crosshair stay."""
        low, high = float(curves.y.min()), float(curves.y.max())
        if not (np.isfinite(low) and np.isfinite(high)):
            self.show_message(_NOT_FINITE)
            return
        if self.curves is not None and self.cursor is not None:
            self.cursor = curves.nearest(float(self.curves.x[self.cursor]))
        self.curves, self.message = curves, ""
        values = self._held.follow(low, high, curves.kind)
        self.rows = Rows(count=self.rows.count, values=values)
        self.unit = value_unit(curves.kind, *values)
        self.window = x_window(self.window.axis, self._data_range(), self._zoom)
        self._draw()
        self.reading_changed.emit()

    def show_message(self, message: str) -> None:
        """Empty the picture and say ``message`` in its middle."""
        if self.curves is None and message == self.message:
            return
        self.curves, self.message, self.cursor, self._content = None, message, None, None
        self.lines = ()
        self.update()
        self.reading_changed.emit()

    def set_cursor(self, index: int | None) -> None:
        """Put the crosshair on sample ``index``."""
        if index != self.cursor:
            self._update_crosshair()
            self.cursor = index
            self._update_crosshair()
            self.reading_changed.emit()

    def crosshair(self) -> CrosshairPicture | None:
        """Where the crosshair is, px; ``None`` where there is none in the visible part."""
        if self.curves is None or self.cursor is None:
            return None
        x = float(self.curves.x[self.cursor])
        if self.window.axis.log and x <= 0:
            return None
        part = self.window.part(self.window.axis.position(x))
        if not 0 <= part <= 1:
            return None
        left, top, width, height = self.frame.plot
        heights = [
            self.rows.height(float(self.curves.y[rank, self.cursor]), rank if self._stacked else 0)
            for rank in range(drawn_curves(self.curves, self.rows, stacked=self._stacked))
        ]
        ys = tuple(top + height * (1 - at / self.rows.count) for at in heights)
        return CrosshairPicture(x=left + width * part, ys=ys)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        still = (self.theme, self.message if self.curves is None else self.frame)
        ground = QColor(self.theme.base)
        self._still.paint(painter, QRectF(self.rect()), still, self._paint_still, ground)
        if self.lines:
            area = self.frame.area
            paint_lines(painter, self.lines, area, self.theme, stale=self._words.stale)
        self.paint_over(painter)
        painter.end()

    def paint_over(self, painter: QPainter) -> None:
        """Paint what comes on top of the curves."""
        picture = self.crosshair()
        if picture is not None:
            paint_crosshair(painter, picture, self.frame.area, self.theme)

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            QToolTip.showText(event.globalPos(), self._hint_at(event.y()), self)
            return True
        return super().event(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._draw()

    def _hint_at(self, y_px: float) -> str:
        # What the words above and below the plot say when there is room for them.
        if self.curves is None or self.frame.area.top() <= y_px <= self.frame.area.bottom():
            return ""
        texts = self.frame.notes if y_px < self.frame.area.top() else self.frame.titles
        return texts[0] if texts else ""

    def _data_range(self) -> Range:
        if self.curves is None:
            return (0.0, 1.0)
        return (float(self.curves.x[0]), float(self.curves.x[-1]))

    def _draw(self) -> None:
        self._draw_frame()
        if self.curves is not None:
            area, ratio = self.frame.area, self.devicePixelRatioF()
            self.lines = curve_lines(
                self.curves, self.window, self.rows, area, stacked=self._stacked, ratio=ratio
            )
            # The crosshair's dots reach a little beyond.
            reach = (-REACH_PX, -REACH_PX, REACH_PX, REACH_PX)
            self.update(area.toAlignedRect().adjusted(*reach))

    def _draw_frame(self) -> None:
        curves = self.curves
        if curves is None:
            self.update()
            return
        count = row_count(len(curves.names), stacked=self._stacked)
        self.rows = Rows(count=count, values=self.rows.values)
        content = Content(
            width=float(self.width()),
            height=float(self.height()),
            window=self.window,
            rows=self.rows,
            stacked=self._stacked,
            unit=self.unit,
            level=curves.kind == "level",
            numbers=tuple(name.number for name in curves.names),
            words=self._words,
        )
        if content != self._content:
            self._content = content
            self.frame = laid_out(content, QFontMetricsF(self._font), self.frame.plot[0])
            self.update()

    def _paint_still(self, painter: QPainter) -> None:
        """Paint all but curves and crosshair."""
        if self.curves is not None:
            paint_frame(painter, self.frame, self.theme, self._font)
        elif self.message:
            paint_message(painter, QRectF(self.rect()), self.message, self.theme, self.font())

    def _update_crosshair(self) -> None:
        picture = self.crosshair()
        if picture is not None:
            left = int(picture.x) - REACH_PX
            self.update(left, 0, 2 * REACH_PX + 1, self.height())
