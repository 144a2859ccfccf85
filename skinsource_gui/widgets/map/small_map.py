"""Maps so small that they have no words: in lists, on cards."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPen, QPolygonF

from skinsource.base.arrays import Floats
from skinsource.design.design import Design, audible_indices
from skinsource.limbs.limb import LimbMap
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource.signals.map_range import map_range_db
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.frame import Frame, fitted
from skinsource_gui.widgets.map.colour_maps import colour_table, level_colours
from skinsource_gui.widgets.map.field_image import FieldImage, field_image
from skinsource_gui.widgets.map.noise_strokes import paint_strokes

_RING_PX, _DISC_PX = 3.0, 2.5
# As far around an output as on the large map, in the smallest spacings of outputs.
_NOISE_SPACINGS = 1.38

Range = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SmallMap:
    """What a small map shows.

    Attributes
    ----------
    limb_map
        Outline and places.
    levels_db : (n_outputs,) or None
        Level of each output; None: no colours.
    field, field_levels_db
        Interpolated map and its levels, (rows, columns); None: outputs carry the colours.
    noisy
        Outputs that are mostly noise: their surroundings are hatched.
    """

    limb_map: LimbMap
    levels_db: Floats | None = None
    field: FieldImage | None = None
    field_levels_db: Floats | None = None
    noisy: tuple[int, ...] = ()

    @property
    def range_db(self) -> Range:
        """Levels of the lowest and the highest colour, if nothing else is said."""
        return map_range_db(() if self.levels_db is None else self.levels_db)


class SmallMaps:
    """Makes small maps of results; the pixels of one surface are made once."""

    def __init__(self) -> None:
        self._surface: SurfaceOperator | None = None
        self._field: FieldImage | None = None

    def map_of(self, results: Mapping[str, Any]) -> SmallMap:
        """The map of ``results``, which hold ``limb_map``; the more they hold, the more it shows.

        Parameters
        ----------
        results
            Quantities by name, such as ``output_levels_db``, ``surface`` and
            ``surface_levels_db`` with ``limb_data``.
        """
        surface = results.get("surface")
        levels = results.get("surface_levels_db")
        if surface is None or levels is None or "limb_data" not in results:
            return SmallMap(limb_map=results["limb_map"], levels_db=results.get("output_levels_db"))
        if surface is not self._surface:
            self._surface, self._field = surface, field_image(surface, results["limb_data"])
        return SmallMap(
            limb_map=results["limb_map"],
            levels_db=results.get("output_levels_db"),
            field=self._field,
            field_levels_db=levels,
        )


def paint_small_map(
    painter: QPainter,
    area: QRectF,
    shown: SmallMap,
    design: Design | None,
    theme: Theme,
    range_db: Range | None = None,
    table: NDArray[np.uint32] | None = None,
) -> None:
    """Draw a map into ``area``, with rings where the inputs of ``design`` are.

    Parameters
    ----------
    painter, area
        Where; nothing is drawn outside.
    shown
        The map.
    design
        Its inputs are marked; None: none are.
    theme
        Colours of skin and inputs.
    range_db, table
        Levels of the lowest and highest colour, and the colours; as usual unless given.
    """
    limb_map = shown.limb_map
    frame = small_frame(limb_map, area)
    outline = QPainterPath()
    outline.addPolygon(QPolygonF([QPointF(x, y) for x, y in frame.to_screen(limb_map.outline)]))
    outline.closeSubpath()
    painter.save()
    painter.setRenderHints(
        QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform
    )
    painter.fillPath(outline, QColor(theme.skin))
    _paint_levels(painter, frame, outline, shown, range_db or shown.range_db, table)
    if shown.noisy:
        _paint_noise(painter, frame, outline, shown)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(QColor(theme.skin_line), 1))
    painter.drawPath(outline)
    if design is not None:
        _paint_inputs(painter, frame, limb_map, design, theme)
    painter.restore()


def small_frame(limb_map: LimbMap, area: QRectF) -> Frame:
    """Where `paint_small_map` draws a map."""
    return fitted(_bounds(limb_map.outline), area, up=True)


def _paint_levels(
    painter: QPainter,
    frame: Frame,
    outline: QPainterPath,
    shown: SmallMap,
    range_db: Range,
    table: NDArray[np.uint32] | None,
) -> None:
    colours = colour_table() if table is None else table
    if shown.field is not None and shown.field_levels_db is not None:
        painter.save()
        painter.setClipPath(outline)
        # The picture's first line is the highest y: it is drawn downwards from there.
        place = frame.transform().mapRect(shown.field.rect)
        painter.drawImage(place, shown.field.image(shown.field_levels_db, range_db, colours))
        painter.restore()
    elif shown.levels_db is not None:
        painter.setPen(Qt.PenStyle.NoPen)
        places = frame.to_screen(shown.limb_map.output_positions)
        fills = level_colours(shown.levels_db, range_db, colours)
        for place, fill in zip(places, fills, strict=True):
            if np.isfinite(place).all():
                painter.setBrush(fill)
                painter.drawEllipse(QPointF(*place), _DISC_PX, _DISC_PX)


def spacing_px(limb_map: LimbMap, frame: Frame) -> float:
    """Smallest distance between two outputs on a small map; 0: there are no two."""
    places = frame.to_screen(limb_map.output_positions)
    places = places[np.isfinite(places).all(axis=1)]
    apart = np.linalg.norm(places[:, None] - places[None], axis=-1)
    return float(apart[apart > 0].min(initial=np.inf)) if apart.any() else 0.0


def _paint_noise(painter: QPainter, frame: Frame, outline: QPainterPath, shown: SmallMap) -> None:
    places = frame.to_screen(shown.limb_map.output_positions)
    noisy = [QPointF(*places[number - 1]) for number in shown.noisy if number <= len(places)]
    placed = [one for one in noisy if np.isfinite((one.x(), one.y())).all()]
    reach = max(_NOISE_SPACINGS * spacing_px(shown.limb_map, frame), _DISC_PX)
    paint_strokes(painter, placed, reach, outline)


def _paint_inputs(
    painter: QPainter, frame: Frame, limb_map: LimbMap, design: Design, theme: Theme
) -> None:
    heard = set(audible_indices(design.inputs))
    places = frame.to_screen(limb_map.input_positions)
    for index, one in enumerate(design.inputs):
        if index in heard and one.location <= len(places):
            centre = QPointF(*places[one.location - 1])
            if not np.isfinite((centre.x(), centre.y())).all():
                continue  # it has no place on the map
            painter.setPen(QPen(QColor(theme.base), 3.0))
            painter.drawEllipse(centre, _RING_PX, _RING_PX)
            painter.setPen(QPen(theme.input_colour(one.colour), 1.5))
            painter.drawEllipse(centre, _RING_PX, _RING_PX)


def _bounds(outline: Floats) -> QRectF:
    (x0, y0), (x1, y1) = outline.min(axis=0), outline.max(axis=0)
    return QRectF(float(x0), float(y0), float(x1 - x0), float(y1 - y0))
