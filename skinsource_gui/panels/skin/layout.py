"""Where the parts of the skin map lie on the screen, and the drawing of the sensors' axes."""

from dataclasses import dataclass

from PySide6 import QtGui
from PySide6.QtCore import QLineF, QPointF, QRectF, QSizeF, Qt

from skinsource.base.arrays import Floats
from skinsource.base.measurement_conditions import VOLAR_OUTPUTS
from skinsource.design.labels import PALM_SIDE, TRIAD
from skinsource.limbs.limb import LimbMap
from skinsource_gui.plots.small_map import bounds_of, smallest_spacing
from skinsource_gui.qt.frames import Frame, fitted
from skinsource_gui.qt.theme import Theme
from skinsource_gui.qt.wheel import FREE, WHOLE, PanZoom

#: Caption below the drawing: x and y have another direction at each sensor.
CAPTION = ("x, y differ", "by sensor")
TITLE = "Axes"

# Angle of the x arrow, degrees counter-clockwise: a direction without a meaning on the map.
_TURNED = 28.0
# Size of the drawing, and of its parts, in lines of text.
_DRAWING_LINES, _ARM_LINES, _RING_LINES, _FOOT_LINES = 2.7, 1.15, 0.3, 0.4


def triad_size(metrics: QtGui.QFontMetricsF) -> QSizeF:
    """Return the size of the card with the axes."""
    line = metrics.height()
    width = max(map(metrics.horizontalAdvance, (TITLE, *CAPTION))) + 0.9 * line
    return QSizeF(width, (1.3 + _DRAWING_LINES + len(CAPTION) + _FOOT_LINES) * line)


def paint_triad(painter: QtGui.QPainter, card: QRectF, theme: Theme) -> None:
    """Draw z out of the skin, x and y along it, dashed, and a caption."""
    line = painter.fontMetrics().height()
    centred = Qt.AlignmentFlag.AlignCenter
    painter.setPen(QtGui.QColor(theme.dim))
    top = QRectF(card.left(), card.top(), card.width(), 1.3 * line)
    painter.drawText(top, centred, TITLE)
    middle = QPointF(card.center().x() - 0.3 * line, top.bottom() + 0.62 * _DRAWING_LINES * line)
    colour = QtGui.QColor(theme.text)
    for axis, angle in ((TRIAD[0], _TURNED), (TRIAD[1], _TURNED + 90.0)):
        _paint_arrow(painter, middle, angle, line, axis.title, colour)
    ring = _RING_LINES * line
    painter.setPen(QtGui.QPen(colour, 0.1 * line))
    painter.setBrush(QtGui.QColor(theme.base))
    painter.drawEllipse(middle, ring, ring)
    painter.setBrush(colour)
    painter.drawEllipse(middle, 0.07 * line, 0.07 * line)
    beside = QRectF(middle.x() - 1.1 * line, middle.y() - 0.1 * line, 0.8 * line, line)
    painter.drawText(beside, centred, TRIAD[2].title)
    painter.setPen(QtGui.QColor(theme.dim))
    below = QRectF(
        card.left(), card.bottom() - (len(CAPTION) + _FOOT_LINES) * line, card.width(), 2 * line
    )
    # The tails of letters may reach below two lines.
    painter.drawText(below, centred | Qt.TextFlag.TextDontClip, "\n".join(CAPTION))


def _paint_arrow(
    painter: QtGui.QPainter,
    middle: QPointF,
    angle: float,
    line: float,
    name: str,
    colour: QtGui.QColor,
) -> None:
    shaft = QLineF.fromPolar(_ARM_LINES * line, angle).translated(middle)
    pen = QtGui.QPen(colour, 0.09 * line)
    pen.setDashPattern([3.0, 2.0])
    painter.setPen(pen)
    painter.drawLine(shaft)
    painter.setPen(QtGui.QPen(colour, 0.09 * line))
    for side in (150.0, -150.0):
        barb = QLineF.fromPolar(0.32 * line, angle + side).translated(shaft.p2())
        painter.drawLine(barb)
    at = QLineF.fromPolar((_ARM_LINES + 0.45) * line, angle).translated(middle).p2()
    area = QRectF(at.x() - line / 2, at.y() - line / 2, line, line)
    painter.drawText(area, Qt.AlignmentFlag.AlignCenter, name)


