"""The legend above a plot: a line of curves, each with what the crosshair reads.

`LegendText` is its content, `LegendLayout` decides which parts fit, `LegendStrip` is the widget.
"""

from dataclasses import dataclass, replace
from itertools import accumulate, islice

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QPointF, QRect, QSize, Qt

from skinsource_gui.plots.curves import CurveName
from skinsource_gui.qt.layouts import Policy, named
from skinsource_gui.qt.theme import UNIT_PX, current_theme, scaled, tabular

#: Stands in `LegendText.where` while the readings are the peaks of curves.
PEAK = "peak"
_BETWEEN = "  "


@dataclass(frozen=True, slots=True, kw_only=True)
class LegendText:
    """Content of a legend.

    Attributes
    ----------
    names
        Names of the curves, by rank.
    unit
        Unit of the readings.
    where, readings
        Position of the crosshair and its readings; ``""`` and ``()`` without a crosshair.
    where_room, reading_room
        The longest texts of each kind, so that nothing moves while numbers change.
    by_axis
        Whether the names are those of axes, each with the readings of all outputs along it.
    details
        Lines in place of the readings, where these leave something out.
    """

    names: tuple[CurveName, ...] = ()
    unit: str = ""
    where: str = ""
    readings: tuple[str, ...] = ()
    where_room: str = ""
    reading_room: str = ""
    by_axis: bool = False
    details: tuple[str, ...] = ()

    @property
    def named(self) -> bool:
        """Whether curves have names without numbers."""
        return any(not name.number for name in self.names)

    @property
    def of_peaks(self) -> bool:
        """Whether the readings are the peaks of curves."""
        return self.where == PEAK

    def of_axes(self, axes: tuple[str, ...]) -> "LegendText":
        """Return the legend of curves of the same outputs along each of some axes."""
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
        """Return the whole legend, one line for each curve."""
        if self.details:
            return "\n".join((self.where, *self.details))
        lines = [self.where if self.of_peaks else f"at {self.where}"] if self.where else []
        for rank, name in enumerate(self.names):
            reading = f": {self.readings[rank]} {self.unit}" if self.readings else ""
            title = f"{name.number}  {name.full}" if name.number else f"{name.short}: {name.full}"
            lines.append(f"{title}{reading}")
        return "\n".join(lines)


def along_axes(readings: tuple[str, ...], n_axes: int) -> tuple[str, ...]:
    """Return the readings of all outputs along each axis, from those of each output in turn."""
    return tuple(_BETWEEN.join(readings[axis::n_axes]) for axis in range(n_axes))


#: Width of the line of a curve, and the gap between texts.
SWATCH_PX, GAP_PX = 13, 4


@dataclass(frozen=True, slots=True)
class Detail:
    """Which parts of an entry are written."""

    number: bool
    place: bool
    reading: bool
    unit: bool


# From wide to narrow.  A unit for which entries have no room is written once.
_READING = (
    Detail(True, True, True, True),
    Detail(True, True, True, False),
    Detail(True, False, True, False),
    Detail(False, False, True, False),
)
#: Parts of an entry that has a name without a number.
NAMED = Detail(number=False, place=True, reading=True, unit=False)
# Of what cursors measure each curve has its own number; further lines would leave no curves.
_MEASURED, _MOST_LINES = _READING[2], 4
_IDLE = (Detail(True, True, False, False), Detail(True, False, False, False))
# A peak without its number would say nothing: the peak is left out first.
_PEAKS = (*_READING[:-1], _IDLE[-1])


