"""The picture of the hand diagram: the drawing of each limb's hand, its sites, painter and caption.

Circles stand for contacts that push into the skin, triangles for contacts that push along a digit.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QPointF, QRectF, QSize, QSizeF, Qt, Signal

from skinsource.base.conventions import Floats
from skinsource.limbs.limb import LimbFacts, LimbMap
from skinsource.limbs.locations import DIGITS, input_name
from skinsource.limbs.own_limbs import facts_of, own_map
from skinsource.limbs.synthetic import HandShape, drawn_hand
from skinsource.specs import fields
from skinsource.specs.spec import SwitchSpec
from skinsource_gui.plots.outputs import output_beyond
from skinsource_gui.plots.small_map import paint_ring
from skinsource_gui.qt.buttons import text_colour_on
from skinsource_gui.qt.frames import Frame, closed_path, polygon
from skinsource_gui.qt.theme import UNIT_PX, Theme, current_theme, is_on_paper, tabular, translucent
from skinsource_gui.qt.wheel import WHOLE, PanZoom

#: Name of the panel, under which a view keeps its settings.
HAND = "hand"


@dataclass(frozen=True, slots=True, kw_only=True)
class HandSettings(fields.CheckedModel):
    """How the hand is seen.

    Attributes
    ----------
    mirrored
        Whether the palm is seen through the hand, so that it lines up with the back on the map.
    """

    mirrored: bool = fields.switch(
        False, SwitchSpec(label="Mirror", hint="Palm seen through the hand, as on the map")
    )


# Corner radius and circumradius of the triangle, in radii of the circle: about the same area.
_TRIANGLE_RADII, _ROUNDING = 1.42, 0.3
# Offset of further inputs at a site behind the first, in radii.
_STEP_RADII = 0.3
_MOST_BEHIND = 2
# Size of a site without a number, in radii; at least some px.
_DOT_RADII, _DOT_PX = 0.34, 3.5
# Smallest letters of numbers; the radius that each digit needs, in heights of its letters.
_LETTERS_PX, _DIGIT = 9.0, 0.33
#: Radius of the smallest site in use.
_IN_USE_PX = 8.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Marker:
    """Where a marker is painted.

    Attributes
    ----------
    site
        The number in the marker.
    centre, radius_px
        Of the circle.
    push
        Direction of an in-axis contact, which makes a triangle; ``None``: a circle.
    """

    site: int
    centre: QPointF
    radius_px: float
    push: QPointF | None

    def path(self, extra_px: float = 0.0) -> QtGui.QPainterPath:
        """Return the outline of the marker, grown by ``extra_px``."""
        if self.push is None:
            path = QtGui.QPainterPath()
            radius = self.radius_px + extra_px
            path.addEllipse(self.centre, radius, radius)
            return path
        # Edges of a triangle move out by half of what its corners do.
        size = _TRIANGLE_RADII * self.radius_px + 2 * extra_px
        across = QPointF(-self.push.y(), self.push.x())
        base = self.centre - self.push * (size / 2)
        half = across * (size * 0.866)
        return _rounded([self.centre + self.push * size, base + half, base - half])


def has_room(place: Marker) -> bool:
    """Return whether a number fits into a marker."""
    return place.radius_px >= max(_DIGIT * len(str(place.site)), 0.5) * _LETTERS_PX


def paint_empty(painter: QtGui.QPainter, place: Marker, theme: Theme, *, inviting: bool) -> None:
    """Paint an unused site; ``inviting`` while something is dragged over the hand."""
    pen = QtGui.QPen(QtGui.QColor(theme.accent if inviting else theme.skin_line), 1.25)
    if inviting:
        pen.setDashPattern([3.0, 3.0])
    _paint_free(painter, place, theme, pen, 0.85 if inviting else 0.55)
    _paint_number(painter, place, QtGui.QColor(theme.text), bold=False)


def paint_dot(painter: QtGui.QPainter, place: Marker, theme: Theme) -> None:
    """Paint an unused site without its number, which would only hide the hand."""
    radius = max(_DOT_RADII * place.radius_px, min(place.radius_px, _DOT_PX))
    dot = replace(place, radius_px=radius)
    _paint_free(painter, dot, theme, QtGui.QPen(QtGui.QColor(theme.skin_line), 1.25), 0.7)


def paint_hovered(painter: QtGui.QPainter, place: Marker, theme: Theme) -> None:
    """Paint an empty site under the mouse, or a site that takes what is dropped."""
    _paint_free(painter, place, theme, QtGui.QPen(QtGui.QColor(theme.text), 2.0), 1.0)
    _paint_number(painter, place, QtGui.QColor(theme.text), bold=True)


def _paint_free(
    painter: QtGui.QPainter, place: Marker, theme: Theme, pen: QtGui.QPen, opacity: float
) -> None:
    fill = translucent(theme.base, round(255 * opacity))
    painter.setPen(pen)
    painter.setBrush(fill)
    painter.drawPath(place.path())


def paint_occupied(
    painter: QtGui.QPainter,
    place: Marker,
    theme: Theme,
    colours: Sequence[QtGui.QColor],
    *,
    silent: bool,
) -> None:
    """Paint a site that holds inputs of these colours, the first one in front.

    A silent input is hollow: its colour is at the rim.  More than one are stacked and counted.
    """
    step = QPointF(1.0, -1.0) * place.radius_px * _STEP_RADII
    halo = QtGui.QPen(QtGui.QColor(theme.base), 1.5)
    behind = list(enumerate(colours))[1 : _MOST_BEHIND + 1]
    for depth, colour in reversed(behind):
        path = place.path().translated(step * depth)
        painter.setPen(halo)
        painter.setBrush(colour)
        painter.drawPath(path)
    front = colours[0]
    painter.setPen(QtGui.QPen(front, 3.0) if silent else halo)
    painter.setBrush(QtGui.QColor(theme.base) if silent else front)
    painter.drawPath(place.path(-1.0 if silent else 0.0))
    text_colour = QtGui.QColor(theme.text) if silent else text_colour_on(front)
    _paint_number(painter, place, text_colour, bold=True)
    if len(colours) > 1:
        corner = place.centre + QPointF(1.0, 1.0) * place.radius_px * 0.95
        _paint_count(painter, corner, place.radius_px, len(colours), theme)


def paint_selection(
    painter: QtGui.QPainter, place: Marker, theme: Theme, *, last: bool = True
) -> None:
    """Paint the ring around a selected input, a strong one around the ``last`` selected."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.base), 6.0))
    painter.drawPath(place.path(3.0))
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 2.5 if last else 1.2))
    painter.drawPath(place.path(3.5))