Rows = tuple[tuple[int, ...], ...]

#: Palmar outputs of the published limbs as they are laid out: rows from the wrist to the elbow,
#: the middle of the arm on the left and its ulnar side on the right.
PALMAR_ROWS: Rows = ((61, 62), (63, 64), (66, 65))
#: What stands over outputs of other limbs that have no place on the map.
NO_PLACE = "No place"
_MOST_ROWS, _FEWEST_COLUMNS = 5, 2

_MARGIN_PX = 10.0
#: The fit that shows the hand without the arm.
HAND = "hand"
#: Room for text above a fitted map, in lines, so that none lies on the skin.
TEXT_LINES = 2.0
# Height of a line of text at which sizes are those written here, px.
_USUAL_LINE_PX = 14.0


def hand_bounds(limb_map: LimbMap) -> QRectF:
    """Return box around the outline from the fingertips to just past the wrist."""
    outline = limb_map.outline
    wrist = outline[:, 1].max() - 1.06 * limb_map.hand_length_px
    box = bounds_of(outline[outline[:, 1] >= wrist])
    box.setTop(max(wrist, outline[:, 1].min()))
    return box


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MapLayout:
    """Screen places of everything on the map.

    Attributes
    ----------
    room
        The screen area.
    frame
        Of the dorsal map.
    points : (n_outputs, 2)
        Of the outputs; the unplaced ones lie in their own group.
    unplaced
        Outputs without a place on the map: the six palmar ones of the published limbs.
    card_title
        What stands over them.
    dot_radius, disc_radius, palmar_radius
        Of a sensor on the interpolated map, of one that carries its colour, of a palmar one.
    palmar_card, triad_card
        Areas of the palmar group, and of the sensors' axes; the latter empty without room.
    unit
        Factor for sizes that follow the text.
    """

    room: QRectF
    frame: Frame
    points: Floats
    unplaced: tuple[int, ...]
    card_title: str
    dot_radius: float
    disc_radius: float
    palmar_radius: float
    palmar_card: QRectF
    triad_card: QRectF
    unit: float


