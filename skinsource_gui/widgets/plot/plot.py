"""Curves over one x axis, on pyqtgraph: no toolbar, no legend."""

import numpy as np
from PySide6.QtCore import QEvent, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QContextMenuEvent,
    QFontMetricsF,
    QHelpEvent,
    QKeyEvent,
    QMouseEvent,
)
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from skinsource_gui.theme import scaled, tabular
from skinsource_gui.widgets.keys import meaning_of
from skinsource_gui.widgets.paper import PAPER_DOTS
from skinsource_gui.widgets.plot.axis_spec import ValueUnit, XAxis, value_unit
from skinsource_gui.widgets.plot.canvas import Canvas
from skinsource_gui.widgets.plot.crosshair import Crosshair
from skinsource_gui.widgets.plot.curve_points import curve_points, seen_of
from skinsource_gui.widgets.plot.curves import Curves
from skinsource_gui.widgets.plot.decimation import KeptColumns
from skinsource_gui.widgets.plot.navigation import Navigation
from skinsource_gui.widgets.plot.playhead import Playhead
from skinsource_gui.widgets.plot.plot_layout import Content, PlotLayout, Words, laid_out, least_size
from skinsource_gui.widgets.plot.ranges import HeldRange, Range
from skinsource_gui.widgets.plot.stack import Stack
from skinsource_gui.widgets.plot.value_scale import EDGE, ValueScale, row_count
from skinsource_gui.widgets.plot.x_window import XWindow, x_window
from skinsource_gui.widgets.time.playhead_moves import PLAYHEAD

_NOT_FINITE = "The response has values that are not finite numbers."
# A drag shorter than this is a click.
_DRAG_PX = 5
_TEXT = 0.9