def paint_cursor(painter: QtGui.QPainter, place: Marker, theme: Theme) -> None:
    """Paint the dashed ring of the keyboard's cursor."""
    radius = place.radius_px * (1.0 if place.push is None else 1.3) + 7.5
    pen = QtGui.QPen(QtGui.QColor(theme.accent), 2.0)
    pen.setDashPattern([3.0, 2.0])
    paint_ring(painter, place.centre, radius, pen, theme)


def _rounded(corners: list[QPointF]) -> QtGui.QPainterPath:
    path = QtGui.QPainterPath()
    for number, corner in enumerate(corners):
        before = corners[number - 1]
        after = corners[(number + 1) % len(corners)]
        start = corner + (before - corner) * _ROUNDING
        if number == 0:
            path.moveTo(start)
        else:
            path.lineTo(start)
        path.quadTo(corner, corner + (after - corner) * _ROUNDING)
    path.closeSubpath()
    return path


def _paint_number(
    painter: QtGui.QPainter, place: Marker, colour: QtGui.QColor, *, bold: bool
) -> None:
    centre = place.centre
    if place.push is not None:
        # The triangle is wider at its base.
        centre = centre - place.push * (0.12 * place.radius_px)
    # As large as the marker, unless it has many digits.
    most = 1.0 / (_DIGIT * len(str(place.site)))
    size = place.radius_px * min(1.05 if place.push is None else 1.0, most)
    _paint_text(painter, centre, str(place.site), size, colour, bold=bold)


