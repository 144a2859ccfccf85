"""Where the parts of the map lie on the screen."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, QSizeF
from PySide6.QtGui import QFontMetricsF

from skinsource.limb import VOLAR_OUTPUTS, LimbMap
from skinsource_gui.widgets.frame import Frame, fitted

Floats = NDArray[np.float64]

#: Palmar outputs as they are laid out: rows from the wrist to the elbow, the middle of
#: the arm on the left and its ulnar side on the right.
PALMAR_ROWS = ((61, 62), (63, 64), (66, 65))
PALMAR_TITLE = "Palmar side"

_MARGIN_PX = 10.0
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
    points : (72, 2)
        Of the outputs; the six palmar ones lie in their own group.
    dot_radius, disc_radius, palmar_radius
        Of a sensor on the interpolated map, of one that carries its colour, of a palmar one.
    palmar_card
        Area of the palmar group.
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
    unit: float


def palmar_size(metrics: QFontMetricsF) -> QSizeF:
    """Size of the palmar group."""
    line = metrics.height()
    width = max(metrics.horizontalAdvance(PALMAR_TITLE), 3.4 * line) + 0.9 * line
    return QSizeF(width, (1.6 + 1.75 * len(PALMAR_ROWS)) * line)


def fitted_beside_palmar(bounds: QRectF, room: QRectF, metrics: QFontMetricsF) -> Frame:
    """The frame that fits ``bounds`` into ``room`` without the palmar group in its way."""
    inner = room.adjusted(_MARGIN_PX, _MARGIN_PX, -_MARGIN_PX, -_MARGIN_PX)
    card = palmar_size(metrics)
    beside = fitted(bounds, inner.adjusted(0, 0, -card.width(), 0), up=True)
    above = fitted(bounds, inner.adjusted(0, 0, 0, -card.height()), up=True)
    return beside if beside.scale >= above.scale else above


def map_layout(limb_map: LimbMap, frame: Frame, room: QRectF, metrics: QFontMetricsF) -> MapLayout:
    """Lay the map out in ``room``, with the palmar group in its lower right corner."""
    line = metrics.height()
    unit = line / _USUAL_LINE_PX
    size = palmar_size(metrics)
    corner = QPointF(
        room.right() - size.width() - 4 * unit, room.bottom() - size.height() - 4 * unit
    )
    card = QRectF(corner, size)
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
