"""The drawing of each limb's hand."""

from functools import lru_cache

import numpy as np
from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainterPath

from skinsource.arrays import Floats
from skinsource.limb import LimbFacts, LimbMap
from skinsource.own_limbs import facts_of, own_map
from skinsource.synthetic import standard_hand
from skinsource_gui.panels.hand.hand_drawing import HandDrawing, palmar_drawing, polygon

# Outline pixels in one hand length, as in the project's own hand.
_HAND_PX = 400.0
# How much is seen around the outermost sites, in hand lengths.
_AROUND = 0.22
# Sites of a crowded hand take this much of the way to the nearest one.
_OF_SPACING = 0.44
_LEAST_PX, _USUAL_PX = 5.0, 17.0
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
    sites = palmar(limb_map.input_positions)
    placed = sites[np.isfinite(sites[:, 0])]
    side = "Left" if facts.left else "Right"
    mirrored = "\nmirrored," if facts.mirrored else ""
    bounds = _bounds(palmar(limb_map.outline), placed)
    below = float(palmar(limb_map.outline)[:, 1].max()) - bounds.bottom()
    return HandDrawing(
        outline=outline,
        creases=QPainterPath(),
        bounds=bounds,
        sites=np.where(np.isfinite(sites), sites, 0.0),
        pushes=np.zeros_like(sites),
        limb=facts.name,
        side=f"{side} hand,{mirrored}\npalm side",
        site_px=_radius(placed),
        least_px=_LEAST_PX,
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


def _radius(sites: Floats) -> float:
    """So that neighbours do not cover each other."""
    apart = np.linalg.norm(sites[:, None] - sites[None], axis=-1)
    nearest = float(apart[apart > 0].min(initial=np.inf))
    return float(np.clip(_OF_SPACING * nearest, _LEAST_PX, _USUAL_PX))
