"""Names of curves, each with what the crosshair reads there."""

from dataclasses import dataclass, replace

from PySide6.QtCore import QEvent, QPointF, QRect, QSize, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetrics,
    QHelpEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
)
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from skinsource_gui.theme import LIGHT, UNIT_PX, Theme, scaled, tabular
from skinsource_gui.widgets.plot.curves import CurveName

STRIP_HEIGHT_PX = 20
_TEXT, _AROUND_PX = 0.9, 7
_SWATCH_PX = 13
_GAP_PX = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class LegendText:
    """What the strip says.

    Attributes
    ----------
    names
        Names of the curves, by rank.
    unit
        Of the readings.
    where, readings
        Where curves are read and what is read there; ``""`` and ``()`` where nothing is.
    where_room, reading_room
        The longest of them; places stay while numbers change.
    """

    names: tuple[CurveName, ...] = ()
    unit: str = ""
    where: str = ""
    readings: tuple[str, ...] = ()
    where_room: str = ""
    reading_room: str = ""

    def lines(self) -> str:
        """All of it, one line for each curve."""
        lines = [f"at {self.where}"] if self.where else []
        for rank, name in enumerate(self.names):
            reading = f": {self.readings[rank]} {self.unit}" if self.readings else ""
            told = f"{name.number}  {name.full}" if name.number else f"{name.short}: {name.full}"
            lines.append(f"{told}{reading}")
        return "\n".join(lines)


@dataclass(frozen=True, slots=True)
class _Detail:
    """Which parts of an entry are written."""

    number: bool
    place: bool
    reading: bool
    unit: bool


# From wide to narrow.  A unit that entries have no room for is said once.
_READING = (
    _Detail(True, True, True, True),
    _Detail(True, True, True, False),
    _Detail(True, False, True, False),
    _Detail(False, False, True, False),
)
_NAMED = _Detail(number=False, place=True, reading=True, unit=False)
_IDLE = (_Detail(True, True, False, False), _Detail(True, False, False, False))


