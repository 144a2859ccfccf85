"""Paints the entries of a legend."""

from PySide6.QtCore import QPointF, QRect, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from skinsource_gui.theme import current_theme
from skinsource_gui.widgets.plot.legend.legend_layout import GAP_PX, SWATCH_PX, Detail, LegendLayout


class LegendPainter:
    """Writes into lines of ``row_px``, from the left.

    Parameters
    ----------
    painter
        Has the font of the layout.
    layout
        What is said, and how wide it is.
    row_px
        Height of a line.
    """

    def __init__(self, painter: QPainter, layout: LegendLayout, row_px: int) -> None:
        self._painter, self._layout, self._row_px = painter, layout, row_px

    def paint_entry(self, x: int, rank: int, detail: Detail) -> int:
        """Write what is said of a curve; return where the next one begins."""
        text, theme, metrics = self._layout.text, current_theme(), self._layout.metrics
        name, end = text.names[rank], x + self._layout.entry_px(rank, detail)
        by_axis = text.by_axis
        pen = QPen(theme.axis_colour(rank), 2.0) if by_axis else theme.output_pen(rank, 2.0)
        self._painter.setPen(pen)
        middle = self._row_px / 2
        self._painter.drawLine(QPointF(x, middle), QPointF(x + SWATCH_PX - 1, middle))
        x += SWATCH_PX + GAP_PX
        if detail.number:
            x = self.write(x, str(name.number), theme.text)
        if detail.place:
            x = self.write(x, name.short, theme.dim)
        if detail.reading and by_axis:
            elided = Qt.TextElideMode.ElideRight
            x = self.write(x, metrics.elidedText(text.readings[rank], elided, end - x), theme.text)
        elif detail.reading:
            room = metrics.horizontalAdvance(text.reading_room)
            x += max(0, room - metrics.horizontalAdvance(text.readings[rank]))
            x = self.write(x, text.readings[rank], theme.text)
        if detail.unit:
            self.write(x, text.unit, theme.dim)
        return end

    def write(self, x: int, words: str, colour: str) -> int:
        """Write words; return where the next ones begin."""
        self._painter.setPen(QColor(colour))
        width = self._layout.metrics.horizontalAdvance(words)
        place = QRect(x, 0, width + 1, self._row_px)
        self._painter.drawText(place, Qt.AlignmentFlag.AlignVCenter, words)
        return x + width + GAP_PX

    def write_where(self, line: QRect, detail: Detail) -> None:
        """Write at the right end of a line where curves are read, if they are."""
        if self._layout.text.where:
            self._painter.setPen(QColor(current_theme().text))
            at_right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
            words = self._layout.where(self._layout.text.where, detail)
            self._painter.drawText(line, at_right, words)