def unplaced_rows(limb_map: LimbMap) -> Rows:
    """Return the outputs without a place on the map, in the rows of their group."""
    unplaced = limb_map.unplaced
    if unplaced == VOLAR_OUTPUTS:
        return PALMAR_ROWS
    columns = max(-(-len(unplaced) // _MOST_ROWS), _FEWEST_COLUMNS)
    return tuple(unplaced[k : k + columns] for k in range(0, len(unplaced), columns))


def palmar_size(rows: Rows, metrics: QtGui.QFontMetricsF) -> QSizeF:
    """Return the size of the group of unplaced outputs; zero where there are none."""
    if not rows:
        return QSizeF(0.0, 0.0)
    line = metrics.height()
    columns = max(map(len, rows))
    width = max(metrics.horizontalAdvance(PALM_SIDE), 1.7 * columns * line) + 0.9 * line
    return QSizeF(width, (1.6 + 1.75 * len(rows)) * line)


def fitted_beside_cards(
    limb_map: LimbMap, bounds: QRectF, room: QRectF, metrics: QtGui.QFontMetricsF
) -> Frame:
    """Return the frame that fits ``bounds`` into ``room`` without the cards in its way."""
    beside, above = _fits(limb_map, bounds, room, metrics)
    return beside if beside.scale >= above.scale else above


def _fits(
    limb_map: LimbMap, bounds: QRectF, room: QRectF, metrics: QtGui.QFontMetricsF
) -> tuple[Frame, Frame]:
    """Return the frame beside a column of cards, and the one above a row of cards."""
    top = max(_MARGIN_PX, TEXT_LINES * metrics.height())
    inner = room.adjusted(_MARGIN_PX, top, -_MARGIN_PX, -_MARGIN_PX)
    palm, triad = _sizes(limb_map, metrics)
    width, height = max(palm.width(), triad.width()), max(palm.height(), triad.height())
    return (
        fitted(bounds, inner.adjusted(0, 0, -width, 0), up=True),
        fitted(bounds, inner.adjusted(0, 0, 0, -height), up=True),
    )


def _cards(
    limb_map: LimbMap, room: QRectF, metrics: QtGui.QFontMetricsF, unit: float
) -> tuple[QRectF, QRectF]:
    """Return areas of palmar group and axes, which stay in the lower right corner."""
    edge = 4 * unit
    palm, triad = _sizes(limb_map, metrics)
    corner = QPointF(room.right() - palm.width() - edge, room.bottom() - palm.height() - edge)
    palm_card = QRectF(corner, palm)
    beside, above = _fits(limb_map, bounds_of(limb_map.outline), room, metrics)
    if beside.scale >= above.scale:
        at = QPointF(room.right() - triad.width() - edge, corner.y() - triad.height() - edge)
    else:
        at = QPointF(corner.x() - triad.width() - edge, room.bottom() - triad.height() - edge)
    triad_card = QRectF(at, triad)
    free = room.adjusted(edge, TEXT_LINES * metrics.height(), 0, 0)
    if triad.isEmpty():
        return palm_card, QRectF()
    return palm_card, triad_card if free.contains(triad_card) else QRectF()


def _sizes(limb_map: LimbMap, metrics: QtGui.QFontMetricsF) -> tuple[QSizeF, QSizeF]:
    palm = palmar_size(unplaced_rows(limb_map), metrics)
    return palm, triad_size(metrics) if limb_map.axes_shown else QSizeF(0.0, 0.0)


def map_layout(
    limb_map: LimbMap, frame: Frame, room: QRectF, metrics: QtGui.QFontMetricsF
) -> MapLayout:
    """Lay the map out in ``room``, with the cards in its lower right corner."""
    line = metrics.height()
    unit = line / _USUAL_LINE_PX
    card, triad_card = _cards(limb_map, room, metrics, unit)
    points = frame.to_screen(limb_map.output_positions)
    rows = unplaced_rows(limb_map)
    for row, numbers in enumerate(rows):
        for column, number in enumerate(numbers):
            aside = 2 * column + 1 - max(map(len, rows))
            points[number - 1] = (
                card.center().x() + aside * 0.95 * line,
                card.top() + (2.1 + 1.75 * row) * line,
            )
    spacing = smallest_spacing(limb_map) * frame.scale
    return MapLayout(
        room=room,
        frame=frame,
        points=points,
        unplaced=limb_map.unplaced,
        card_title=PALM_SIDE if rows == PALMAR_ROWS else NO_PLACE,
        dot_radius=min(max(0.18 * spacing, 1.6 * unit), 3.5 * unit),
        disc_radius=min(max(0.46 * spacing, 3.6 * unit), 12.0 * unit),
        palmar_radius=0.72 * line,
        palmar_card=card,
        triad_card=triad_card,
        unit=unit,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class VisiblePart:
    """A fit, or a part that was zoomed to.

    Attributes
    ----------
    fit
        `WHOLE`, `HAND` or `FREE`.
    middle, size
        Of what is seen, in outline pixels, where the fit is `FREE`.
    """

    fit: str = WHOLE
    middle: tuple[float, float] = (0.0, 0.0)
    size: tuple[float, float] = (0.0, 0.0)

    def frame_in(self, limb_map: LimbMap, room: QRectF, metrics: QtGui.QFontMetricsF) -> Frame:
        """Return the frame that shows the part in ``room``, and what is around it."""
        if self.fit != FREE or 0.0 in self.size:
            hand = self.fit == HAND
            bounds = hand_bounds(limb_map) if hand else bounds_of(limb_map.outline)
            return fitted_beside_cards(limb_map, bounds, room, metrics)
        (x, y), (width, height) = self.middle, self.size
        scale = min(room.width() / width, room.height() / height)
        return Frame(
            scale=scale,
            left=room.center().x() - scale * x,
            top=room.center().y() + scale * y,
            up=True,
        )


#: The whole map.
ALL = VisiblePart()


def visible_part(pan_zoom: PanZoom, room: QRectF) -> VisiblePart:
    """Return which part of the map is visible in ``room``."""
    frame = pan_zoom.frame
    if frame is None or pan_zoom.fit != FREE:
        return VisiblePart(fit=pan_zoom.fit)
    size = room.width() / frame.scale, room.height() / frame.scale
    return VisiblePart(fit=FREE, middle=frame.to_drawing(room.center()), size=size)
