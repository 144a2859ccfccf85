"""What of a legend there is room for, and where."""

from dataclasses import dataclass
from itertools import accumulate

from PySide6.QtGui import QFontMetrics

from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.plot.legend.legend_text import PEAK, LegendText

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