def _paint_count(
    painter: QtGui.QPainter, centre: QPointF, radius_px: float, count: int, theme: Theme
) -> None:
    size = max(9.0, 0.72 * radius_px)
    text = f"×{count}"
    width = QtGui.QFontMetricsF(_number_font(painter, size, bold=True)).horizontalAdvance(text)
    # A large count makes a longer badge: cut digits would make it another number.
    half = QPointF(max(0.95 * size, width / 2 + 0.3 * size), 0.68 * size)
    area = QRectF(centre - half, centre + half)
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.base), 1.0))
    painter.setBrush(QtGui.QColor(theme.text))
    painter.drawRoundedRect(area, half.y(), half.y())
    _paint_text(painter, centre, text, size, QtGui.QColor(theme.base), bold=True)


def _paint_text(
    painter: QtGui.QPainter,
    centre: QPointF,
    text: str,
    size_px: float,
    colour: QtGui.QColor,
    *,
    bold: bool,
) -> None:
    font = _number_font(painter, size_px, bold=bold)
    metrics = QtGui.QFontMetricsF(font)
    painter.setFont(font)
    painter.setPen(colour)
    # Digits have no descenders: their middle is half a capital above the baseline.
    left = centre.x() - metrics.horizontalAdvance(text) / 2
    painter.drawText(QPointF(left, centre.y() + metrics.capHeight() / 2), text)


def _number_font(painter: QtGui.QPainter, size_px: float, *, bold: bool) -> QtGui.QFont:
    font = tabular(painter.font())
    font.setPixelSize(max(round(_LETTERS_PX), round(size_px)))
    font.setWeight(QtGui.QFont.Weight.Bold if bold else QtGui.QFont.Weight.Medium)
    return font


#: Length of the arm below the wrist, and where it begins to fade, in outline px.
_ARM_PX = 52.0
_FADE_PX = 12.0
# Widths, px, and opacity of the soft shade along the edge.
_SHADES = ((26.0, 0.05), (17.0, 0.06), (10.0, 0.07), (5.0, 0.08))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HandDrawing:
    """A palm in outline pixels, x right, y down; 400 pixels make a hand length.

    Attributes
    ----------
    outline, creases
        What is filled and what is drawn on it.
    bounds
        The hand and a bit of the arm.
    sites : (n_sites, 2)
        Input places; of 1 to 5 of the published limbs the very end of the digit.
    pushes : (n_sites, 2)
        Unit vectors along which in-axis contacts push; zero for perpendicular ones.
    anchors : (n, 2)
        Points of the drawing of which the places on the limb's map are known.
    limb
        Name of the limb, for the names of its places.
    mirrored
        Whether the palm is seen through the hand.
    side
        Text that says which hand this is.
    spacing : (n_sites,)
        Distance to the nearest other site, where markers shrink so as not to cover each other;
        infinite where there is room for all.
    contacts
        Whether it is known how contacts push.
    fade
        Where the picture begins and ends to fade, y; None: it does not.
    """

    outline: QtGui.QPainterPath
    creases: QtGui.QPainterPath
    bounds: QRectF
    sites: NDArray[np.float64]
    pushes: NDArray[np.float64]
    spacing: NDArray[np.float64]
    anchors: NDArray[np.float64]
    limb: str = ""
    mirrored: bool = False
    side: str = "Right hand,\npalm side"
    contacts: bool = True
    fade: tuple[float, float] | None = (_FADE_PX, _ARM_PX)


