"""The picture of the hand diagram: the drawing of each limb's hand, its painter and its caption."""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QPointF, QRectF, QSize, QSizeF, Qt, Signal

from skinsource.base.arrays import Floats
from skinsource.limbs.limb import LimbFacts, LimbMap
from skinsource.limbs.locations import input_name
from skinsource.limbs.own_limbs import facts_of, own_map
from skinsource.limbs.synthetic import drawn_hand
from skinsource_gui.panels.hand.layout import (
    HandDrawing,
    HandLayout,
    HandState,
    Mark,
    Marker,
    cached_hand_pixmap,
    fitted_hand,
    hand_layout,
    hand_pixmap,
    has_room,
    mirrored,
    paint_cursor,
    paint_dot,
    paint_empty,
    paint_hovered,
    paint_occupied,
    paint_selection,
    palmar_drawing,
    polygon,
)
from skinsource_gui.plots.small_map import paint_ring
from skinsource_gui.qt.theme import UNIT_PX, current_theme, is_on_paper
from skinsource_gui.qt.wheel import WHOLE, PanZoom

#: What an empty hand asks for.
HINT = "Click a place on the hand"


def caption_of(state: HandState, limb: str, fits: Callable[[str], bool]) -> str:
    """Return the text below the hand: the place pointed at or ringed, or what can be done.

    The whole name of a place is returned where it fits, else the short one.
    """
    ringed = state.selected_site if state.cursor is None else state.cursor
    site = state.target or state.hovered or ringed
    if site is None:
        return HINT if not state.marks else ""
    place = input_name(site, limb)
    whole = f"{site} · {place.name}"
    return whole if fits(whole) else f"{site} · {place.short_name}"


# Outline pixels in one hand length, as in the project's own hand.
_HAND_PX = 400.0
# Visible margin around the outermost sites, in hand lengths.
_AROUND = 0.22
# Distance of sites from a point that they share; distance of sites without a place, which are
# drawn in columns beside the hand.
_AROUND_POINT_PX, _BESIDE_PX = 6.0, 40.0
_FADE_PX = 40.0


def drawing_of(limb: str, *, through: bool = False) -> HandDrawing:
    """Return the palm of a limb by its name, or as it is seen ``through`` the hand.

    For an unknown limb it is the project's own hand.
    """
    own = own_map(limb)
    drawing = _standard() if own is None else _own(own, facts_of(limb))
    return mirrored(drawing) if through else drawing


class _Plate:
    """A thin plate that is bent so that points ``start`` go to points ``end``, both (n, 2).

    SciPy has it too, but takes half a second to begin, which the pointer would show.
    """

    def __init__(self, start: Floats, end: Floats) -> None:
        self._start, n = start / _HAND_PX, len(start)
        flat = np.column_stack((np.ones(n), self._start))
        system = np.block([[self._bending(self._start), flat], [flat.T, np.zeros((3, 3))]])
        self._weights = np.linalg.solve(system, np.vstack((end, np.zeros((3, 2)))))

    def __call__(self, at: tuple[float, float]) -> tuple[float, float]:
        point = np.array([at]) / _HAND_PX
        x, y = np.concatenate((self._bending(point)[0], [1.0], point[0])) @ self._weights
        return float(x), float(y)

    def _bending(self, points: Floats) -> Floats:
        squares = np.square(points[:, None] - self._start).sum(axis=-1)
        bending: Floats = squares * np.log(np.maximum(squares, 1e-30))
        return bending


class PlacesOfMap:
    """Finds places of a limb's map on the drawing of its hand, and back.

    The project's own hand has other fingers than a limb that was measured.

    Attributes
    ----------
    on_map, on_drawing
        Return the place on the map of a point of the drawing; the point of a place on the map.
    """

    def __init__(self, drawing: HandDrawing, limb_map: LimbMap) -> None:
        places = limb_map.input_positions
        if not drawing.contacts:
            # An own limb is drawn as its map is.
            places = limb_map.outline[:: _step(limb_map.outline)]
        self.on_map, self.on_drawing = (
            _Plate(drawing.anchors, places),
            _Plate(places, drawing.anchors),
        )


