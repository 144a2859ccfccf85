"""Where the hand and its sites lie in a widget of a given size."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QTransform

from skinsource_gui.panels.hand.hand_drawing import HandDrawing
from skinsource_gui.panels.hand.site_marker import least_radius_px
from skinsource_gui.widgets.frame import Frame

#: Radius of a site in outline pixels; on the screen it is neither smaller nor larger than these.
_SITE_PX, _LEAST_PX, _LARGEST_PX = 17.0, 11.0, 26.0
# In a crowd it takes this share of the way to the nearest other one, but stays to be seen.
_OF_SPACING, _CROWDED_PX = 0.44, 2.5
# Room beside and above the hand for the markers off its fingertips, in radii.
_SIDE_RADII, _TOP_RADII = 1.6, 2.9
#: An in-axis marker is this far off its fingertip, in radii.
_OFF_TIP_RADII = 1.32
# A click may miss a site by this factor of its radius; a drag snaps from farther, so that between
# neighbouring sites there is no gap in which it would be cancelled.
_HIT_RADII, _SNAP_RADII, _SNAP_OUTLINE_PX = 1.25, 2.6, 45.0
#: No click must be nearer than this to a site, however small it is drawn, px.
_HIT_PX = 9.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HandLayout:
    """The hand in a widget.

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

    transform: QTransform
    radii_px: NDArray[np.float64]
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

    def radius_px(self, site: int) -> float:
        """Radius of the circle of ``site``."""
        return float(self.radii_px[site - 1])

    def radius_in_use_px(self, site: int) -> float:
        """The same of a site that is in use, or pointed at: large enough for its number."""
        return max(self.radius_px(site), least_radius_px(site))

    def push(self, site: int) -> QPointF | None:
        """Direction in which an in-axis contact pushes; ``None`` for a perpendicular one."""
        x, y = self.pushes[site - 1]
        return QPointF(float(x), float(y)) if x or y else None

    def marker_area(self, site: int) -> QRectF:
        """Square around the marker of ``site``."""
        half = QPointF(1.0, 1.0) * self.radius_px(site)
        return QRectF(self.centre(site) - half, self.centre(site) + half)

    def site_at(self, position: QPointF) -> int | None:
        """Site under the mouse."""
        return self._nearest(position, np.maximum(_HIT_RADII * self.radii_px, _HIT_PX))

    def site_to_snap_to(self, position: QPointF) -> int | None:
        """Site that takes what is dropped at ``position``."""
        own, drawn = _SNAP_RADII * self.radii_px, _SNAP_OUTLINE_PX * self.transform.m11()
        return self._nearest(position, np.maximum(own, drawn))

    def neighbour(self, site: int, direction: tuple[int, int]) -> int:
        """The nearest site in ``direction`` (x right, y down); ``site`` where there is none."""
        x, y = (self.centres - self.centres[site - 1]).T
        along = x * direction[0] + y * direction[1]
        across = np.abs(x * direction[1] - y * direction[0])
        ahead = (along > 1.0) & (across < 2.0 * along)
        if not ahead.any():
            return site
        return int(np.argmin(np.where(ahead, along + 2.0 * across, np.inf))) + 1

    def _nearest(self, position: QPointF, reach_px: NDArray[np.float64]) -> int | None:
        distances = np.hypot(*(self.centres - (position.x(), position.y())).T)
        nearest = int(np.argmin(distances))
        return nearest + 1 if distances[nearest] <= reach_px[nearest] else None


def fitted_hand(drawing: HandDrawing, area: QRectF) -> Frame:
    """The frame that fits the hand and the markers off its fingertips into ``area``."""
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
    """Lay out the sites of a hand that lies in ``frame``."""
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
