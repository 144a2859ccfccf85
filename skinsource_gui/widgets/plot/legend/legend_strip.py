"""Names of curves, each with what the crosshair reads there."""

from dataclasses import replace

from PySide6.QtCore import QEvent, QRect, QSize
from PySide6.QtGui import QFont, QFontMetrics, QHelpEvent, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from skinsource_gui.theme import UNIT_PX, current_theme, scaled, tabular
from skinsource_gui.widgets.plot.legend.legend_layout import Detail, LegendLayout
from skinsource_gui.widgets.plot.legend.legend_painter import LegendPainter
from skinsource_gui.widgets.plot.legend.legend_text import LegendText

STRIP_HEIGHT_PX = 20
_TEXT, _AROUND_PX = 0.9, 7


class LegendStrip(QWidget):
    """One line: colour, number, place and reading of each curve, and where they are read.

    Where the line is too narrow it leaves out units, then places, then numbers, then curves; peaks
    may take one line more, and are left out before numbers.  The tooltip has them all.  Curves
    without numbers keep their names, and take more lines if they may.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("legend")
        self.setAccessibleName("Curves and readings")
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self._text = LegendText()
        self._n_lines, self._may_fold = 1, True

    @property
    def text(self) -> LegendText:
        """What is said."""
        return self._text

    def say(self, text: LegendText) -> None:
        """Show ``text``."""
        if text != self._text:
            self._text = text
            self.setAccessibleDescription(text.lines())
            self._make_room()
            self.update()

    def let_fold(self, may_fold: bool) -> None:
        """Whether there is room for more lines: a plot that is low needs it more."""
        if may_fold != self._may_fold:
            self._may_fold = may_fold
            self._make_room()
            self.update()

    @property
    def words_font(self) -> QFont:
        """Of all words; it follows the font of the studio."""
        return scaled(tabular(self.font()), _TEXT)

    def sizeHint(self) -> QSize:
        return QSize(120, self._line_px + (self._n_lines - 1) * (self._line_px - _AROUND_PX // 2))

    def minimumSizeHint(self) -> QSize:
        return self.sizeHint()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._make_room()

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            QToolTip.showText(event.globalPos(), self._text.lines(), self)
            return True
        return super().event(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        if not self._text.names:
            return
        painter = QPainter(self)
        painter.setFont(self.words_font)
        detail = self.layout_of_words.in_lines
        if detail is None:
            self._paint_line(painter)
        else:
            self._paint_lines(painter, detail)
        painter.end()

    @property
    def layout_of_words(self) -> LegendLayout:
        """What there is room for, and where."""
        metrics = QFontMetrics(self.words_font)
        return LegendLayout(self._text, metrics, self.width(), self._may_fold)

    @property
    def _line_px(self) -> int:
        return max(QFontMetrics(self.words_font).height() + _AROUND_PX, STRIP_HEIGHT_PX)

    @property
    def _row_px(self) -> int:
        return self._line_px if self._n_lines > 1 else self.height()

    def _make_room(self) -> None:
        n_lines = self.layout_of_words.n_lines
        if n_lines != self._n_lines:
            self._n_lines = n_lines
            self.updateGeometry()

    def _paint_line(self, painter: QPainter) -> None:
        layout = self.layout_of_words
        writer = LegendPainter(painter, layout, self._row_px)
        detail, fitting = layout.fitting()
        x = UNIT_PX // 2
        for rank in range(fitting):
            x = writer.paint_entry(x, rank, detail)
        hidden = len(self._text.names) - fitting
        if hidden:
            writer.write(x, f"+{hidden}", current_theme().dim)
        writer.write_where(self.rect().adjusted(0, 0, -UNIT_PX // 2, 0), detail)

    def _paint_lines(self, painter: QPainter, detail: Detail) -> None:
        layout, advance = self.layout_of_words, self._line_px - _AROUND_PX // 2
        writer = LegendPainter(painter, layout, self._row_px)
        *entries, (_, last) = layout.lines(detail)
        reading = replace(detail, reading=bool(self._text.readings))
        for rank, (x, line) in enumerate(entries):
            painter.save()
            painter.translate(0, line * advance)
            writer.paint_entry(x, rank, reading)
            painter.restore()
        width = self.width() - UNIT_PX // 2
        writer.write_where(QRect(0, last * advance, width, self._row_px), detail)
