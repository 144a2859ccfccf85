"""The hand diagram as data and paint: its drawing, where its sites lie, and their markers.

Circles stand for contacts that push into the skin, triangles for contacts that push along a digit.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from PySide6 import QtGui
from PySide6.QtCore import QPointF, QRectF, QSize, Qt

from skinsource.limbs.locations import DIGITS
from skinsource.limbs.synthetic import HandShape
from skinsource_gui.plots.outputs import output_beyond
from skinsource_gui.qt.buttons import text_colour_on
from skinsource_gui.qt.frames import Frame
from skinsource_gui.qt.theme import Theme, tabular, translucent

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


def least_radius_px(site: int) -> float:
    """Return the smallest radius of a site that is in use: its number fits in."""
    return max(_IN_USE_PX, _DIGIT * len(str(site)) * _LETTERS_PX)


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
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.base), 4.0))
    painter.drawEllipse(place.centre, radius, radius)
    pen = QtGui.QPen(QtGui.QColor(theme.accent), 2.0)
    pen.setDashPattern([3.0, 2.0])
    painter.setPen(pen)
    painter.drawEllipse(place.centre, radius, radius)


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

    outline, creases = QtGui.QPainterPath(), QtGui.QPainterPath()
    outline.addPolygon(polygon(palmar(shape.outline)))
    outline.closeSubpath()
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
        outline=outline,
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
    pixmap = QtGui.QPixmap(size * ratio)
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


def polygon(points: NDArray[np.float64]) -> QtGui.QPolygonF:
    """Return points as a polygon of Qt."""
    return QtGui.QPolygonF([QPointF(x, y) for x, y in points])


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
        return max(self.radius_px(site), least_radius_px(site))

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
