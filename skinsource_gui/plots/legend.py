"""What a legend says."""

from dataclasses import dataclass, replace
from itertools import accumulate

from PySide6.QtCore import QEvent, QPointF, QRect, QSize, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetrics,
    QHelpEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QResizeEvent,
)
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from skinsource_gui.plots.curves import CurveName
from skinsource_gui.qt.theme import UNIT_PX, current_theme, scaled, tabular

#: In place of where curves are read: what is said of each is its peak.
PEAK = "peak"
_BETWEEN = "  "


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
    where_room, reading_room, unit_room
        The longest of them, and of units; places stay while numbers change.
    by_axis
        Whether the names are those of axes, each with what all outputs read along it.
    relative
        Whether curves are relative to their peaks, which are said while nothing is read.
    """

    names: tuple[CurveName, ...] = ()
    unit: str = ""
    where: str = ""
    readings: tuple[str, ...] = ()
    where_room: str = ""
    reading_room: str = ""
    unit_room: str = ""
    by_axis: bool = False
    relative: bool = False

    @property
    def named(self) -> bool:
        """Whether names stand for the curves, and numbers do not."""
        return any(not name.number for name in self.names)

    @property
    def of_peaks(self) -> bool:
        """Whether nothing is read, and each curve has its peak beside it."""
        return self.where == PEAK

    def of_axes(self, axes: tuple[str, ...]) -> "LegendText":
        """The same where each name has a curve along each of some axes."""
        outputs = ", ".join(str(name.number) for name in self.names)
        return replace(
            self,
            names=tuple(
                CurveName(number=0, short=axis, full=f"along {axis} at {outputs}") for axis in axes
            ),
            reading_room=_BETWEEN.join((self.reading_room,) * len(self.names)),
            by_axis=True,
        )

    def lines(self) -> str:
        """All of it, one line for each curve."""
        lines = [self.where if self.of_peaks else f"at {self.where}"] if self.where else []
        for rank, name in enumerate(self.names):
            reading = f": {self.readings[rank]} {self.unit}" if self.readings else ""
            told = f"{name.number}  {name.full}" if name.number else f"{name.short}: {name.full}"
            lines.append(f"{told}{reading}")
        return "\n".join(lines)


def along_axes(readings: tuple[str, ...], n_axes: int) -> tuple[str, ...]:
    """What all outputs read along each axis, of readings along each axis of each output."""
    return tuple(_BETWEEN.join(readings[axis::n_axes]) for axis in range(n_axes))


# What of a legend there is room for, and where.

#: Width of the colour of a curve, and what is left between words.
SWATCH_PX, GAP_PX = 13, 4


@dataclass(frozen=True, slots=True)
class Detail:
    """Which parts of an entry are written."""

    number: bool
    place: bool
    reading: bool
    unit: bool


# From wide to narrow.  A unit that entries have no room for is said once.
_READING = (
    Detail(True, True, True, True),
    Detail(True, True, True, False),
    Detail(True, False, True, False),
    Detail(False, False, True, False),
)
#: What is written of a curve that a name stands for.
NAMED = Detail(number=False, place=True, reading=True, unit=False)
_IDLE = (Detail(True, True, False, False), Detail(True, False, False, False))
#: What is written of a curve that takes its number along into more lines.
NUMBERED = _READING[2]
#: Into so many: curves are worth more than their peaks.
_MOST_LINES = 2
# Of a peak nothing in the picture says whose it is: before its output, it goes itself.
_PEAKS = (*_READING[:-1], _IDLE[-1])


@dataclass(frozen=True, slots=True, eq=False)
class LegendLayout:
    """The words of a legend in a font, and the room for them.

    Attributes
    ----------
    text
        What is said.
    metrics
        Of the font.
    width_px
        Of the strip.
    may_fold
        Whether entries may take more lines; else they share one, and names as far as there is room.
    """

    text: LegendText
    metrics: QFontMetrics
    width_px: int
    may_fold: bool = True

    def where(self, where: str, detail: Detail) -> str:
        """Where curves are read, with the unit if it stands nowhere else; "" if nothing is."""
        if self.text.of_peaks and not detail.reading:
            return ""
        once = (detail.number or detail.place) and not detail.unit
        return f"{where} · {self.text.unit}" if once else where

    def entry_px(self, rank: int, detail: Detail) -> int:
        """Width of what is written of a curve."""
        name = self.text.names[rank]
        words = [
            *([str(name.number)] if detail.number else []),
            *([name.short] if detail.place else []),
            *([self.text.reading_room] if detail.reading else []),
            *([self.text.unit] if detail.unit else []),
        ]
        gaps = GAP_PX * len(words) + UNIT_PX
        whole = SWATCH_PX + gaps + sum(self.metrics.horizontalAdvance(word) for word in words)
        # Of what all outputs read as much as a line holds, or a part of it.
        return min(whole, self._most_px(rank)) if self.text.by_axis else whole

    def fitting(self) -> tuple[Detail, int]:
        """What is written of each curve in one line, and of how many curves."""
        details = self._details
        for detail in details:
            widths = self._widths(detail)
            if sum(widths) <= self._room_px(detail):
                return detail, len(widths)
        # Where some are left out anyway, those that are not say which they are.
        for detail in details[-2:]:
            room_px = self._room_px(detail) - self.metrics.horizontalAdvance("+00")
            fitting = sum(1 for end_px in accumulate(self._widths(detail)) if end_px <= room_px)
            if fitting:
                return detail, fitting
        return details[-1], 0

    @property
    def in_lines(self) -> Detail | None:
        """What is written of each curve where they may take more lines; None: in one line.

        Names may always; numbers take few more where peaks have no room in one.
        """
        if self.text.named:
            return NAMED
        if self.text.relative and self.may_fold:
            _, last = self.lines(NUMBERED)[-1]
            return NUMBERED if 0 < last < _MOST_LINES else None
        return None

    @property
    def n_lines(self) -> int:
        """For how many lines there is to be room: never for fewer because there is less width.

        Else what scrolls would be lower with a scroll bar beside it than without, and Qt would put
        that bar there and take it away until the stack ran out.
        """
        if self.text.named:
            return self.lines(NAMED)[-1][1] + 1
        if self.text.relative and self.may_fold:
            return min(self.lines(NUMBERED)[-1][1] + 1, _MOST_LINES)
        return 1

    def lines(self, detail: Detail = NAMED) -> list[tuple[int, int]]:
        """Where entries begin, and at last where they are read: x and number of the line.

        There is room for readings whether or not there are some: nothing moves while one reads.
        """
        first, places, line = UNIT_PX // 2, [], 0
        x = first
        for width in (*self._widths(detail), self._where_px):
            if x > first and x + width > self.width_px - first:
                x, line = first, line + 1
            places.append((x, line))
            x += width
        return places

    @property
    def _details(self) -> tuple[Detail, ...]:
        if self.text.of_peaks:
            return _PEAKS
        return _READING if self.text.readings else _IDLE

    def _widths(self, detail: Detail) -> list[int]:
        return [self.entry_px(rank, detail) for rank in range(len(self.text.names))]

    def _room_px(self, detail: Detail) -> int:
        """What of one line there is for entries."""
        where_room = PEAK if self.text.of_peaks else self.text.where_room
        where = self.where(where_room, detail) if self.text.where else ""
        return self.width_px - UNIT_PX - self.metrics.horizontalAdvance(where)

    @property
    def _where_px(self) -> int:
        unit = self.text.unit_room or self.text.unit
        return self.metrics.horizontalAdvance(f"{self.text.where_room} · {unit}")

    def _most_px(self, rank: int) -> int:
        """The most that a named entry takes."""
        line_px = self.width_px - UNIT_PX
        if self.may_fold:
            return line_px
        name_px = self.metrics.horizontalAdvance(self.text.names[rank].short)
        share_px = (line_px - self._where_px) // len(self.text.names)
        return max(share_px, SWATCH_PX + 2 * GAP_PX + UNIT_PX + name_px)


# Paints the entries of a legend.


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


# Names of curves, each with what the crosshair reads there.

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