def palmar_drawing(shape: HandShape) -> HandDrawing:
    """Return the palm of a hand that is given as seen from its back."""

    def palmar(points: NDArray[np.float64]) -> NDArray[np.float64]:
        # Seen from the palm, left and right change places; on screen y points down.
        return shape.wrist - points

    creases = QtGui.QPainterPath()
    for line in shape.creases:
        creases.addPolygon(polygon(palmar(line)))
    sites, pushes = palmar(shape.input_positions), np.zeros((len(shape.input_positions), 2))
    for digit, axis in zip(range(len(DIGITS)), shape.digit_axes, strict=True):
        sites[digit] = palmar(axis[-1])
        inwards = palmar(axis[-2]) - sites[digit]
        pushes[digit] = inwards / np.linalg.norm(inwards)
    shown = palmar(shape.outline)
    shown = shown[shown[:, 1] < _ARM_PX]
    left, top = shown.min(axis=0)
    return HandDrawing(
        outline=closed_path(palmar(shape.outline)),
        creases=creases,
        bounds=QRectF(QPointF(left, top), QPointF(float(shown[:, 0].max()), _ARM_PX)),
        sites=sites,
        pushes=pushes,
        spacing=np.full(len(sites), np.inf),
        anchors=palmar(shape.input_positions),
    )


@lru_cache(maxsize=2)
def mirrored(drawing: HandDrawing) -> HandDrawing:
    """Return the palm as it is seen through the hand, from its back."""
    turned, flip = QtGui.QTransform.fromScale(-1.0, 1.0), np.array([-1.0, 1.0])
    return replace(
        drawing,
        outline=turned.map(drawing.outline),
        creases=turned.map(drawing.creases),
        bounds=turned.mapRect(drawing.bounds),
        sites=drawing.sites * flip,
        pushes=drawing.pushes * flip,
        anchors=drawing.anchors * flip,
        mirrored=True,
        side=drawing.side.replace("palm side", "palm seen\nthrough it"),
    )


def hand_pixmap(
    drawing: HandDrawing, transform: QtGui.QTransform, size: QSize, ratio: float, theme: Theme
) -> QtGui.QPixmap:
    """Return a picture of the hand alone, without its sites, on a transparent ground.

    Parameters
    ----------
    transform
        From the drawing's outline pixels to the widget's pixels.
    size, ratio
        Of the widget, and device pixels per widget pixel.
    """
    # A panel without room is painted in pictures of the window all the same.
    pixmap = QtGui.QPixmap((size * ratio).expandedTo(QSize(1, 1)))
    pixmap.setDevicePixelRatio(ratio)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QtGui.QPainter(pixmap)
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    outline, line = transform.map(drawing.outline), QtGui.QColor(theme.skin_line)
    painter.fillPath(outline, QtGui.QColor(theme.skin))
    painter.save()
    painter.setClipPath(outline)
    scale = transform.m11()
    for width, opacity in _SHADES:
        painter.strokePath(outline, _pen(line, opacity, width * scale))
    painter.restore()
    painter.strokePath(transform.map(drawing.creases), _pen(line, 0.5, max(1.0, 1.7 * scale)))
    painter.strokePath(outline, _pen(line, 1.0, max(1.25, 2.0 * scale)))
    if drawing.fade is not None:
        wrist, end = (transform.map(QPointF(0.0, y)).y() for y in drawing.fade)
        fade = QtGui.QLinearGradient(0.0, wrist, 0.0, end)
        fade.setColorAt(0.0, Qt.GlobalColor.black)
        fade.setColorAt(1.0, Qt.GlobalColor.transparent)
        painter.setCompositionMode(QtGui.QPainter.CompositionMode.CompositionMode_DestinationIn)
        painter.fillRect(QRectF(QPointF(0.0, 0.0), size.toSizeF()), fade)
    painter.end()
    return pixmap


#: The same with a cache, for the screen.
cached_hand_pixmap = lru_cache(maxsize=2)(hand_pixmap)


def _pen(colour: QtGui.QColor, opacity: float, width: float) -> QtGui.QPen:
    faint = translucent(colour, round(255 * opacity))
    cap, join = Qt.PenCapStyle.RoundCap, Qt.PenJoinStyle.RoundJoin
    return QtGui.QPen(faint, width, Qt.PenStyle.SolidLine, cap, join)