class LegendStrip(QWidget):
    """One line: colour, number, place and reading of each curve, and where they are read.

    Where the line is too narrow it leaves out units, then places, then numbers, then curves; the
    tooltip has them all.  Curves without numbers keep their names, and take more lines.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("legend")
        self.setAccessibleName("Curves and readings")
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self._theme = LIGHT
        self._text = LegendText()
        self._n_lines = 1

    @property
    def text(self) -> LegendText:
        """What is said."""
        return self._text

    def set_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        self.update()

    def say(self, text: LegendText) -> None:
        """Show ``text``."""
        if text != self._text:
            self._text = text
            self.setAccessibleDescription(text.lines())
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
        metrics = QFontMetrics(self.words_font)
        if self._named:
            self._paint_lines(painter, metrics)
            painter.end()
            return
        detail, fitting = self._fit(metrics)
        x = UNIT_PX // 2
        for rank in range(fitting):
            x = self._paint_entry(painter, metrics, x, rank, detail)
        hidden = len(self._text.names) - fitting
        if hidden:
            self._write(painter, metrics, x, f"+{hidden}", self._theme.dim)
        if self._text.where:
            place = self.rect().adjusted(0, 0, -UNIT_PX // 2, 0)
            painter.setPen(QColor(self._theme.text))
            at_right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
            painter.drawText(place, at_right, self._where(self._text.where, detail))

    def _where(self, where: str, detail: _Detail) -> str:
        once = (detail.number or detail.place) and not detail.unit
        return f"{where} · {self._text.unit}" if once else where

    @property
    def _named(self) -> bool:
        """Whether names stand for the curves, and numbers do not."""
        return any(not name.number for name in self._text.names)

    @property
    def _line_px(self) -> int:
        return max(QFontMetrics(self.words_font).height() + _AROUND_PX, STRIP_HEIGHT_PX)

    @property
    def _row_px(self) -> int:
        return self._line_px if self._n_lines > 1 else self.height()

    def _make_room(self) -> None:
        n_lines = 1
        if self._named:
            n_lines = self._lines(QFontMetrics(self.words_font))[-1][1] + 1
        if n_lines != self._n_lines:
            self._n_lines = n_lines
            self.updateGeometry()

    def _lines(self, metrics: QFontMetrics) -> list[tuple[int, int]]:
        """Where entries begin, and at last where they are read: x and number of the line.

        There is room for readings whether or not there are some: nothing moves while one reads.
        """
        first, places, line = UNIT_PX // 2, [], 0
        x = first
        entries = [self._entry_px(metrics, rank, _NAMED) for rank in range(len(self._text.names))]
        where = metrics.horizontalAdvance(self._where(self._text.where_room, _NAMED))
        for width in (*entries, where):
            if x > first and x + width > self.width() - first:
                x, line = first, line + 1
            places.append((x, line))
            x += width
        return places

    def _paint_lines(self, painter: QPainter, metrics: QFontMetrics) -> None:
        advance = self._line_px - _AROUND_PX // 2
        *entries, (_, last) = self._lines(metrics)
        reading = replace(_NAMED, reading=bool(self._text.readings))
        for rank, (x, line) in enumerate(entries):
            painter.save()
            painter.translate(0, line * advance)
            self._paint_entry(painter, metrics, x, rank, reading)
            painter.restore()
        if self._text.where:
            painter.setPen(QColor(self._theme.text))
            place = QRect(0, last * advance, self.width() - UNIT_PX // 2, self._row_px)
            at_right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
            painter.drawText(place, at_right, self._where(self._text.where, _NAMED))

    def _fit(self, metrics: QFontMetrics) -> tuple[_Detail, int]:
        widths: list[int] = []
        room_px = 0
        details = _READING if self._text.readings else _IDLE
        for detail in details:
            room_px = self.width() - UNIT_PX
            if self._text.where:
                where = self._where(self._text.where_room, detail)
                room_px -= metrics.horizontalAdvance(where)
            widths = [
                self._entry_px(metrics, rank, detail) for rank in range(len(self._text.names))
            ]
            if sum(widths) <= room_px:
                return detail, len(widths)
        room_px -= metrics.horizontalAdvance("+00")
        fitting = 0
        while fitting < len(widths) and sum(widths[: fitting + 1]) <= room_px:
            fitting += 1
        return details[-1], fitting

    def _entry_px(self, metrics: QFontMetrics, rank: int, detail: _Detail) -> int:
        name = self._text.names[rank]
        words = [
            *([str(name.number)] if detail.number else []),
            *([name.short] if detail.place else []),
            *([self._text.reading_room] if detail.reading else []),
            *([self._text.unit] if detail.unit else []),
        ]
        gaps = _GAP_PX * len(words) + UNIT_PX
        return _SWATCH_PX + gaps + sum(metrics.horizontalAdvance(word) for word in words)

    def _paint_entry(
        self, painter: QPainter, metrics: QFontMetrics, x: int, rank: int, detail: _Detail
    ) -> int:
        text, theme = self._text, self._theme
        name, end = text.names[rank], x + self._entry_px(metrics, rank, detail)
        painter.setPen(theme.output_pen(rank, 2.0))
        middle = self._row_px / 2
        painter.drawLine(QPointF(x, middle), QPointF(x + _SWATCH_PX - 1, middle))
        x += _SWATCH_PX + _GAP_PX
        if detail.number:
            x = self._write(painter, metrics, x, str(name.number), theme.text)
        if detail.place:
            x = self._write(painter, metrics, x, name.short, theme.dim)
        if detail.reading:
            room = metrics.horizontalAdvance(text.reading_room)
            x += max(0, room - metrics.horizontalAdvance(text.readings[rank]))
            x = self._write(painter, metrics, x, text.readings[rank], theme.text)
        if detail.unit:
            self._write(painter, metrics, x, text.unit, theme.dim)
        return end

    def _write(
        self, painter: QPainter, metrics: QFontMetrics, x: int, text: str, colour: str
    ) -> int:
        painter.setPen(QColor(colour))
        width = metrics.horizontalAdvance(text)
        place = QRect(x, 0, width + 1, self._row_px)
        painter.drawText(place, Qt.AlignmentFlag.AlignVCenter, text)
        return x + width + _GAP_PX
