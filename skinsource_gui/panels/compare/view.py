"""Where compared maps and their scales lie, and how they are painted and pointed at."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal

from skinsource.base.conventions import Floats
from skinsource_gui.panels.compare.content import Cell, CompareContent
from skinsource_gui.plots.colour_maps import colour_table
from skinsource_gui.plots.curves import fitting
from skinsource_gui.plots.figure import shrunk
from skinsource_gui.plots.outputs import REACH_PX, OutputPicker
from skinsource_gui.plots.small_map import (
    LEAST_MAP_PX,
    map_grid,
    paint_band,
    paint_rings,
    paint_scale_row,
    paint_small_bar,
    paint_small_map,
    scale_row_px,
    small_frame,
)
from skinsource_gui.qt.frames import paint_focus_frame
from skinsource_gui.qt.keys import KEYS, claims_shortcut, meaning_of
from skinsource_gui.qt.layouts import named
from skinsource_gui.qt.theme import Theme, current_theme, tabular


@dataclass(frozen=True, slots=True, kw_only=True)
class CellPlace:
    """Areas of one map, px.

    Attributes
    ----------
    heading, value
        Areas of some lines of text, and of one.
    scale
        The scale of this map; empty where all have one in common.
    """

    whole: QRectF
    heading: QRectF
    value: QRectF
    map: QRectF
    scale: QRectF


@dataclass(frozen=True, slots=True, kw_only=True)
class Places:
    """Areas of all maps, px.

    Attributes
    ----------
    head
        A line of text above.
    scale
        The scale of all maps; empty where each has its own.
    low
        Whether maps show the hand without the arm.
    """

    head: QRectF
    cells: tuple[CellPlace, ...]
    scale: QRectF
    low: bool = False


def _laid_out(
    room: QRectF, content: CompareContent, line: float, heading_lines: int, *, low: bool
) -> Places:
    """Lay maps out with so many lines of heading, in as many rows as give the largest ones.

    ``low``: in wide cells words stand beside maps of hands.
    """
    edge, n, common = 0.3 * line, len(content.cells), content.common_scale is not None
    inner = room.adjusted(edge, 0.0, -edge, -edge)
    head = QRectF(inner.left(), inner.top(), inner.width(), content.head_lines * line)
    foot = scale_row_px(line, low=low) if common else 0.0
    scale = QRectF(inner.left(), inner.bottom() - foot, inner.width(), foot)
    maps = QRectF(inner.left(), head.bottom(), inner.width(), scale.top() - head.bottom())
    words = (heading_lines + 1.0) * line
    below = edge + (0.0 if common else scale_row_px(line))
    beside = low and inner.width() >= _WIDE_LINES * line * n
    wholes = map_grid(maps, n, words + below)
    if beside:
        width = inner.width() / n
        wholes = tuple(maps.adjusted(k * width, 0, (k + 1 - n) * width, 0) for k in range(n))
    cells = tuple(_cell(whole, line, words, below, beside=beside) for whole in wholes)
    return Places(head=head, cells=cells, scale=scale, low=low or content.hands)


# Cells so wide have room for words beside a map.
_WIDE_LINES = 12.0


def least_height(line: float) -> float:
    """Return the least height for maps in one row, with lines of that height."""
    return 2.0 * line + scale_row_px(line, low=True) + LEAST_MAP_PX


def _cell(whole: QRectF, line: float, words: float, below: float, *, beside: bool) -> CellPlace:
    """Return the areas of a map with that height of words, and of what lies below the map."""
    edge = 0.3 * line
    bottom, top, left, width = whole.bottom() - below, whole.top(), whole.left(), whole.width()
    area = QRectF(left + edge, top + words, width - 2 * edge, bottom - top - words)
    if beside:
        width -= min(bottom - top, width / 2)
        area = QRectF(left + width, top, whole.right() - left - width, bottom - top)
        top = max((top + bottom - words) / 2, top)
    return CellPlace(
        whole=whole,
        heading=QRectF(left, top, width, words - line),
        value=QRectF(left, top + words - line, width, line),
        map=area,
        scale=QRectF(whole.left(), bottom + edge, whole.width(), below - edge),
    )


_CENTRE = Qt.AlignmentFlag.AlignCenter
_MOST_LINES = 4
# A number stays with what it numbers.
_BEFORE_NUMBER = re.compile(r" (?=\d)")


def places_for(
    room: QRectF, content: CompareContent, font: QtGui.QFont, least_lines: float = 0.0
) -> Places:
    """Lay out the maps of ``content``, whose text is in ``font``.

    Where the maps would be lower than ``least_lines`` lines of text, they show hands alone.
    """
    line, n = QtGui.QFontMetricsF(font).height(), len(content.cells)
    metrics = QtGui.QFontMetricsF(bold(font))
    for low in (False, True):
        for lines in range(1, _MOST_LINES + 1):
            places = _laid_out(room, content, line, lines, low=low)
            pairs = zip(content.cells, places.cells, strict=True)
            if all(_fits(metrics, cell.headings, place.heading) for cell, place in pairs):
                break
        if not n or places.cells[0].map.height() >= least_lines * line:
            break
    return places


def paint_heading(painter: QtGui.QPainter, wordings: Sequence[str], room: QRectF) -> None:
    """Write the first of some wordings, each shorter than the one before, that has room."""
    metrics = QtGui.QFontMetricsF(painter.font())
    wraps = _CENTRE | Qt.TextFlag.TextWordWrap
    inner = _inner(metrics, room)
    fitted = next((wording for wording in wordings if _fits(metrics, (wording,), room)), None)
    if fitted is not None:
        painter.drawText(inner, wraps, _with_joined_numbers(fitted))
        return
    text = metrics.elidedText(wordings[-1], Qt.TextElideMode.ElideRight, inner.width())
    painter.drawText(inner, _CENTRE, text)


def bold(font: QtGui.QFont) -> QtGui.QFont:
    """Return the font of headings for texts in ``font``."""
    bold_font = QtGui.QFont(font)
    bold_font.setBold(True)
    return bold_font


def _fits(metrics: QtGui.QFontMetricsF, wordings: Sequence[str], room: QRectF) -> bool:
    """Return whether one of some wordings has room; lines break only between words."""
    inner = _inner(metrics, room)
    flags = int(_CENTRE.value) | int(Qt.TextFlag.TextWordWrap.value)
    for wording in wordings:
        needed = metrics.boundingRect(inner, flags, _with_joined_numbers(wording))
        if needed.width() <= inner.width() and needed.height() <= inner.height() + 1.0:
            return True
    return False


def _inner(metrics: QtGui.QFontMetricsF, room: QRectF) -> QRectF:
    edge = 0.25 * metrics.height()
    return room.adjusted(edge, 0.0, -edge, 0.0)


def _with_joined_numbers(text: str) -> str:
    return _BEFORE_NUMBER.sub("\N{NO-BREAK SPACE}", text)


def paint_content(
    painter: QtGui.QPainter,
    content: CompareContent,
    places: Places,
    theme: Theme,
    pointed_at: int | None = None,
) -> None:
    """Draw ``content``; the painter's font is that of all text.

    Parameters
    ----------
    pointed_at
        Number of the output that is marked in every map; None: none is.
    """
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    common = content.common_scale
    for cell, place in zip(content.cells, places.cells, strict=True):
        small = None if cell.small is None else replace(cell.small, hand_only=places.low)
        framed = replace(cell, small=small)
        _paint_cell(painter, framed, place, content, theme, pointed_at)
        if common is None and cell.scale is not None:
            paint_scale_row(painter, place.scale, cell.scale, theme)
    if common is not None:
        paint_scale_row(painter, places.scale, common, theme)


def paint_page(
    painter: QtGui.QPainter, content: CompareContent, room: QRectF, theme: Theme
) -> None:
    """Draw ``content`` into ``room``, with a line that says of what it is."""
    painter.setPen(QtGui.QColor(theme.text))
    line = painter.fontMetrics().height()
    if content.message or not content.cells:
        painter.drawText(room, _CENTRE, content.message)
        return
    text = " · ".join(filter(None, (content.about, "SYNTHETIC" * bool(content.head_lines))))
    painter.drawText(QRectF(0, 0, room.width(), 1.5 * line), _CENTRE, text)
    below = room.adjusted(0, 1.5 * line, 0, 0)
    paint_content(painter, content, places_for(below, content, painter.font()), theme)


def _paint_cell(
    painter: QtGui.QPainter,
    cell: Cell,
    place: CellPlace,
    content: CompareContent,
    theme: Theme,
    pointed_at: int | None,
) -> None:
    plain = QtGui.QFont(painter.font())
    painter.setFont(bold(plain))
    painter.setPen(QtGui.QColor(theme.text))
    paint_heading(painter, cell.headings, place.heading)
    painter.setFont(plain)
    if cell.small is None or cell.scale is None:
        painter.setPen(QtGui.QColor(theme.dim))
        flags = _CENTRE | Qt.TextFlag.TextWordWrap
        text = cell.text or "Computing…"
        painter.setFont(shrunk(plain, text.split(), place.map.width()))
        painter.drawText(place.map, flags, text)
        painter.setFont(plain)
        return
    painter.setPen(QtGui.QColor(theme.text if pointed_at is not None else theme.dim))
    values = cell.value_texts(pointed_at)
    room_px = place.value.width() - 0.5 * painter.fontMetrics().height()
    painter.setFont(shrunk(plain, values[-1:], room_px))
    value = fitting(values, QtGui.QFontMetricsF(painter.font()), room_px) or values[-1]
    painter.drawText(place.value, _CENTRE, value)
    painter.setFont(plain)
    table = colour_table(cell.scale.colours)
    paint_small_map(painter, place.map, cell.small, cell.design, theme, cell.scale.range_db, table)
    ringed, first = content.outputs, content.outputs[:1]
    if content.marks_first and first:
        paint_rings(painter, cell.small, place.map, (), theme, *first)
        ringed = ()
    paint_rings(painter, cell.small, place.map, ringed, theme, pointed_at)
    paint_small_bar(painter, place.map, cell.small, cell.limb, theme)


# Those keys of the skin map that are about outputs.
_KEYS = frozenset({"go", "select", "toggle", "select_all", "select_none"})


class MapsView(QtWidgets.QWidget):
    """The maps as a widget; an output that is pointed at in one map is marked in all.

    Attributes
    ----------
    picker
        Chooses outputs by mouse and keys.
    least_lines
        Maps that would be lower than so many lines of text show hands alone.
    several_on_hands
        Whether several maps do where no output is selected on an arm, and mark the first output.
    arm
        Whether arms are shown, however many maps there are; None: it follows from the two above.
    """

    #: The outputs to select, a tuple of numbers.
    outputs_chosen = Signal(object)
    #: Number of the output that is pointed at, or None.
    pointed_at = Signal(object)
    #: Whether arms are shown now.
    arm_shown = Signal(bool)

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self._places: Places | None = None
        # Of which map the mouse was last.
        self._at = 0
        self.content, self.least_lines = CompareContent(), 16.0
        self.several_on_hands = False
        self.arm: bool | None = None
        self.picker = OutputPicker(self)
        self.picker.chosen.connect(self.outputs_chosen)
        self.picker.moved.connect(self._emit_pointed_at)
        named(self, "compared_maps", "Compared maps")
        self.setAccessibleDescription(
            "; ".join((*KEYS["skin"].sentences("go", "select", "toggle"), "marked in all maps"))
        )
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    @property
    def output(self) -> int | None:
        """The output that is pointed at, by the mouse or by keys."""
        return self.picker.pointed_at(focused=self.hasFocus())

    @property
    def places(self) -> Places:
        """Where the maps are."""
        if self._places is None:
            room, font = QRectF(self.rect()), tabular(self.font())
            least_lines = 0.0 if self.arm else self.least_lines
            self._places = places_for(room, self.content, font, least_lines)
            self.arm_shown.emit(not self._places.low)
        return self._places

    def points_of(self, index: int) -> Floats:
        """Return the places of the outputs in one of the maps, (n_outputs, 2); NaN: not drawn."""
        cells = self.content.cells
        small = cells[index].small if index < len(cells) else None
        if small is None or self.content.message:
            return np.full((1, 2), np.nan)
        area = self.places.cells[index].map
        frame = small_frame(replace(small, hand_only=self.places.low), area)
        points = frame.to_screen(small.limb_map.output_positions)
        return np.where(points[:, 1:] <= area.bottom(), points, np.nan)

    def minimumSizeHint(self) -> QSize:
        return QSize(200, ceil(least_height(self.fontMetrics().height())))

    def show_content(self, content: CompareContent) -> None:
        """Draw ``content``."""
        marks_first = self.several_on_hands and len(content.cells) > 1
        hands = not self.arm if self.arm is not None else marks_first and content.is_on_hands()
        self.content = replace(content, hands=hands, marks_first=marks_first)
        self.picker.selected = content.outputs
        self._places = None
        self.setAccessibleName(content.message or content.about or "Compared maps")
        self._rest()

    def show_frame(self, cells: tuple[Cell, ...]) -> None:
        """Draw the same maps a moment later."""
        self.content = replace(self.content, cells=cells)
        if self.output is not None:
            self.pointed_at.emit(self.output)
        for place in self.places.cells:
            # The outline is drawn a little beyond.
            self.update(place.map.adjusted(-2, -2, 2, 2).toAlignedRect())
            if self.output is not None:
                self.update(place.value.toAlignedRect())

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._places = None
        self._rest()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        self._places = None
        self._rest()

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, self._claims) or super().event(event)

    def _claims(self, event: QtGui.QKeyEvent) -> bool:
        return meaning_of("skin", event) in _KEYS and self.picker.claims(event)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter, theme, content = QtGui.QPainter(self), current_theme(), self.content
        painter.setFont(tabular(self.font()))
        painter.fillRect(self.rect(), QtGui.QColor(theme.base))
        if content.message or not content.cells:
            painter.setPen(QtGui.QColor(theme.dim))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(QRectF(self.rect()).adjusted(8, 8, -8, -8), flags, content.message)
        else:
            self._paint_maps(painter, theme)
        if self.hasFocus():
            paint_focus_frame(painter, QRectF(self.rect()), theme)

    def _paint_maps(self, painter: QtGui.QPainter, theme: Theme) -> None:
        """Draw the maps and the rubber band."""
        content, places, band = self.content, self.places, self.picker.band
        if content.head_lines:
            painter.setPen(QtGui.QColor(theme.warning))
            right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
            painter.drawText(places.head, right, "SYNTHETIC")
        paint_content(painter, content, places, theme, self.output)
        if band is not None:
            paint_band(painter, band, theme)

    def _look_at(self, point: QPointF) -> None:
        """Note the map under a point; where there is none it stays the one before."""
        cells = enumerate(self.places.cells)
        self._at = next((k for k, place in cells if place.whole.contains(point)), self._at)
        on_map = any(place.map.contains(point) for place in self.places.cells)
        self.picker.reach_px = self.width() + self.height() if on_map else REACH_PX

    def _rest(self) -> None:
        """Look anew at what lies under a pointer that rests: maps are others, or elsewhere."""
        if (at := self.picker.pointer) is not None:
            self._look_at(at)
            self.picker.move(at, self.points_of(self._at))
        self._emit_pointed_at()

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._look_at(event.position())
        self.picker.press(event)

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        if not event.buttons():
            self._look_at(event.position())
        self.picker.move(event.position(), self.points_of(self._at))
        self._emit_pointed_at()

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self.picker.release(event, self.points_of(self._at))
            self.update()

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.picker.leave()
        self._emit_pointed_at()

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        points = self.points_of(self._at)
        unplaced = tuple(int(k) + 1 for k in np.flatnonzero(np.isnan(points[:, 0])))
        middle = QRectF(self.rect()).center()
        if len(unplaced) == len(points) or meaning_of("skin", event) not in _KEYS:
            super().keyPressEvent(event)
        else:
            self.picker.press_key(event, points, unplaced, middle)
            self.update()

    def focusInEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusInEvent(event)
        self._emit_pointed_at()

    def focusOutEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusOutEvent(event)
        self._emit_pointed_at()

    def _emit_pointed_at(self) -> None:
        self.pointed_at.emit(self.output)
        self.update()
