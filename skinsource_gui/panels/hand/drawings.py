"""The drawing of each limb's hand."""

from functools import lru_cache

import numpy as np
from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainterPath

from skinsource.base.arrays import Floats
from skinsource.limbs.limb import LimbFacts, LimbMap
from skinsource.limbs.own_limbs import facts_of, own_map
from skinsource.limbs.synthetic import standard_hand
from skinsource_gui.panels.hand.hand_drawing import HandDrawing, palmar_drawing, polygon

# Outline pixels in one hand length, as in the project's own hand.
_HAND_PX = 400.0
# How much is seen around the outermost sites, in hand lengths.
_AROUND = 0.22
# Places that are one point lie around it, this far off; those that lie nowhere, in columns beside
# the hand, this far from each other.
_AROUND_POINT_PX, _BESIDE_PX = 6.0, 40.0
_FADE_PX = 40.0


def drawing_of(limb: str) -> HandDrawing:
    """The hand of a limb, by its name; of one that is not known, the project's own."""
    found = own_map(limb)
    return _standard() if found is None else _own(found, facts_of(limb))


@lru_cache(maxsize=1)
def _standard() -> HandDrawing:
    return palmar_drawing(standard_hand())


@lru_cache(maxsize=8)
def _own(limb_map: LimbMap, facts: LimbFacts) -> HandDrawing:
    """Outline and places as the lab gave them, seen from the palm."""
    scale = _HAND_PX / limb_map.hand_length_px

    def palmar(points: Floats) -> Floats:
        # Seen from the palm left and right change places; on screen y points down.
        return -scale * points

    outline = QPainterPath()
    outline.addPolygon(polygon(palmar(limb_map.outline)))
    outline.closeSubpath()
    sites = _told_apart(palmar(limb_map.input_positions))
    side = "Left" if facts.left else "Right"
    mirrored = "\nmirrored," if facts.mirrored else ""
    bounds = _bounds(palmar(limb_map.outline), sites[np.isfinite(sites[:, 0])])
    left = float(palmar(limb_map.outline)[:, 0].min())
    sites, bounds = _with_those_beside(sites, bounds, left)
    below = float(palmar(limb_map.outline)[:, 1].max()) - bounds.bottom()
    return HandDrawing(
        outline=outline,
        creases=QPainterPath(),
        bounds=bounds,
        sites=sites,
        pushes=np.zeros_like(sites),
        limb=facts.name,
        side=f"{side} hand,{mirrored}\npalm side",
        spacing=_spacing(sites),
        contacts=False,
        # Where a long arm goes on it fades, as the project's own.
        fade=(bounds.bottom() - _FADE_PX, bounds.bottom()) if below > 1.0 else None,
    )


def _bounds(outline: Floats, sites: Floats) -> QRectF:
    """What is seen: the sites and the hand around them, of a long arm not the rest."""
    shown = sites if len(sites) else outline
    around = _AROUND * _HAND_PX
    low = np.maximum(outline.min(axis=0), shown.min(axis=0) - around)
    high = np.minimum(outline.max(axis=0), shown.max(axis=0) + around)
    width, height = np.maximum(high - low, 1.0)
    return QRectF(float(low[0]), float(low[1]), float(width), float(height))


def _with_those_beside(sites: Floats, bounds: QRectF, left: float) -> tuple[Floats, QRectF]:
    """Sites that lie nowhere, beside a hand that begins at ``left``; and what is seen then."""
    nowhere = np.flatnonzero(np.isnan(sites[:, 0]))
    if not nowhere.size:
        return sites, bounds
    in_column = max(int(bounds.height() / _BESIDE_PX), 1)
    column, row = np.divmod(np.arange(nowhere.size), in_column)
    all_sites = sites.copy()
    all_sites[nowhere, 0] = left - _BESIDE_PX * (0.5 + column)
    all_sites[nowhere, 1] = bounds.top() + _BESIDE_PX * (0.5 + row)
    seen = QRectF(bounds)
    seen.setLeft(left - _BESIDE_PX * (column.max() + 1.0))
    return all_sites, seen


def _told_apart(sites: Floats) -> Floats:
    """Sites that are one point, as contacts of two kinds may be, moved off it to lie around it."""
    _, group, count = np.unique(sites, axis=0, return_inverse=True, return_counts=True)
    apart = sites.copy()
    for shared in np.flatnonzero(count > 1):
        members = np.flatnonzero(group == shared)
        angles = 2.0 * np.pi * np.arange(members.size) / members.size
        apart[members] += _AROUND_POINT_PX * np.column_stack((np.cos(angles), np.sin(angles)))
    return apart


def _spacing(sites: Floats) -> Floats:
    """From each site to the nearest other one, (n_sites,)."""
    apart = np.linalg.norm(sites[:, None] - sites[None], axis=-1)
    np.fill_diagonal(apart, np.inf)
    return apart.min(axis=1, initial=np.inf)
