"""A colour scale whose ends can be dragged."""

from dataclasses import replace
from functools import reduce

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
    QResizeEvent,
)
from PySide6.QtWidgets import QWidget

from skinsource_gui.panels.skin.map_painter import small_font
from skinsource_gui.panels.skin.map_quantity import MapQuantity
from skinsource_gui.panels.skin.scale.colour_scale import level_y, paint_colour_scale
from skinsource_gui.panels.skin.scale.level_range import (
    SILENT_RANGE,
    Range,
    moved,
    with_high,
    with_low,
)
from skinsource_gui.panels.skin.scale.pulled_range import Change, PulledRange
from skinsource_gui.panels.skin.scale.range_handle import (
    HANDLE_HEIGHT,
    HANDLE_WIDTH,
    RangeHandle,
    key_step_db,
)
from skinsource_gui.theme import current_theme, tabular
from skinsource_gui.widgets.kept_picture import KeptPicture
from skinsource_gui.widgets.map.colour_maps import VIRIDIS, colour_table

_RAMP_LEFT, _RAMP_WIDTH = 10, 14
_END_PX = 8


class ColourStrip(QWidget):
    """A colour scale with a handle at either end; dragging between them moves both.

    It shows what it is told, and tells which range the user wants.
    """

    #: A range in dB, or None for the automatic one.
    range_chosen = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._colours = VIRIDIS
        self._pulled = PulledRange(SILENT_RANGE)
        self._marks: tuple[tuple[float, int], ...] = ()
        self._quantity = MapQuantity()
        self._grip_y: float | None = None
        self._scale = KeptPicture()
        self.setObjectName("colour_strip")
        self.setAccessibleName("Range of the colours")
        self.setToolTip("Drag to move the range, double-click for the automatic one")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumHeight(70)
        # All of it is painted: nothing behind needs to be.
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.high = self._new_handle("range_high", "Level of the highest colour", with_high)
        self.low = self._new_handle("range_low", "Level of the lowest colour", with_low)

    def sizeHint(self) -> QSize:
        line = self.fontMetrics().height()
        return QSize(_RAMP_LEFT + _RAMP_WIDTH + round(3.6 * line), 200)

    def minimumSizeHint(self) -> QSize:
        return QSize(self.sizeHint().width(), 70)

    def show_range(self, range_db: Range) -> None:
        """Show a range; the scale stays where it is while a handle is dragged."""
        if range_db != self._pulled.range_db:
            self._pulled.show(range_db)
            self._place_handles()

    def show_marks(self, marks: tuple[tuple[float, int], ...]) -> None:
        """Show levels of selected outputs, each in its colour."""
        if marks != self._marks:
            # From where they were to where they come: the rest of the strip stays.
            places = [self._mark_at(level).boundingRect() for level, _ in (*self._marks, *marks)]
            reached = reduce(QRectF.united, places)
            self._marks = marks
            self.update(reached.adjusted(-1, -1, 1, 1).toAlignedRect())

    def show_quantity(self, quantity: MapQuantity, colours: str = VIRIDIS) -> None:
        """Say what the levels are, and in which colours."""
        # The strip is the same at each instant.
        quantity = replace(quantity, time_s=0.0)
        if (quantity, colours) != (self._quantity, self._colours):
            self._quantity, self._colours = quantity, colours
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(tabular(small_font(self.font())))
        ramp = self._ramp()
        pulled = self._pulled
        scale = (pulled.axis_db, pulled.range_db, current_theme(), self._quantity, self._colours)
        ground = self.palette().window().color()
        self._scale.paint(painter, QRectF(self.rect()), scale, self._paint_scale, ground)
        painter.setPen(QPen(QColor(current_theme().base), 0.5))
        for level, rank in self._marks:
            painter.setBrush(current_theme().output_colour(rank))
            painter.drawPolygon(self._mark_at(level))
        if self.hasFocus():
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(QColor(current_theme().accent), 2))
            painter.drawRect(ramp.adjusted(-1, -1, 1, 1))
        painter.end()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._place_handles()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._grip_y = event.position().y()
            self._pulled.hold()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._grip_y is not None:
            self._pull(moved, self._grip_y - event.position().y())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._grip_y = None
        self._let_go()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        self.range_chosen.emit(None)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        step = key_step_db(event)
        if step:
            self.range_chosen.emit(moved(self._pulled.range_db, step))
        else:
            super().keyPressEvent(event)

    def _paint_scale(self, painter: QPainter) -> None:
        axis, levels, theme = self._pulled.axis_db, self._pulled.range_db, current_theme()
        table = colour_table(self._colours)
        paint_colour_scale(painter, self._ramp(), axis, levels, table, theme, self._quantity)

    def _new_handle(self, name: str, words: str, change_end: Change) -> RangeHandle:
        handle = RangeHandle(name, words, self)
        end = 1 if change_end is with_high else 0

        def pull(by_db: Range, pulled_db: float) -> Range:
            return change_end(by_db, by_db[end] + pulled_db)

        handle.pressed.connect(self._pulled.hold)
        handle.released.connect(self._let_go)
        handle.pulled.connect(lambda px: self._pull(pull, px))
        handle.stepped.connect(lambda db: self.range_chosen.emit(pull(self._pulled.range_db, db)))
        return handle

    def _pull(self, change: Change, up_px: float) -> None:
        wanted = self._pulled.pulled(change, up_px / self._ramp().height())
        if wanted is not None:
            self.range_chosen.emit(wanted)

    def _let_go(self) -> None:
        self._pulled.let_go()
        self._place_handles()

    def _mark_at(self, level_db: float) -> QPolygonF:
        """A triangle beside the ramp."""
        ramp = self._ramp()
        y = min(max(level_y(level_db, self._pulled.axis_db, ramp), ramp.top()), ramp.bottom())
        tip, back = ramp.left() - 1, ramp.left() - 8
        return QPolygonF([QPointF(tip, y), QPointF(back, y - 4), QPointF(back, y + 4)])

    def _ramp(self) -> QRectF:
        height = self.height() - 2 * _END_PX
        return QRectF(_RAMP_LEFT, _END_PX, _RAMP_WIDTH, max(height, 1))

    def _place_handles(self) -> None:
        ramp = self._ramp()
        left = round(ramp.center().x() - HANDLE_WIDTH / 2)
        for handle, level in zip((self.low, self.high), self._pulled.range_db, strict=True):
            y = level_y(level, self._pulled.axis_db, ramp)
            y = min(max(y, ramp.top()), ramp.bottom())
            handle.move(left, round(y - HANDLE_HEIGHT / 2))
        self.update()