#: Radius of a site in outline pixels; on the screen it is neither smaller nor larger than these.
_SITE_PX, _LEAST_PX, _LARGEST_PX = 17.0, 9.5, 26.0
# In a crowd the radius is this share of the distance to the nearest site, but stays visible.
_OF_SPACING, _CROWDED_PX = 0.44, 2.5
# Room beside and above the hand for the markers off its fingertips, in radii.
_SIDE_RADII, _TOP_RADII = 1.6, 2.9
#: An in-axis marker is this far off its fingertip, in radii.
_OFF_TIP_RADII = 1.32
# A click may miss a site by this factor of its radius; a drag snaps from farther, so that between
# neighbouring sites there is no gap in which it would be cancelled.
_HIT_RADII, _SNAP_RADII, _SNAP_OUTLINE_PX = 1.25, 2.6, 45.0
#: A click within this distance hits a site, however small it is drawn, px.
_HIT_PX = 9.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HandLayout:
    """Where the hand and its sites lie in a widget.

    Attributes
    ----------
    transform
        From the drawing's outline pixels to the widget's pixels.
    radii_px : (n_sites,)
        Of the sites' circles.
    centres : (n_sites, 2)
        Of the sites' markers, in widget pixels.
    pushes : (n_sites, 2)
        As in `HandDrawing`.
    """

    transform: QtGui.QTransform
    radii_px: NDArray[np.float64]
    centres: NDArray[np.float64]
    pushes: NDArray[np.float64]

    @property
    def n_sites(self) -> int:
        """Number of sites."""
        return len(self.centres)

    def has(self, site: int) -> bool:
        """Return whether ``site`` is on this hand."""
        return 1 <= site <= self.n_sites

    def centre(self, site: int) -> QPointF:
        """Return the middle of the marker of ``site``, which must be on this hand."""
        x, y = self.centres[site - 1]
        return QPointF(float(x), float(y))

    def radius_px(self, site: int) -> float:
        """Return radius of the circle of ``site``."""
        return float(self.radii_px[site - 1])

    def radius_in_use_px(self, site: int) -> float:
        """Return the radius of a site in use or pointed at: its number fits in."""
        return max(self.radius_px(site), _IN_USE_PX, _DIGIT * len(str(site)) * _LETTERS_PX)

    def push(self, site: int) -> QPointF | None:
        """Return the direction of an in-axis contact; ``None`` for a perpendicular one."""
        x, y = self.pushes[site - 1]
        return QPointF(float(x), float(y)) if x or y else None

    def marker_area(self, site: int) -> QRectF:
        """Return square around the marker of ``site``."""
        half = QPointF(1.0, 1.0) * self.radius_px(site)
        return QRectF(self.centre(site) - half, self.centre(site) + half)

    def site_at(self, position: QPointF) -> int | None:
        """Return the site under the mouse."""
        return self._nearest(position, np.maximum(_HIT_RADII * self.radii_px, _HIT_PX))

    def site_to_snap_to(self, position: QPointF) -> int | None:
        """Return the site that takes what is dropped at ``position``."""
        own, drawn = _SNAP_RADII * self.radii_px, _SNAP_OUTLINE_PX * self.transform.m11()
        return self._nearest(position, np.maximum(own, drawn))

    def neighbour(self, site: int, direction: tuple[int, int]) -> int:
        """Return the nearest site in ``direction`` (x right, y down), else ``site``."""
        return output_beyond(self.centres, site, *direction)

    def _nearest(self, position: QPointF, reach_px: NDArray[np.float64]) -> int | None:
        distances = np.hypot(*(self.centres - (position.x(), position.y())).T)
        nearest = int(np.argmin(distances))
        return nearest + 1 if distances[nearest] <= reach_px[nearest] else None


