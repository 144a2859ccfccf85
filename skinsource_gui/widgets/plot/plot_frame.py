"""The still part of a plot: grid, ticks, labels and words around the curves."""

from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPen

from skinsource_gui.theme import UNIT_PX, Theme

_CENTRED = Qt.AlignmentFlag.AlignCenter
_GAP_PX = 4.0
_SMALLEST_FONT_PX = 7


@dataclass(frozen=True, slots=True, kw_only=True)
class Mark:
    """A word beside a position on an axis, px; ``""`` is a grid line alone."""

    at: float
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Frame:
    """Everything around the curves, in pixels of the canvas.

    Attributes
    ----------
    width, height
        Of the canvas.
    plot
        Where the curves are: left, top, width, height.
    x_marks, y_marks
        Ticks.
    row_edges, row_numbers
        Where one row meets the next; the output number of each row and its rank.
    shaded
        Parts of the x axis outside the band, left and right.
    unit
        Above the y axis.
    notes
        Beside it, longest first; the first that fits is written.
    titles
        Below the x axis, longest first.
    mark, badge
        Words in the upper right corner: passing and lasting.
    hint
        Words in the middle of the plot.
    """

    width: float
    height: float
    plot: tuple[float, float, float, float]
    x_marks: tuple[Mark, ...] = ()
    y_marks: tuple[Mark, ...] = ()
    row_edges: tuple[float, ...] = ()
    row_numbers: tuple[Mark, ...] = ()
    shaded: tuple[tuple[float, float], ...] = ()
    unit: str = ""
    notes: tuple[str, ...] = ()
    titles: tuple[str, ...] = ()
    mark: str = ""
    badge: str = ""
    hint: str = ""

    @property
    def area(self) -> QRectF:
        """Where the curves are."""
        return QRectF(*self.plot)


def fitting(texts: tuple[str, ...], metrics: QFontMetricsF, room_px: float) -> str:
    """First of ``texts`` that fits, or nothing."""
    return next((text for text in texts if metrics.horizontalAdvance(text) <= room_px), "")


def paint_frame(painter: QPainter, frame: Frame, theme: Theme, font: QFont) -> None:
    """Paint ``frame``."""
    painter.save()
    painter.setFont(font)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
    metrics = QFontMetricsF(font)
    for left, width in frame.shaded:
        shaded = QRectF(left, frame.plot[1], width, frame.plot[3])
        painter.fillRect(shaded, QColor(theme.window))
    _paint_grid(painter, frame, theme)
    _paint_x_labels(painter, frame, theme, metrics)
    _paint_y_labels(painter, frame, theme, metrics)
    _paint_header(painter, frame, theme, metrics)
    if frame.hint:
        painter.setPen(QColor(theme.dim))
        painter.drawText(frame.area, _CENTRED | Qt.TextFlag.TextWordWrap, frame.hint)
    painter.restore()


def paint_message(painter: QPainter, area: QRectF, text: str, theme: Theme, font: QFont) -> None:
    """Paint ``text`` in the middle of an empty ``area``."""
    painter.save()
    painter.setFont(font)
    painter.setPen(QColor(theme.dim))
    room = area.adjusted(2 * UNIT_PX, UNIT_PX, -2 * UNIT_PX, -UNIT_PX)
    painter.drawText(room, _CENTRED | Qt.TextFlag.TextWordWrap, text)
    painter.restore()


def _paint_grid(painter: QPainter, frame: Frame, theme: Theme) -> None:
    left, top, width, height = frame.plot
    right, bottom = left + width, top + height
    painter.setPen(QPen(QColor(theme.grid), 1))
    for mark in frame.x_marks:
        painter.drawLine(QPointF(mark.at, top), QPointF(mark.at, bottom))
    for mark in frame.y_marks:
        painter.drawLine(QPointF(left, mark.at), QPointF(right, mark.at))
    painter.setPen(QPen(QColor(theme.border), 1))
    for edge in (top, *frame.row_edges, bottom):
        painter.drawLine(QPointF(left, edge), QPointF(right, edge))
    painter.drawLine(QPointF(left, top), QPointF(left, bottom))
    painter.drawLine(QPointF(right, top), QPointF(right, bottom))


def _paint_x_labels(painter: QPainter, frame: Frame, theme: Theme, metrics: QFontMetricsF) -> None:
    bottom, line = frame.plot[1] + frame.plot[3], metrics.height()
    painter.setPen(QColor(theme.dim))
    free_from = 0.0
    for mark in frame.x_marks:
        width = metrics.horizontalAdvance(mark.text) + 2
        left = min(max(mark.at - width / 2, 0.0), frame.width - width)
        if not mark.text or left < free_from:
            continue
        painter.drawText(QRectF(left, bottom + 2, width, line), _CENTRED, mark.text)
        free_from = left + width + _GAP_PX
    title = fitting(frame.titles, metrics, frame.width - UNIT_PX)
    middle = frame.plot[0] + frame.plot[2] / 2
    width = metrics.horizontalAdvance(title) + 2
    left = min(max(middle - width / 2, _GAP_PX), frame.width - width - _GAP_PX)
    painter.setPen(QColor(theme.text))
    painter.drawText(QRectF(left, bottom + 2 + line, width, line), _CENTRED, title)


def _paint_y_labels(painter: QPainter, frame: Frame, theme: Theme, metrics: QFontMetricsF) -> None:
    left, _, width, height = frame.plot
    line = metrics.height()
    painter.setPen(QColor(theme.dim))
    at_right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
    for mark in frame.y_marks:
        place = QRectF(0, mark.at - line / 2, left - _GAP_PX, line)
        painter.drawText(place, at_right, mark.text)
    if not frame.row_numbers:
        return
    row = height / len(frame.row_numbers)
    font = QFont(painter.font())
    if row < line:
        font.setPixelSize(max(_SMALLEST_FONT_PX, int(row * 0.85)))
    font.setBold(True)
    painter.save()
    painter.setFont(font)
    for rank, mark in enumerate(frame.row_numbers):
        painter.setPen(theme.output_colour(rank))
        place = QRectF(left + width, mark.at - row / 2, frame.width - left - width, row)
        painter.drawText(place, _CENTRED, mark.text)
    painter.restore()


def _paint_header(painter: QPainter, frame: Frame, theme: Theme, metrics: QFontMetricsF) -> None:
    left, top, width, _ = frame.plot
    line = QRectF(left, 0, width, top - 1)
    right = line.right()
    if frame.badge:
        badge_px = metrics.horizontalAdvance(frame.badge) + UNIT_PX
        badge = QRectF(right - badge_px, line.top() + 1.5, badge_px - 1, line.height() - 3)
        painter.setPen(QPen(QColor(theme.warning), 1))
        painter.drawRoundedRect(badge, 3, 3)
        painter.drawText(badge, _CENTRED, frame.badge)
        right = badge.left() - UNIT_PX
    at_right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
    painter.setPen(QColor(theme.dim))
    if frame.mark:
        painter.drawText(QRectF(left, 0, right - left, line.height()), at_right, frame.mark)
        right -= metrics.horizontalAdvance(frame.mark) + UNIT_PX
    at_left = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
    painter.setPen(QColor(theme.text))
    painter.drawText(QRectF(left, 0, right - left, line.height()), at_left, frame.unit)
    start = left + metrics.horizontalAdvance(frame.unit) + 2 * UNIT_PX
    note = fitting(frame.notes, metrics, right - start)
    painter.setPen(QColor(theme.warning))
    painter.drawText(QRectF(start, 0, max(right - start, 1), line.height()), at_left, note)