#: The same with a cache, for the pointer.
places_of_map = lru_cache(maxsize=4)(PlacesOfMap)
# So many vertices of an outline are enough to know where it lies.
_ANCHORS = 40


def _step(outline: Floats) -> int:
    return max(len(outline) // _ANCHORS, 1)


@lru_cache(maxsize=1)
def _standard() -> HandDrawing:
    return palmar_drawing(drawn_hand(1))


@lru_cache(maxsize=8)
def _own(limb_map: LimbMap, facts: LimbFacts) -> HandDrawing:
    """Return outline and places as the lab gave them, seen from the palm."""
    scale = _HAND_PX / limb_map.hand_length_px

    def palmar(points: Floats) -> Floats:
        # Seen from the palm left and right change places; on screen y points down.
        return -scale * points

    outline = QtGui.QPainterPath()
    outline.addPolygon(polygon(palmar(limb_map.outline)))
    outline.closeSubpath()
    sites = _separated(palmar(limb_map.input_positions))
    side = "Left" if facts.left else "Right"
    swapped = "\nmirrored," if facts.mirrored else ""
    bounds = _bounds(palmar(limb_map.outline), sites[np.isfinite(sites[:, 0])])
    left = float(palmar(limb_map.outline)[:, 0].min())
    sites, bounds = _with_unplaced(sites, bounds, left)
    below = float(palmar(limb_map.outline)[:, 1].max()) - bounds.bottom()
    return HandDrawing(
        outline=outline,
        creases=QtGui.QPainterPath(),
        bounds=bounds,
        sites=sites,
        pushes=np.zeros_like(sites),
        anchors=palmar(limb_map.outline)[:: _step(limb_map.outline)],
        limb=facts.name,
        side=f"{side} hand,{swapped}\npalm side",
        spacing=spacing_of(sites),
        contacts=False,
        # Where a long arm goes on it fades, as the project's own.
        fade=(bounds.bottom() - _FADE_PX, bounds.bottom()) if below > 1.0 else None,
    )


def _bounds(outline: Floats, sites: Floats) -> QRectF:
    """Return the visible area: the sites and the hand around them, not the rest of a long arm."""
    shown = sites if len(sites) else outline
    margin = _AROUND * _HAND_PX
    low = np.maximum(outline.min(axis=0), shown.min(axis=0) - margin)
    high = np.minimum(outline.max(axis=0), shown.max(axis=0) + margin)
    width, height = np.maximum(high - low, 1.0)
    return QRectF(float(low[0]), float(low[1]), float(width), float(height))


def _with_unplaced(sites: Floats, bounds: QRectF, left: float) -> tuple[Floats, QRectF]:
    """Return sites, those without a place beside the hand, and the visible area then."""
    nowhere = np.flatnonzero(np.isnan(sites[:, 0]))
    if not nowhere.size:
        return sites, bounds
    in_column = max(int(bounds.height() / _BESIDE_PX), 1)
    column, row = np.divmod(np.arange(nowhere.size), in_column)
    all_sites = sites.copy()
    all_sites[nowhere, 0] = left - _BESIDE_PX * (0.5 + column)
    all_sites[nowhere, 1] = bounds.top() + _BESIDE_PX * (0.5 + row)
    visible = QRectF(bounds)
    visible.setLeft(left - _BESIDE_PX * (column.max() + 1.0))
    return all_sites, visible


def _separated(sites: Floats) -> Floats:
    """Return sites; those at one point, as contacts of two kinds may be, around it."""
    _, group, count = np.unique(sites, axis=0, return_inverse=True, return_counts=True)
    separated = sites.copy()
    for shared in np.flatnonzero(count > 1):
        members = np.flatnonzero(group == shared)
        angles = 2.0 * np.pi * np.arange(members.size) / members.size
        separated[members] += _AROUND_POINT_PX * np.column_stack((np.cos(angles), np.sin(angles)))
    return separated


def spacing_of(sites: Floats) -> Floats:
    """Return the distance of each site to the nearest other, (n,); infinite where none is."""
    distances = np.linalg.norm(sites[:, None] - sites[None], axis=-1)
    distances[np.isnan(distances)] = np.inf
    np.fill_diagonal(distances, np.inf)
    return np.asarray(distances.min(axis=1, initial=np.inf))


# Radius of the ring at the place under the pointer.
_RING_PX = 7.0
# From this height on there is a legend below the hand.
_ROOMY_PX = 300
# With large letters the text on the side takes at most this share of the width.
_MOST_SIDE = 0.35
# Text that is this much larger than usual is meant for an audience.
_ENLARGED = 1.1
# Pixels of the hand in a px on paper, for 600 dots per inch.
_PAPER_RATIO = 6.25
_LEGEND = (("perpendicular", None), ("in-axis", QPointF(0.0, 1.0)))


_CONTACTS = {
    "perpendicular": "perpendicular: pushes into the skin",
    "in-axis": "in-axis: pushes along the digit",
}


class HandStage(QObject):
    """The hand with its inputs, in a widget: what it shows, and which part of it is visible.

    Parameters
    ----------
    drawing
        The hand.
    widget
        Where it is painted.

    Attributes
    ----------
    state
        What is shown.
    area
        Where the hand is seen.
    layout
        Where the sites are, in pixels of the widget.
    pan_zoom
        Which part of the hand is visible.
    """

    #: State, layout or drawing changed.
    changed = Signal()

    def __init__(self, drawing: HandDrawing, widget: QtWidgets.QWidget) -> None:
        super().__init__(widget)
        self.drawing = drawing
        self.state = HandState()
        self.area = QRectF(0.0, 0.0, 260.0, 330.0)
        self.layout: HandLayout = hand_layout(drawing, fitted_hand(drawing, self.area))
        self._size = QSize()
        self._line_px = 0.0
        self._lines = 2
        self.pan_zoom = PanZoom(widget)
        self.pan_zoom.changed.connect(self._lay_out)

    def show_drawing(self, drawing: HandDrawing, widget: QtWidgets.QWidget) -> None:
        """Take over another hand, which has other sites."""
        if drawing is not self.drawing:
            self.drawing = drawing
            self.state = replace(self.state, hovered=None, cursor=None, target=None, ring=None)
            self.layout = hand_layout(drawing, fitted_hand(drawing, self.area))
            self.fit(widget)
            self.pan_zoom.show(WHOLE)
            self.changed.emit()

    def change(self, **changes: Any) -> None:
        """Replace fields of the state; emit `changed` where that makes a difference."""
        changed = replace(self.state, **changes)
        if changed != self.state:
            self.state = changed
            self.changed.emit()

    def fit(self, widget: QtWidgets.QWidget) -> None:
        """Fit the hand into the widget, which has another size or font; text lies below it."""
        self._size, metrics = widget.size(), QtGui.QFontMetricsF(widget.font())
        self._line_px = metrics.height() + 2.0
        general = QtGui.QFontDatabase.systemFont(QtGui.QFontDatabase.SystemFont.GeneralFont)
        enlarged = metrics.height() > _ENLARGED * QtGui.QFontMetricsF(general).height()
        # Where there is little room, the hand needs it more than the legend.
        width, height = self._size.width(), self._size.height()
        legend = sum(_widths(metrics)) + 2 * UNIT_PX
        self._lines = 2 if height >= _ROOMY_PX and (not enlarged or legend <= width) else 1
        self.area = QRectF(0.0, 2.0, width, height - self._lines * self._line_px - UNIT_PX)
        outline = self.drawing.outline.toFillPolygon().toList()
        points = np.array([(point.x(), point.y()) for point in outline])
        fits = {WHOLE: fitted_hand(self.drawing, self.area)}
        self.pan_zoom.arrange(fits, points, self.area)

    def paint(self, painter: QtGui.QPainter, ratio: float) -> None:
        """Paint all; ``ratio`` is device pixels per widget pixel."""
        state = self.state
        if is_on_paper():
            # On paper there is neither mouse nor cursor.
            state = replace(state, hovered=None, cursor=None, target=None, ring=None)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        font = painter.font()
        painter.save()
        # A magnified hand would cover the text below it.
        painter.setClipRect(self.area.adjusted(0, -2, 0, UNIT_PX / 2))
        painter.drawPixmap(0, 0, self._hand(ratio))
        for site in self._in_order(state):
            self._paint_site(painter, site, state)
        if state.cursor is not None:
            paint_cursor(painter, self._place(state.cursor, in_use=True), current_theme())
        if state.ring is not None:
            centre = self.layout.transform.map(QPointF(*state.ring))
            pen = QtGui.QPen(QtGui.QColor(current_theme().text), 1.5)
            paint_ring(painter, centre, _RING_PX, pen, current_theme())
        painter.restore()
        if state.ghost is not None and state.moving is not None:
            self._paint_ghost(painter, state.ghost, state.marks[state.moving])
        painter.setFont(font)
        self._paint_side(painter)
        self._paint_caption(painter, state)
        if self._lines > 1 and self.drawing.contacts:
            self._paint_legend(painter)

    def site_at(self, position: QPointF) -> int | None:
        """Return the site under the mouse; a site outside of the picture cannot be hit."""
        inside = self.area.adjusted(0, -2, 0, float(self.layout.radii_px.max()))
        return self.layout.site_at(position) if inside.contains(position) else None

    def text(self, site: int) -> str:
        """Return the text about a site, in lines."""
        place = input_name(site, self.drawing.limb)
        lines = [f"{site} · {place.name}", *filter(None, [_CONTACTS.get(place.kind, "")])]
        for index in self.state.at(site):
            chosen = ", selected" if index == self.state.selected else ""
            lines.append(f"Input {index + 1}: {self.state.marks[index].text}{chosen}")
        return "\n".join(lines)

    def description(self, site: int) -> str:
        """Return the text about a site as a sentence for assistive technology."""
        text = "Place " + self.text(site).replace("\n", ". ")
        return text if self.state.marks else f"{HINT}. {text}"

    def _lay_out(self) -> None:
        if self.pan_zoom.frame is not None:
            self.layout = hand_layout(self.drawing, self.pan_zoom.frame)
            self.changed.emit()

    def _hand(self, ratio: float) -> QtGui.QPixmap:
        about = self.drawing, self.layout.transform, self._size
        if is_on_paper():
            return hand_pixmap(*about, _PAPER_RATIO, current_theme())
        return cached_hand_pixmap(*about, ratio, current_theme())

    def _in_order(self, state: HandState) -> list[int]:
        """Return all sites in the order of painting: in use, selected and pointed at come last."""
        above = [*sorted({mark.site for mark in state.marks}), state.selected_site, state.cursor]
        above += [state.hovered, state.target]
        # Each once, where it comes last.
        last = dict.fromkeys(site for site in reversed(above) if site and self.layout.has(site))
        quiet = [site for site in range(1, self.layout.n_sites + 1) if site not in last]
        return [*quiet, *reversed(last)]

    def _place(self, site: int, *, in_use: bool) -> Marker:
        radius_px = self.layout.radius_in_use_px if in_use else self.layout.radius_px
        return Marker(
            site=site,
            centre=self.layout.centre(site),
            radius_px=radius_px(site),
            push=self.layout.push(site),
        )

    def _paint_site(self, painter: QtGui.QPainter, site: int, state: HandState) -> None:
        if site == state.target and state.moving is None:
            # Something from another panel is dragged over it.
            paint_cursor(painter, self._place(site, in_use=True), current_theme())
        front, chosen = state.front_at(site), site in (state.hovered, state.target)
        place = self._place(site, in_use=front is not None or chosen or site == state.cursor)
        if front is None:
            if chosen:
                paint_hovered(painter, place, current_theme())
            elif not has_room(place):
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

    def _paint_ghost(self, painter: QtGui.QPainter, centre: QPointF, mark: Mark) -> None:
        ghost = replace(self._place(mark.site, in_use=True), centre=centre)
        painter.setOpacity(0.6)
        paint_occupied(painter, ghost, current_theme(), [mark.colour], silent=mark.silent)
        painter.setOpacity(1.0)

    def _paint_caption(self, painter: QtGui.QPainter, state: HandState) -> None:
        metrics, area = QtGui.QFontMetricsF(painter.font()), self._line_area(self._lines)
        limb = self.drawing.limb
        text = caption_of(state, limb, lambda text: metrics.horizontalAdvance(text) <= area.width())
        colour = current_theme().accent if text == HINT else current_theme().text
        text = metrics.elidedText(text, Qt.TextElideMode.ElideRight, area.width())
        painter.setPen(QtGui.QColor(colour))
        painter.drawText(area, Qt.AlignmentFlag.AlignCenter, text)

    def _paint_side(self, painter: QtGui.QPainter) -> None:
        """Write which hand this is into the free corner below the thumb."""
        bottom = self._line_area(self._lines).bottomRight() - QPointF(0.0, 1.5 * self._line_px)
        metrics = QtGui.QFontMetricsF(painter.font())
        lines = self.drawing.side.split("\n")
        width = 1.0 + max(metrics.horizontalAdvance(line) for line in lines)
        if width > _MOST_SIDE * self._size.width():
            return  # it would cover the fingers
        area = QRectF(bottom - QPointF(width, 4 * self._line_px), bottom)
        side = Qt.AlignmentFlag.AlignRight
        if self.drawing.mirrored:
            area.moveLeft(self._line_area(1).left())
            side = Qt.AlignmentFlag.AlignLeft
        painter.setPen(QtGui.QColor(current_theme().dim))
        painter.drawText(area, side | Qt.AlignmentFlag.AlignBottom, self.drawing.side)

    def _paint_legend(self, painter: QtGui.QPainter) -> None:
        metrics, area = QtGui.QFontMetricsF(painter.font()), self._line_area(1)
        radius = 0.36 * metrics.height()
        advance = 2 * radius + UNIT_PX
        widths = _widths(metrics)
        left = area.center().x() - (sum(widths) + 2 * UNIT_PX) / 2
        for (text, push), width in zip(_LEGEND, widths, strict=True):
            sign = Marker(
                site=0,
                centre=QPointF(left + radius, area.center().y() - (0 if push is None else 1)),
                radius_px=radius * (1.0 if push is None else 0.85),
                push=push,
            )
            painter.setPen(QtGui.QColor(current_theme().dim))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawPath(sign.path())
            at = QRectF(QPointF(left + advance, area.top()), QSizeF(width, area.height()))
            painter.drawText(at, Qt.AlignmentFlag.AlignVCenter, text)
            left += width + 2 * UNIT_PX

    def _line_area(self, from_bottom: int) -> QRectF:
        top = self._size.height() - from_bottom * self._line_px - UNIT_PX / 2
        return QRectF(UNIT_PX, top, max(0.0, self._size.width() - 2.0 * UNIT_PX), self._line_px)


def _widths(metrics: QtGui.QFontMetricsF) -> list[float]:
    """Return the widths of the parts of the legend, sign and text."""
    advance = 2 * 0.36 * metrics.height() + UNIT_PX
    return [advance + metrics.horizontalAdvance(text) for text, _ in _LEGEND]
