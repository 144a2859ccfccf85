"""Where the parts of the skin map lie on the screen."""

from dataclasses import dataclass

from PySide6 import QtGui
from PySide6.QtCore import QPointF, QRectF, QSizeF

from skinsource.base.conventions import VOLAR_OUTPUTS, Floats
from skinsource.design.labels import PALM_SIDE
from skinsource.limbs.limb import LimbMap
from skinsource_gui.plots.small_map import bounds_of, hand_bounds, outline_of, smallest_spacing
from skinsource_gui.qt.frames import Frame, fitted
from skinsource_gui.qt.wheel import FREE, WHOLE, PanZoom

Rows = tuple[tuple[int, ...], ...]

#: Palmar outputs of the published limbs as they are laid out: rows from the wrist to the elbow,
#: the middle of the arm on the left and its ulnar side on the right.
PALMAR_ROWS: Rows = ((61, 62), (63, 64), (66, 65))
#: What stands over outputs of other limbs that have no place on the map.
NO_PLACE = "No place"
_MOST_ROWS, _FEWEST_COLUMNS = 5, 2
# Distance of their discs, in lines of text: each takes a click within half of it.
_PITCH_LINES = 2.0

_MARGIN_PX = 3.0
#: The fit that shows the hand without the arm.
HAND = "hand"
#: Room for text above a fitted map, in lines, so that none lies on the skin.
TEXT_LINES = 1.5
# Height of a line of text at which sizes are those written here, px.
_USUAL_LINE_PX = 14.0


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
    palmar_card
        Area of the palmar group; empty where there is none.
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
    width = max(metrics.horizontalAdvance(PALM_SIDE), _PITCH_LINES * columns * line) + 0.6 * line
    return QSizeF(width, (1.6 + _PITCH_LINES * len(rows)) * line)


# Shares of the size of the group of unplaced outputs by which a fitted map makes room for it.
_MAKES_WAY = (0.0, 0.25, 0.5, 0.75, 1.0)


def fitted_beside_card(
    limb_map: LimbMap, bounds: QRectF, room: QRectF, metrics: QtGui.QFontMetricsF
) -> Frame:
    """Return the largest frame that fits ``bounds`` into ``room`` and leaves the card free."""
    top = max(_MARGIN_PX, TEXT_LINES * metrics.height())
    inner = room.adjusted(_MARGIN_PX, top, -_MARGIN_PX, -_MARGIN_PX)
    card = palmar_card(limb_map, room, metrics)
    outline = outline_of(limb_map)
    rooms = [
        inner.adjusted(0, 0, -share * card.width() * across, -share * card.height() * (not across))
        for share in _MAKES_WAY
        for across in (True, False)
    ]
    frames = sorted(
        (fitted(bounds, part, up=True) for part in rooms), key=lambda frame: -frame.scale
    )
    free = (frame for frame in frames if not frame.transform().map(outline).intersects(card))
    return next(free, frames[-1])


def palmar_card(limb_map: LimbMap, room: QRectF, metrics: QtGui.QFontMetricsF) -> QRectF:
    """Return the area of the unplaced outputs in the lower right corner; empty without any."""
    size = palmar_size(unplaced_rows(limb_map), metrics)
    edge = 4 * metrics.height() / _USUAL_LINE_PX
    return QRectF(
        QPointF(room.right() - size.width() - edge, room.bottom() - size.height() - edge), size
    )


def map_layout(
    limb_map: LimbMap, frame: Frame, room: QRectF, metrics: QtGui.QFontMetricsF
) -> MapLayout:
    """Lay the map out in ``room``, with the unplaced outputs in its lower right corner."""
    line = metrics.height()
    unit = line / _USUAL_LINE_PX
    card = palmar_card(limb_map, room, metrics)
    points = frame.to_screen(limb_map.output_positions)
    rows = unplaced_rows(limb_map)
    for row, numbers in enumerate(rows):
        for column, number in enumerate(numbers):
            aside = 2 * column + 1 - max(map(len, rows))
            points[number - 1] = (
                card.center().x() + aside * _PITCH_LINES / 2.0 * line,
                card.top() + (2.2 + _PITCH_LINES * row) * line,
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
            # On paper nothing can be moved: the outputs of the wrist are within.
            bounds = hand_bounds(limb_map, 1.13) if hand else bounds_of(limb_map.outline)
            return fitted_beside_card(limb_map, bounds, room, metrics)
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
