"""What the hand diagram shows, and how it is painted."""

from dataclasses import replace

from PySide6.QtCore import QPointF, QRectF, QSize, QSizeF, Qt
from PySide6.QtGui import QColor, QFontDatabase, QFontMetricsF, QPainter, QPixmap

from skinsource_gui.panels.hand.caption import HINT, caption_of
from skinsource_gui.panels.hand.hand_drawing import HandDrawing, hand_pixmap, kept_hand_pixmap
from skinsource_gui.panels.hand.hand_layout import HandLayout
from skinsource_gui.panels.hand.hand_state import HandState, Mark
from skinsource_gui.panels.hand.site_marker import (
    Place,
    has_room,
    paint_cursor,
    paint_dot,
    paint_empty,
    paint_hovered,
    paint_occupied,
    paint_selection,
)
from skinsource_gui.theme import UNIT_PX, current_theme
from skinsource_gui.widgets.paper import is_on_paper

_SIDE_ALIGNMENT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignBottom
# From this height on there is a legend below the hand.
_ROOMY_PX = 300
# In large letters the words on the side take at most this part of the width.
_MOST_SIDE = 0.35
# In front of people words are larger than usual.  Numbers of empty places that are not larger than
# those cannot be read from afar, and only hide the fingers: lines of text in a radius.
_ENLARGED, _FROM_AFAR = 1.1, 1.2
# Pixels of the hand in a px on paper: of 600 dots in an inch.
_PAPER_RATIO = 6.25
_LEGEND = (("perpendicular", None), ("in-axis", QPointF(0.0, 1.0)))


