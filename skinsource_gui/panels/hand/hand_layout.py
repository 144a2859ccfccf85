"""Where the hand and its sites lie in a widget of a given size."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QTransform

from skinsource_gui.panels.hand.hand_drawing import HandDrawing
from skinsource_gui.widgets.frame import Frame

#: Largest radius of a site, px.
_LARGEST_PX = 26.0
# Room beside and above the hand for the markers off its fingertips, in radii.
_SIDE_RADII, _TOP_RADII = 1.6, 2.9
#: An in-axis marker is this far off its fingertip, in radii.
_OFF_TIP_RADII = 1.32
# A click may miss a site by this factor of its radius; a drag snaps from farther, so that between
# neighbouring sites there is no gap in which it would be cancelled.
_HIT_RADII, _SNAP_RADII, _SNAP_OUTLINE_PX = 1.25, 2.6, 45.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HandLayout:
    """The hand in a widget.

    Attributes
    ----------
    transform
        From the drawing's outline pixels to the widget's pixels.
    radius_px
        Of a site's circle.
    centres : (n_sites, 2)
        Of the sites' markers, in widget pixels.
    pushes : (n_sites, 2)
        As in `HandDrawing`.
    """

    transform: QTransform
    radius_px: float
    centres: NDArray[np.float64]
    pushes: NDArray[np.float64]

    @property
    def n_sites(self) -> int:
        """How many there are."""
        return len(self.centres)

    def has(self, site: int) -> bool:
        """Whether ``site`` is on this hand."""
        return 1 <= site <= self.n_sites

    def centre(self, site: int) -> QPointF:
        """Middle of the marker of ``site``, which must be on this hand."""
        x, y = self.centres[site - 1]
        return QPointF(float(x), float(y))

    def push(self, site: int) -> QPointF | None:
        """Direction in which an in-axis contact pushes; ``None`` for a perpendicular one."""
        x, y = self.pushes[site - 1]
        return QPointF(float(x), float(y)) if x or y else None

    def marker_area(self, site: int) -> QRectF:
        """Square around the marker of ``site``."""
        half = QPointF(1.0, 1.0) * self.radius_px
        return QRectF(self.centre(site) - half, self.centre(site) + half)

    def site_at(self, position: QPointF) -> int | None:
        """Site under the mouse."""
        return self._nearest(position, _HIT_RADII * self.radius_px)

    def site_to_snap_to(self, position: QPointF) -> int | None:
        """Site that takes what is dropped at ``position``."""
        own, drawn = _SNAP_RADII * self.radius_px, _SNAP_OUTLINE_PX * self.transform.m11()
        return self._nearest(position, max(own, drawn))

    def neighbour(self, site: int, direction: tuple[int, int]) -> int:
        """The nearest site in ``direction`` (x right, y down); ``site`` where there is none."""
        x, y = (self.centres - self.centres[site - 1]).T
        along = x * direction[0] + y * direction[1]
        across = np.abs(x * direction[1] - y * direction[0])
        ahead = (along > 1.0) & (across < 2.0 * along)
        if not ahead.any():
            return site
        return int(np.argmin(np.where(ahead, along + 2.0 * across, np.inf))) + 1

    def _nearest(self, position: QPointF, reach_px: float) -> int | None:
        distances = np.hypot(*(self.centres - (position.x(), position.y())).T)
        nearest = int(np.argmin(distances))
        return nearest + 1 if distances[nearest] <= reach_px else None


def fitted_hand(drawing: HandDrawing, area: QRectF) -> Frame:
    """The frame that fits the hand and the markers off its fingertips into ``area``."""
    radius = drawing.least_px
    for _ in range(2):  # The room for markers depends on the scale and the scale on the room.
        width = area.width() - 2 * _SIDE_RADII * radius
        height = area.height() - _TOP_RADII * radius
        scale = max(
            min(width / drawing.bounds.width(), height / drawing.bounds.height()),
            0.1,
        )
        radius = _radius_px(drawing, scale)
    spare = area.height() - _TOP_RADII * radius - scale * drawing.bounds.height()
    return Frame(
        scale=scale,
        left=area.center().x() - scale * drawing.bounds.center().x(),
        top=area.top() + _TOP_RADII * radius + spare / 2 - scale * drawing.bounds.top(),
    )


def hand_layout(drawing: HandDrawing, frame: Frame) -> HandLayout:
    """Lay out the sites of a hand that lies in ``frame``."""
    radius = _radius_px(drawing, frame.scale)
    return HandLayout(
        transform=frame.transform(),
        radius_px=radius,
        centres=frame.to_screen(drawing.sites) - drawing.pushes * radius * _OFF_TIP_RADII,
        pushes=drawing.pushes,
    )


def _radius_px(drawing: HandDrawing, scale: float) -> float:
    # No hit area is narrower than the smallest one.
    return float(np.clip(drawing.site_px * scale, drawing.least_px, _LARGEST_PX))
