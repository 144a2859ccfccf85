"""Where the parts of the map lie on the screen."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSizeF
from PySide6.QtGui import QFontMetricsF

from skinsource.arrays import Floats
from skinsource.choice_words import PALM_SIDE
from skinsource.limb import VOLAR_OUTPUTS, LimbMap
from skinsource_gui.panels.skin.triad import triad_size
from skinsource_gui.widgets.frame import Frame, fitted

#: Palmar outputs as they are laid out: rows from the wrist to the elbow, the middle of
#: the arm on the left and its ulnar side on the right.
PALMAR_ROWS = ((61, 62), (63, 64), (66, 65))

_MARGIN_PX = 10.0
#: Above a map that is fitted there is a line for words, in lines of text: none lies on the skin.
WORDS_LINES = 2.0
# Height of a line of text at which sizes are as written here, px.
_USUAL_LINE_PX = 14.0


def outline_bounds(limb_map: LimbMap) -> QRectF:
    """Box around the whole outline, in outline pixels; its top is the lowest y."""
    return _box(limb_map.outline)


def hand_bounds(limb_map: LimbMap) -> QRectF:
    """Box around the outline from the fingertips to just past the wrist."""
    outline = limb_map.outline
    wrist = outline[:, 1].max() - 1.06 * limb_map.hand_length_px
    box = _box(outline[outline[:, 1] >= wrist])
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
        Of the outputs; the six palmar ones lie in their own group.
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
    dot_radius: float
    disc_radius: float
    palmar_radius: float
    palmar_card: QRectF
    triad_card: QRectF
    unit: float


def palmar_size(metrics: QFontMetricsF) -> QSizeF:
    """Size of the palmar group."""
    line = metrics.height()
    width = max(metrics.horizontalAdvance(PALM_SIDE), 3.4 * line) + 0.9 * line
    return QSizeF(width, (1.6 + 1.75 * len(PALMAR_ROWS)) * line)


def fitted_beside_cards(bounds: QRectF, room: QRectF, metrics: QFontMetricsF) -> Frame:
    """The frame that fits ``bounds`` into ``room`` without the cards in its way."""
    beside, above = _fits(bounds, room, metrics)
    return beside if beside.scale >= above.scale else above


def _fits(bounds: QRectF, room: QRectF, metrics: QFontMetricsF) -> tuple[Frame, Frame]:
    """The frame beside a column of cards, and the one above a row of them."""
    top = max(_MARGIN_PX, WORDS_LINES * metrics.height())
    inner = room.adjusted(_MARGIN_PX, top, -_MARGIN_PX, -_MARGIN_PX)
    palm, triad = palmar_size(metrics), triad_size(metrics)
    width, height = max(palm.width(), triad.width()), max(palm.height(), triad.height())
    return (
        fitted(bounds, inner.adjusted(0, 0, -width, 0), up=True),
        fitted(bounds, inner.adjusted(0, 0, 0, -height), up=True),
    )


def _cards(
    limb_map: LimbMap, room: QRectF, metrics: QFontMetricsF, unit: float
) -> tuple[QRectF, QRectF]:
    """Areas of palmar group and axes: in the lower right corner, where they stay while zooming."""
    edge = 4 * unit
    palm, triad = palmar_size(metrics), triad_size(metrics)
    corner = QPointF(room.right() - palm.width() - edge, room.bottom() - palm.height() - edge)
    palm_card = QRectF(corner, palm)
    beside, above = _fits(outline_bounds(limb_map), room, metrics)
    if beside.scale >= above.scale:
        at = QPointF(room.right() - triad.width() - edge, corner.y() - triad.height() - edge)
    else:
        at = QPointF(corner.x() - triad.width() - edge, room.bottom() - triad.height() - edge)
    triad_card = QRectF(at, triad)
    free = room.adjusted(edge, WORDS_LINES * metrics.height(), 0, 0)
    return palm_card, triad_card if free.contains(triad_card) else QRectF()


def map_layout(limb_map: LimbMap, frame: Frame, room: QRectF, metrics: QFontMetricsF) -> MapLayout:
    """Lay the map out in ``room``, with the cards in its lower right corner."""
    line = metrics.height()
    unit = line / _USUAL_LINE_PX
    card, triad_card = _cards(limb_map, room, metrics, unit)
    points = frame.to_screen(limb_map.output_positions)
    for row, numbers in enumerate(PALMAR_ROWS):
        for side, number in zip((-1, 1), numbers, strict=True):
            points[number - 1] = (
                card.center().x() + side * 0.95 * line,
                card.top() + (2.1 + 1.75 * row) * line,
            )
    spacing = smallest_spacing(limb_map.output_positions) * frame.scale
    return MapLayout(
        room=room,
        frame=frame,
        points=points,
        dot_radius=min(max(0.18 * spacing, 1.6 * unit), 3.5 * unit),
        disc_radius=min(max(0.46 * spacing, 3.6 * unit), 12.0 * unit),
        palmar_radius=0.72 * line,
        palmar_card=card,
        triad_card=triad_card,
        unit=unit,
    )


def smallest_spacing(positions: Floats) -> float:
    """Smallest distance between two dorsal outputs, in outline pixels."""
    dorsal = np.array(
        [place for k, place in enumerate(positions, start=1) if k not in VOLAR_OUTPUTS]
    )
    apart = np.linalg.norm(dorsal[:, None] - dorsal[None], axis=-1)
    return float(apart[apart > 0].min())


def _box(points: Floats) -> QRectF:
    (x0, y0), (x1, y1) = points.min(axis=0), points.max(axis=0)
    return QRectF(float(x0), float(y0), float(x1 - x0), float(y1 - y0))