class HandPicture:
    """Paints the hand.

    Parameters
    ----------
    drawing
        The hand.

    Attributes
    ----------
    area
        Where the hand is seen.
    """

    def __init__(self, drawing: HandDrawing) -> None:
        self.area = QRectF(0.0, 0.0, 260.0, 330.0)
        self._drawing = drawing
        self._size = QSize()
        self._line_px = 0.0
        self._lines = 2
        # Radius from which on empty places have their numbers.
        self._readable_px = 0.0
        # Of the picture that is being painted.
        self._layout: HandLayout

    def show_drawing(self, drawing: HandDrawing) -> None:
        """Take another hand."""
        self._drawing = drawing

    def resize(self, size: QSize, metrics: QFontMetricsF) -> None:
        """Take a widget's size; below the area of the hand there is text."""
        self._size = size
        self._line_px = metrics.height() + 2.0
        general = QFontDatabase.systemFont(QFontDatabase.SystemFont.GeneralFont)
        enlarged = metrics.height() > _ENLARGED * QFontMetricsF(general).height()
        self._readable_px = _FROM_AFAR * metrics.height() if enlarged else 0.0
        # Where there is little room the hand needs it more than the legend does.
        legend = sum(_widths(metrics)) + 2 * UNIT_PX
        roomy = size.height() >= _ROOMY_PX and (not enlarged or legend <= size.width())
        self._lines = 2 if roomy else 1
        height = size.height() - self._lines * self._line_px - UNIT_PX
        self.area = QRectF(0.0, 2.0, size.width(), height)

    def paint(self, painter: QPainter, layout: HandLayout, state: HandState, ratio: float) -> None:
        """Paint all; ``ratio`` is device pixels per widget pixel."""
        self._layout = layout
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        font = painter.font()
        painter.save()
        # Magnified, the hand would lie on the words below it.
        painter.setClipRect(self.area.adjusted(0, -2, 0, UNIT_PX / 2))
        painter.drawPixmap(0, 0, self._hand(ratio))
        for site in self._in_order(state):
            self._paint_site(painter, site, state)
        if state.cursor is not None:
            paint_cursor(painter, self._place(state.cursor, in_use=True), current_theme())
        painter.restore()
        if state.ghost is not None and state.moving is not None:
            self._paint_ghost(painter, state.ghost, state.marks[state.moving])
        painter.setFont(font)
        self._paint_side(painter)
        self._paint_caption(painter, state)
        if self._lines > 1 and self._drawing.contacts:
            self._paint_legend(painter)

    def _hand(self, ratio: float) -> QPixmap:
        about = self._drawing, self._layout.transform, self._size
        if is_on_paper():
            return hand_pixmap(*about, _PAPER_RATIO, current_theme())
        return kept_hand_pixmap(*about, ratio, current_theme())

    def _in_order(self, state: HandState) -> list[int]:
        """All sites, those above others last: in use, selected, pointed at."""
        above = [*sorted({mark.site for mark in state.marks}), state.selected_site, state.cursor]
        above += [state.hovered, state.target]
        # Each once, where it comes last.
        last = dict.fromkeys(site for site in reversed(above) if site and self._layout.has(site))
        quiet = [site for site in range(1, self._layout.n_sites + 1) if site not in last]
        return [*quiet, *reversed(last)]

    def _place(self, site: int, *, in_use: bool) -> Place:
        radius_px = self._layout.radius_in_use_px if in_use else self._layout.radius_px
        return Place(
            site=site,
            centre=self._layout.centre(site),
            radius_px=radius_px(site),
            push=self._layout.push(site),
        )

    def _paint_site(self, painter: QPainter, site: int, state: HandState) -> None:
        if site == state.target and state.moving is None:
            # What is held over it comes from another panel.
            paint_cursor(painter, self._place(site, in_use=True), current_theme())
        front, chosen = state.front_at(site), site in (state.hovered, state.target)
        place = self._place(site, in_use=front is not None or chosen or site == state.cursor)
        if front is None:
            small = place.radius_px < self._readable_px and site != state.cursor
            if chosen:
                paint_hovered(painter, place, current_theme())
            elif not has_room(place) or (small and state.moving is None):
                paint_dot(painter, place, current_theme())
            else:
                paint_empty(painter, place, current_theme(), inviting=state.moving is not None)
            return
        if front == state.selected:
            paint_selection(painter, place, current_theme())
        elif any(state.marks[k].chosen for k in state.at(site)):
            paint_selection(painter, place, current_theme(), last=False)
        elif chosen:
            paint_hovered(painter, place, current_theme())
        order = (front, *(k for k in state.at(site) if k != front))
        colours = [state.marks[k].colour for k in order]
        paint_occupied(painter, place, current_theme(), colours, silent=state.marks[front].silent)

    def _paint_ghost(self, painter: QPainter, centre: QPointF, mark: Mark) -> None:
        ghost = replace(self._place(mark.site, in_use=True), centre=centre)
        painter.setOpacity(0.6)
        paint_occupied(painter, ghost, current_theme(), [mark.colour], silent=mark.silent)
        painter.setOpacity(1.0)

    def _paint_caption(self, painter: QPainter, state: HandState) -> None:
        metrics, area = QFontMetricsF(painter.font()), self._line_area(self._lines)
        limb = self._drawing.limb
        text = caption_of(
            state, limb, lambda words: metrics.horizontalAdvance(words) <= area.width()
        )
        colour = current_theme().accent if text == HINT else current_theme().text
        text = metrics.elidedText(text, Qt.TextElideMode.ElideRight, area.width())
        painter.setPen(QColor(colour))
        painter.drawText(area, Qt.AlignmentFlag.AlignCenter, text)

    def _paint_side(self, painter: QPainter) -> None:
        """Which hand this is, in the free corner below the thumb."""
        bottom = self._line_area(self._lines).bottomRight() - QPointF(0.0, 1.5 * self._line_px)
        metrics = QFontMetricsF(painter.font())
        # As wide as the words are, in letters of any size.
        lines = self._drawing.side.split("\n")
        width = 1.0 + max(metrics.horizontalAdvance(line) for line in lines)
        if self._readable_px and width > _MOST_SIDE * self._size.width():
            return  # in large letters it would lie on the fingers
        area = QRectF(bottom - QPointF(width, 4 * self._line_px), bottom)
        painter.setPen(QColor(current_theme().dim))
        painter.drawText(area, _SIDE_ALIGNMENT, self._drawing.side)

    def _paint_legend(self, painter: QPainter) -> None:
        metrics, area = QFontMetricsF(painter.font()), self._line_area(1)
        radius = 0.36 * metrics.height()
        advance = 2 * radius + UNIT_PX
        widths = _widths(metrics)
        left = area.center().x() - (sum(widths) + 2 * UNIT_PX) / 2
        for (words, push), width in zip(_LEGEND, widths, strict=True):
            sign = Place(
                site=0,
                centre=QPointF(left + radius, area.center().y() - (0 if push is None else 1)),
                radius_px=radius * (1.0 if push is None else 0.85),
                push=push,
            )
            painter.setPen(QColor(current_theme().dim))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawPath(sign.path())
            at = QRectF(QPointF(left + advance, area.top()), QSizeF(width, area.height()))
            painter.drawText(at, Qt.AlignmentFlag.AlignVCenter, words)
            left += width + 2 * UNIT_PX

    def _line_area(self, from_bottom: int) -> QRectF:
        top = self._size.height() - from_bottom * self._line_px - UNIT_PX / 2
        return QRectF(UNIT_PX, top, max(0.0, self._size.width() - 2.0 * UNIT_PX), self._line_px)


def _widths(metrics: QFontMetricsF) -> list[float]:
    """Of the parts of the legend, sign and words."""
    advance = 2 * 0.36 * metrics.height() + UNIT_PX
    return [advance + metrics.horizontalAdvance(words) for words, _ in _LEGEND]