def fitted_hand(drawing: HandDrawing, area: QRectF) -> Frame:
    """Return the frame that fits the hand and the markers off its fingertips into ``area``."""
    radius = _LEAST_PX
    for _ in range(2):  # The room for markers depends on the scale and the scale on the room.
        width = area.width() - 2 * _SIDE_RADII * radius
        height = area.height() - _TOP_RADII * radius
        scale = max(
            min(width / drawing.bounds.width(), height / drawing.bounds.height()),
            0.1,
        )
        radius = float(_radii_px(drawing, scale).max(initial=0.0))
    spare = area.height() - _TOP_RADII * radius - scale * drawing.bounds.height()
    return Frame(
        scale=scale,
        left=area.center().x() - scale * drawing.bounds.center().x(),
        top=area.top() + _TOP_RADII * radius + spare / 2 - scale * drawing.bounds.top(),
    )


def hand_layout(drawing: HandDrawing, frame: Frame) -> HandLayout:
    """Return where the sites of a hand lie that is drawn in ``frame``."""
    radii = _radii_px(drawing, frame.scale)
    return HandLayout(
        transform=frame.transform(),
        radii_px=radii,
        centres=frame.to_screen(drawing.sites) - drawing.pushes * radii[:, None] * _OFF_TIP_RADII,
        pushes=drawing.pushes,
    )


def _radii_px(drawing: HandDrawing, scale: float) -> NDArray[np.float64]:
    usual = float(np.clip(_SITE_PX * scale, _LEAST_PX, _LARGEST_PX))
    return np.clip(_OF_SPACING * scale * drawing.spacing, _CROWDED_PX, usual)


@dataclass(frozen=True, slots=True, kw_only=True)
class Mark:
    """One input as the diagram shows it.

    Attributes
    ----------
    site
        Its place, which need not be on this hand.
    silent
        Whether it is not heard: muted, or others are solo.
    text
        What it plays, for tooltips.
    """

    site: int
    colour: QtGui.QColor
    silent: bool = False
    text: str = ""
    chosen: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class HandState:
    """Everything that the diagram shows, besides size and theme.

    Attributes
    ----------
    marks, selected
        The inputs, and the number of the one that was selected last.
    hovered, cursor
        Site under the mouse; site of the keyboard's cursor where it is shown.
    moving, ghost, target
        Number of the input that is being moved, where it floats, and the site that takes it.
    ring
        The place under the pointer here or on the skin, in outline pixels of the drawing.
    """

    marks: tuple[Mark, ...] = ()
    selected: int | None = None
    hovered: int | None = None
    cursor: int | None = None
    moving: int | None = None
    ghost: QPointF | None = None
    target: int | None = None
    ring: tuple[float, float] | None = None

    @property
    def selected_site(self) -> int | None:
        """Site of the input that was selected last."""
        return None if self.selected is None else self.marks[self.selected].site

    def at(self, site: int) -> tuple[int, ...]:
        """Return the numbers of the inputs at ``site``."""
        return tuple(k for k, mark in enumerate(self.marks) if mark.site == site)

    def front_at(self, site: int) -> int | None:
        """Return the input that a click at ``site`` selects: the selected one, else the latest."""
        present = self.at(site)
        if self.selected in present:
            return self.selected
        return present[-1] if present else None

    def next_at(self, site: int) -> int | None:
        """Return the input after the selected one at ``site``; after the last comes the first."""
        present = self.at(site)
        if self.selected not in present:
            return self.front_at(site)
        return present[(present.index(self.selected) + 1) % len(present)]


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
_ARM_FADE_PX = 40.0


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
        return squares * np.log(np.maximum(squares, 1e-30))


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

    sites = _separated(palmar(limb_map.input_positions))
    side = "Left" if facts.left else "Right"
    swapped = "\nmirrored," if facts.mirrored else ""
    bounds = _bounds(palmar(limb_map.outline), sites[np.isfinite(sites[:, 0])])
    left = float(palmar(limb_map.outline)[:, 0].min())
    sites, bounds = _with_unplaced(sites, bounds, left)
    below = float(palmar(limb_map.outline)[:, 1].max()) - bounds.bottom()
    return HandDrawing(
        outline=closed_path(palmar(limb_map.outline)),
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
        fade=(bounds.bottom() - _ARM_FADE_PX, bounds.bottom()) if below > 1.0 else None,
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