class Plot(Canvas):
    """Curves in one row or in one row each, with a crosshair.

    Ranges are decided once for each update; what is around the curves is kept as pictures.

    Parameters
    ----------
    on_paper
        Whether it is drawn for a page, as finely as printers print, not for the screen.

    Attributes
    ----------
    curves
        What is drawn, or ``None``.
    stack
        What is in the scene.
    held
        Decides the range of values, by those of curves before.
    value_scale, unit
        Where values lie in a row; how they are written.
    x_window, zoom, stacked, fitted
        Visible part of the x axis; the rest as `set_view` was told.
    words, words_font
        What is said around the curves, and how it is written.
    places
        Where everything is, px.
    columns
        Where samples fall among columns of pixels.
    crosshair
        What is read.
    navigation
        What mouse and keys ask for.
    playhead
        Where the playhead is, for plots over time.
    """

    key_place = "plot"

    #: The crosshair reads something else: `crosshair` and what is drawn are up to date.
    reading_changed = Signal()
    #: Where on the screen the menu is wanted.
    menu_wanted = Signal(object)
    #: What a key wants of the playhead, see `playhead_keys`.
    playhead_key = Signal(object)

    def __init__(self, parent: QWidget | None = None, *, on_paper: bool = False) -> None:
        super().__init__(parent)
        self._on_paper = on_paper
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setCursor(Qt.CursorShape.CrossCursor)
        self.scene().setMoveDistance(_DRAG_PX)
        self.curves: Curves | None = None
        self.value_scale = ValueScale(values=(0.0, 1.0))
        self.unit: ValueUnit = value_unit("amplitude", 0.0, 1.0)
        self.x_window: XWindow = x_window(XAxis(titles=("",), unit=""), (0.0, 1.0), None)
        self.places = PlotLayout(width=1, height=1, left=0, top=0, right=1, bottom=1, n_rows=1)
        self.words_font = scaled(tabular(self.font()), _TEXT)
        self.zoom: Range | None = None
        self.stacked = self.fitted = False
        self.words, self.held = Words(), HeldRange()
        self.columns = KeptColumns()
        self._content: tuple[Content, XWindow] | None = None
        self.crosshair = Crosshair(self, self)
        self.crosshair.moved.connect(self.reading_changed)
        self.navigation = Navigation(self, self)
        self.playhead = Playhead(self)
        watch = (self.navigation.watch, self.playhead.watch)
        self.stack = Stack(self.scene(), self.words_font, watch)
        self.scene().sigMouseMoved.connect(self.navigation.follow_mouse)
        self.take_look()

    @property
    def message(self) -> str:
        """What is said in place of curves."""
        return self.stack.message.text

    def sizeHint(self) -> QSize:
        return QSize(256, 192)

    def minimumSizeHint(self) -> QSize:
        return least_size(QFontMetricsF(self.words_font))

    def take_look(self) -> None:
        super().take_look()
        self.words_font = scaled(tabular(self.font()), _TEXT)
        self.updateGeometry()
        self.stack.show_fonts(self.words_font, self.font())
        self.playhead.take_colours()
        self._colour()

    def set_view(
        self, axis: XAxis, zoom: Range | None, *, stacked: bool, fitted: bool = False
    ) -> None:
        """X axis, its visible part in SI (``None``: all), one row for each curve or one.

        Values are ``fitted`` to that part, or to all of it.
        """
        view = (self.x_window.axis, self.zoom, self.stacked, self.fitted)
        if (axis, zoom, stacked, fitted) != view:
            data = (0.0, 1.0) if self.curves is None else self.curves.x_range
            self.x_window = x_window(axis, data, zoom)
            fits_other = (fitted or self.fitted) and (fitted, zoom) != (self.fitted, self.zoom)
            self.zoom, self.stacked, self.fitted = zoom, stacked, fitted
            if self.curves is not None and fits_other:
                self._fit(self.curves, self.curves.span or self.curves.reach)
            self.lay_out()
            self.navigation.follow_view()
            self.reading_changed.emit()

    def set_words(self, words: Words) -> None:
        """Words around the curves."""
        if words != self.words:
            self.words = words
            self._place()
            self._colour()

    def begin_anew(self) -> None:
        """Decide the range of the next curves without a look at those before."""
        self.held.let_go()

    def show_curves(self, curves: Curves) -> None:
        """Draw ``curves`` in place of those before; zoom and crosshair stay."""
        reach = curves.reach
        if not np.isfinite(reach).all():
            self.show_message(_NOT_FINITE)
            return
        self.crosshair.follow(curves)
        before, self.curves = self.curves, curves
        self._fit(curves, curves.span or reach)
        self.x_window = x_window(self.x_window.axis, curves.x_range, self.zoom)
        self.lay_out()
        if before is None or (before.names, before.axes) != (curves.names, curves.axes):
            self._colour()
        self.reading_changed.emit()

    def show_message(self, message: str) -> None:
        """Empty the picture and say ``message`` in its middle."""
        if self.curves is None and message == self.message:
            return
        self.curves, self._content = None, None
        self.crosshair.forget()
        self.stack.say(message)
        # While there were curves, the plot may have got another size.
        self._place()
        self.reading_changed.emit()

    def show_band(self, covered: Range | None) -> None:
        """Show what a drag covers, positions, or nothing."""
        if covered is None:
            self.stack.show_band(None)
            return
        area = self.places.area
        start, end = (area.left() + area.width() * self.x_window.part(at) for at in covered)
        self.stack.show_band(QRectF(start, area.top(), end - start, area.height()))

    def claims(self, event: QKeyEvent) -> bool:
        return self.curves is not None and (super().claims(event) or self._moves_playhead(event))

    def viewportEvent(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            QToolTip.showText(event.globalPos(), self._hint_at(event.y()), self)
            return True
        return super().viewportEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.playhead.cancel():
            return
        if self._moves_playhead(event):
            self.playhead_key.emit(event)
        else:
            self.navigation.press(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        # The right button opens the menu, which takes its release: the scene need not know.
        if event.button() == Qt.MouseButton.RightButton:
            event.accept()
        else:
            super().mousePressEvent(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.RightButton:
            super().mouseReleaseEvent(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self.navigation.show_everything()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        self.menu_wanted.emit(event.globalPos())

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.navigation.leave()

    def _moves_playhead(self, event: QKeyEvent) -> bool:
        return self.playhead.time_s is not None and bool(meaning_of(PLAYHEAD, event))

    def _hint_at(self, y_px: float) -> str:
        # What the words above and below the plot say when there is room for them.
        if self.curves is None or self.places.top <= y_px <= self.places.bottom:
            return ""
        return self.places.header.whole if y_px < self.places.top else self.x_window.axis.titles[0]

    def lay_out(self) -> None:
        other_rows = self._place()
        if self.curves is None:
            return
        places = self.places
        each = self.curves.each
        n_drawn = self.curves.n_drawn(places.n_rows, stacked=self.stacked)
        rows = [places.row(rank // each if self.stacked else 0) for rank in range(n_drawn)]
        ratio = PAPER_DOTS if self._on_paper else self.devicePixelRatioF()
        seen = seen_of(self.curves, self.x_window, n_drawn, rows[0], ratio, self.columns)
        fitted = self.fitted and self.zoom is not None
        if found := seen.extremes if fitted else seen.beyond(self.value_scale.values):
            self._fit(self.curves, found)
            self._place()
        self.stack.show_points(curve_points(seen, self.value_scale, rows, ratio))
        if other_rows:  # only now has each row its curves
            self._colour()
        self.crosshair.draw()

    def _fit(self, curves: Curves, found: Range) -> None:
        """Have room for values that were found."""
        values = self.held.follow(*found, curves.kind)
        self.value_scale = ValueScale(values=values, edge=self.value_scale.edge)
        self.unit = value_unit(curves.kind, *values)

    def _place(self) -> bool:  # whether there are more or fewer rows than before
        curves = self.curves
        if curves is None:
            self.stack.place_message(QRectF(self.rect()))
            return False
        count = row_count(len(curves.names), stacked=self.stacked)
        self.value_scale = ValueScale(
            values=self.value_scale.values, edge=EDGE if count > 1 else 0.0
        )
        content = Content(
            width=float(self.width()),
            height=float(self.height()),
            n_rows=count,
            scale=self.value_scale,
            stacked=self.stacked,
            unit=self.unit,
            level=curves.level_words if curves.kind == "level" else "",
            matched=curves.matched,
            n_curves=len(curves.names),
            scaling=curves.scaling,
            words=self.words,
        )
        other_rows = self._content is None or self._content[0].n_rows != count
        if (content, self.x_window) != self._content:
            self._content = (content, self.x_window)
            self.places = laid_out(content, QFontMetricsF(self.words_font), self.places.left)
            self.stack.place(self.places, self.x_window)
        return other_rows

    def _colour(self) -> None:
        names = () if self.curves is None or not self.stacked else self.curves.names
        n_axes = 0 if self.curves is None else len(self.curves.axes)
        numbers = [name.number for name in names]
        self.stack.show_colours(numbers, stale=self.words.stale, n_axes=n_axes)