@dataclass(frozen=True, slots=True, eq=False)
class LegendLayout:
    """Decides which parts of a legend fit, and where they stand.

    Attributes
    ----------
    width_px
        Width of the legend.
    """

    text: LegendText
    metrics: QtGui.QFontMetrics
    width_px: int

    def where(self, where: str, detail: Detail) -> str:
        """Return the position of the crosshair, with the unit if entries have none; or ""."""
        if self.text.of_peaks and not detail.reading:
            return ""
        once = (detail.number or detail.place) and not detail.unit
        return f"{where} · {self.text.unit}" if once and self.text.unit else where

    def entry_px(self, rank: int, detail: Detail) -> int:
        """Return the width of an entry, px."""
        name = self.text.names[rank]
        texts = [
            *([str(name.number)] if detail.number else []),
            *([name.short] if detail.place else []),
            *([self.text.reading_room] if detail.reading else []),
            *([self.text.unit] if detail.unit else []),
        ]
        gaps = GAP_PX * len(texts) + UNIT_PX
        width = SWATCH_PX + gaps + sum(self.metrics.horizontalAdvance(word) for word in texts)
        # The readings of many outputs are cut to a line.
        return min(width, self.width_px - UNIT_PX) if self.text.by_axis else width

    def fitting(self) -> tuple[Detail, int]:
        """Return which parts of entries fit in one line, and how many entries."""
        details = self._details
        for detail in details:
            widths = self._widths(detail)
            if sum(widths) <= self._room_px(detail):
                return detail, len(widths)
        # Where entries are left out, the others need their numbers.
        for detail in details[-2:]:
            room_px = self._room_px(detail) - self.metrics.horizontalAdvance("+00")
            fitting = sum(1 for end_px in accumulate(self._widths(detail)) if end_px <= room_px)
            if fitting:
                return detail, fitting
        return details[-1], 0

    def placed(self) -> tuple[Detail, list[tuple[int, int]], int]:
        """Return parts of entries, x and line of those that fit, and the line of the crosshair."""
        if (flowing := self.flowing) is not None:
            *places, (_, last) = self.lines(flowing)
            return flowing, [place for place in places if place[1] < _MOST_LINES], last
        detail, fitting = self.fitting()
        ends = accumulate(self._widths(detail), initial=UNIT_PX // 2)
        return detail, [(x, 0) for x in islice(ends, fitting)], 0

    @property
    def flowing(self) -> Detail | None:
        """Parts of entries that take as many lines as they need; None: all stand in one."""
        if self.text.named:
            return NAMED
        measured = self.text.details and self.fitting()[1] < len(self.text.names)
        return _MEASURED if measured else None

    @property
    def n_lines(self) -> int:
        """Number of lines for which there is room."""
        flowing = self.flowing
        return 1 if flowing is None else self.lines(flowing)[-1][1] + 1

    def lines(self, detail: Detail = NAMED) -> list[tuple[int, int]]:
        """Return x and line of each entry, and last of the position of the crosshair.

        There is always room for readings, so that nothing moves when there are some.
        """
        first, places, line = UNIT_PX // 2, [], 0
        x = first
        where = f"{self.text.where_room} · {self.text.unit}"
        widths = self._widths(detail)
        if not self.text.named:  # in columns
            widths = [max(widths)] * len(widths)
        for width in (*widths, self.metrics.horizontalAdvance(where)):
            if x > first and x + width > self.width_px - first:
                x, line = first, line + 1
            places.append((x, min(line, _MOST_LINES)))
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
        """Return the width of one line that is left for entries."""
        where_room = PEAK if self.text.of_peaks else self.text.where_room
        where = self.where(where_room, detail) if self.text.where else ""
        return self.width_px - UNIT_PX - self.metrics.horizontalAdvance(where)


STRIP_HEIGHT_PX = 20
_TEXT, _AROUND_PX = 0.9, 7
_AT_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


class LegendStrip(QtWidgets.QWidget):
    """A line with colour, number, place and reading of each curve, and where they are read.

    A narrow line leaves out units, then places, then numbers, then curves; peaks are left out
    before numbers.  The tooltip has everything.  Curves without numbers keep their names, and what
    cursors measure stands in columns: both take more lines.
    """

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        named(self, "legend", "Curves and readings")
        self.setSizePolicy(Policy.Ignored, Policy.Fixed)
        #: The content.
        self.text = LegendText()
        self._n_lines = 1

    def say(self, text: LegendText) -> None:
        """Show ``text``."""
        if text != self.text:
            self.text = text
            self.setAccessibleDescription(text.lines())
            self.setToolTip(text.lines())
            self._make_room()
            self.update()

    @property
    def text_font(self) -> QtGui.QFont:
        """Font of the legend; it follows the font of the studio."""
        return scaled(tabular(self.font()), _TEXT)

    def sizeHint(self) -> QSize:
        return QSize(120, self._line_px + (self._n_lines - 1) * (self._line_px - _AROUND_PX // 2))

    def minimumSizeHint(self) -> QSize:
        return self.sizeHint()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._make_room()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        if not self.text.names:
            return
        painter, layout = QtGui.QPainter(self), self.text_layout
        painter.setFont(self.text_font)
        detail, places, last = layout.placed()
        row_px = self._line_px if self._n_lines > 1 else self.height()
        advance = self._line_px - _AROUND_PX // 2
        end = UNIT_PX // 2
        for rank, (x, line) in enumerate(places):
            painter.resetTransform()
            painter.translate(0, line * advance)
            end = self._paint_entry(painter, QRect(x, 0, 0, row_px), rank, detail)
        hidden = len(self.text.names) - len(places)
        if hidden and last:  # below those that are written
            painter.resetTransform()
            painter.translate(0, last * advance)
            end = UNIT_PX // 2
        if hidden:
            self._write(painter, QRect(end, 0, 0, row_px), f"+{hidden}", current_theme().dim)
        painter.resetTransform()
        if self.text.where:
            painter.setPen(QtGui.QColor(current_theme().text))
            room = QRect(0, last * advance, self.width() - UNIT_PX // 2, row_px)
            painter.drawText(room, _AT_RIGHT, layout.where(self.text.where, detail))

    @property
    def text_layout(self) -> LegendLayout:
        """The layout for the present size."""
        metrics = QtGui.QFontMetrics(self.text_font)
        return LegendLayout(self.text, metrics, self.width())

    @property
    def _line_px(self) -> int:
        return max(QtGui.QFontMetrics(self.text_font).height() + _AROUND_PX, STRIP_HEIGHT_PX)

    def _make_room(self) -> None:
        n_lines = self.text_layout.n_lines
        if n_lines != self._n_lines:
            self._n_lines = n_lines
            self.updateGeometry()

    def _paint_entry(self, painter: QtGui.QPainter, place: QRect, rank: int, detail: Detail) -> int:
        """Paint an entry at the left end of ``place``; return where the next one begins."""
        text, theme, metrics = self.text, current_theme(), painter.fontMetrics()
        name, x = text.names[rank], place.x()
        end = x + self.text_layout.entry_px(rank, detail)
        by_axis = text.by_axis
        pen = QtGui.QPen(theme.axis_colour(rank), 2.0) if by_axis else theme.output_pen(rank, 2.0)
        pen.setColor(name.colour(pen.color()))
        painter.setPen(pen)
        middle = place.height() / 2
        painter.drawLine(QPointF(x, middle), QPointF(x + SWATCH_PX - 1, middle))
        place.moveLeft(x + SWATCH_PX + GAP_PX)
        if detail.number:
            self._write(painter, place, str(name.number), theme.text)
        if detail.place:
            self._write(painter, place, name.short, theme.dim)
        if detail.reading and text.readings:
            reading = text.readings[rank]
            if by_axis:
                elided = Qt.TextElideMode.ElideRight
                reading = metrics.elidedText(reading, elided, end - place.x())
            else:
                room = metrics.horizontalAdvance(text.reading_room)
                place.translate(max(0, room - metrics.horizontalAdvance(reading)), 0)
            self._write(painter, place, reading, theme.text)
        if detail.unit:
            self._write(painter, place, text.unit, theme.dim)
        return end

    def _write(self, painter: QtGui.QPainter, place: QRect, text: str, colour: str) -> None:
        """Write text at the left end of ``place``, which moves to the end of the text."""
        painter.setPen(QtGui.QColor(colour))
        width = painter.fontMetrics().horizontalAdvance(text)
        place.setWidth(width + 1)
        painter.drawText(place, Qt.AlignmentFlag.AlignVCenter, text)
        place.translate(width + GAP_PX, 0)
