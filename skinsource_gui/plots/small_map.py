"""Small maps of a limb in the colours of levels, with rings, numbers and scales."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from math import ceil, floor, inf
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt

from skinsource.base.conventions import Floats
from skinsource.base.decibels import FLOOR_DB
from skinsource.design.design import Design, View, audible_indices
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.limbs.limb import Limb, LimbMap
from skinsource.limbs.own_limbs import facts_of
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource.signals.map_range import MAP_RANGE_DB, map_range_db
from skinsource.specs import fields
from skinsource.specs.numbers import RangeSpec
from skinsource_gui.fields.units import minus
from skinsource_gui.plots.colour_maps import VIRIDIS, colour_indices, colour_table, level_colours
from skinsource_gui.plots.curves import fitting
from skinsource_gui.plots.outputs import is_placed
from skinsource_gui.qt.frames import Frame, closed_path, fitted
from skinsource_gui.qt.layouts import show_tooltip
from skinsource_gui.qt.resources import choice_of
from skinsource_gui.qt.theme import Theme, is_on_paper, scaled, translucent

Range = tuple[float, float]

_DARK, _LIGHT = QtGui.QColor(0, 0, 0, 150), QtGui.QColor(255, 255, 255, 150)


def paint_strokes(
    painter: QtGui.QPainter, places: Sequence[QPointF], reach_px: float, outline: QtGui.QPainterPath
) -> None:
    """Hatch the surroundings of places inside an outline, visibly on any colour."""
    area = around(places, reach_px)
    painter.save()
    painter.setClipPath(outline, Qt.ClipOperation.IntersectClip)
    painter.fillPath(area, QtGui.QBrush(_LIGHT, Qt.BrushStyle.BDiagPattern))
    painter.setBrushOrigin(1, 0)
    painter.fillPath(area, QtGui.QBrush(_DARK, Qt.BrushStyle.BDiagPattern))
    painter.restore()


def paint_dark_strokes(painter: QtGui.QPainter, places: Sequence[QPointF], reach_px: float) -> None:
    """Hatch discs."""
    painter.fillPath(around(places, reach_px), QtGui.QBrush(_DARK, Qt.BrushStyle.BDiagPattern))


def around(places: Sequence[QPointF], reach_px: float) -> QtGui.QPainterPath:
    """Return the union of discs around places."""
    area = QtGui.QPainterPath()
    area.setFillRule(Qt.FillRule.WindingFill)
    for place in places:
        area.addEllipse(place, reach_px, reach_px)
    return area


# The image continues this many pixels outside the mask, in the colours of the rim, so that smooth
# scaling never meets an empty pixel inside the outline.
_COLLAR = 2
# Neighbours that share an edge come before those that share a corner.
_NEIGHBOURS = ((0, 1), (0, -1), (1, 0), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1))


class FieldImage:
    """Image of one surface operator for a vector outline to clip, coloured for each set of levels.

    Parameters
    ----------
    mask : (rows, columns) of bool
        Pixels inside the outline; rows increase with y.
    x_mm, y_mm : (columns,) and (rows,)
        Centres of the pixels.
    px_per_mm
        Outline pixels per millimetre.

    Attributes
    ----------
    rect
        Area of the image, in outline pixels; its top is the lowest y.
    """

    def __init__(
        self, mask: NDArray[np.bool_], x_mm: Floats, y_mm: Floats, px_per_mm: float
    ) -> None:
        self._shape = mask.shape
        self._step_mm = float(x_mm[1] - x_mm[0]), float(y_mm[1] - y_mm[0])
        self._origin_mm = float(x_mm[0]), float(y_mm[0])
        self._px_per_mm = px_per_mm
        source = _inside_pixels(mask)[::-1]
        self._targets = np.flatnonzero(source >= 0)
        self._sources = source.ravel()[self._targets]
        rows, columns = self._size = source.shape
        (dx, dy), (x0, y0) = self._step_mm, self._origin_mm
        self.rect = QRectF(
            (x0 - (_COLLAR + 0.5) * dx) * px_per_mm,
            (y0 - (_COLLAR + 0.5) * dy) * px_per_mm,
            columns * dx * px_per_mm,
            rows * dy * px_per_mm,
        )

    def paint(
        self,
        painter: QtGui.QPainter,
        frame: Frame,
        room: QRectF,
        levels_db: Floats,
        range_db: Range,
        table: NDArray[np.uint32],
    ) -> None:
        """Draw levels, (rows, columns); only the lines in ``room`` are coloured."""
        # The first line of the image is the highest y: it is drawn downwards from there.
        area, (rows, columns) = frame.transform().mapRect(self.rect), self._size
        line_px = area.height() / rows
        # Smooth scaling takes in the lines beside those in sight.
        first = min(max(floor((room.top() - area.top()) / line_px) - 1, 0), rows - 1)
        end = min(max(ceil((room.bottom() - area.top()) / line_px) + 1, first + 1), rows)
        area.setTop(area.top() + first * line_px)
        area.setHeight((end - first) * line_px)
        inside = slice(*np.searchsorted(self._targets, (first * columns, end * columns)))
        pixels = np.zeros((end - first) * columns, np.uint32)
        pixels[self._targets[inside] - first * columns] = table.take(
            colour_indices(levels_db.ravel().take(self._sources[inside]), range_db)
        )
        depth = QtGui.QImage.Format.Format_ARGB32_Premultiplied
        image = QtGui.QImage(pixels.data, columns, end - first, 4 * columns, depth)
        painter.drawImage(area, image)

    def level_at(self, levels_db: Floats, x_px: float, y_px: float) -> float | None:
        """Return the level of the pixel at a place of the outline, dB; None outside."""
        column = round((x_px / self._px_per_mm - self._origin_mm[0]) / self._step_mm[0])
        row = round((y_px / self._px_per_mm - self._origin_mm[1]) / self._step_mm[1])
        rows, columns = self._shape
        if not (0 <= row < rows and 0 <= column < columns):
            return None
        level = float(levels_db[row, column])
        return level if np.isfinite(level) else None


@lru_cache(maxsize=4)
def field_image(surface: SurfaceOperator, limb: Limb) -> FieldImage:
    """Return the image of the surface of ``limb``; it is made once."""
    return FieldImage(surface.mask, surface.x_mm, surface.y_mm, px_per_mm_of(limb))


def px_per_mm_of(limb: Limb) -> float:
    """Return the number of outline pixels in a millimetre."""
    return limb.map.hand_length_px / limb.hand_length_mm


def _inside_pixels(mask: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Return, for each pixel with the collar, the index of the pixel that colours it; -1: none."""
    own_pixels = np.where(mask, np.arange(mask.size).reshape(mask.shape), -1)
    source = np.pad(own_pixels, _COLLAR, constant_values=-1)
    for _ in range(_COLLAR):
        grown = source.copy()
        for step in _NEIGHBOURS:
            neighbour = np.roll(source, step, axis=(0, 1))
            reached = (grown < 0) & (neighbour >= 0)
            grown[reached] = neighbour[reached]
        source = grown
    return source


_RING_PX, _DISC_PX = 3.0, 2.5
# Radius of the noise around an output, in the smallest spacing of outputs, as on the large map.
_NOISE_SPACINGS = 1.38


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SmallMap:
    """Content of a small map.

    Attributes
    ----------
    levels_db : (n_outputs,) or None
        Level of each output; None: no colours.
    field, field_levels_db
        Interpolated map and its levels, (rows, columns); None: outputs have the colours.
    noisy
        Outputs that are mostly noise: their surroundings are hatched.
    hand_only
        Whether the arm is left out.
    """

    limb_map: LimbMap
    levels_db: Floats | None = None
    field: FieldImage | None = None
    field_levels_db: Floats | None = None
    noisy: tuple[int, ...] = ()
    hand_only: bool = False

    @property
    def bounds(self) -> QRectF:
        """The box around what is drawn, in outline pixels; its top is the lowest y."""
        if not self.hand_only:
            return bounds_of(self.limb_map.outline)
        hand = hand_bounds(self.limb_map)
        # With the first outputs of the wrist.
        return hand.adjusted(0.0, -0.1 * hand.height(), 0.0, 0.0)

    @property
    def range_db(self) -> Range:
        """Levels of the lowest and the highest colour, unless others are chosen."""
        return map_range_db(() if self.levels_db is None else self.levels_db)


def small_map_of(results: Mapping[str, Any]) -> SmallMap:
    """Return the map of ``results``; only ``limb_map`` is required.

    Parameters
    ----------
    results
        Quantities by name, such as ``output_levels_db``, ``surface`` and
        ``surface_levels_db`` with ``limb_data``.
    """
    surface = results.get("surface")
    levels = results.get("surface_levels_db")
    plain = SmallMap(limb_map=results["limb_map"], levels_db=results.get("output_levels_db"))
    if surface is None or levels is None or "limb_data" not in results:
        return plain
    field = field_image(surface, results["limb_data"])
    return replace(plain, field=field, field_levels_db=levels)


@lru_cache(maxsize=8)
def outline_of(limb_map: LimbMap) -> QtGui.QPainterPath:
    """Return the outline of a limb, in outline pixels."""
    return closed_path(limb_map.outline)


def paint_small_map(
    painter: QtGui.QPainter,
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
        Nothing is drawn outside of the area, but half of the outline.
    shown
        The map.
    design
        Its inputs are marked; None: none are.
    theme
        Colours of skin and inputs.
    range_db, table
        Levels of the lowest and highest colour, and the colours; the usual ones unless given.
    """
    limb_map, frame = shown.limb_map, small_frame(shown, area)
    outline = frame.transform().map(outline_of(limb_map))
    painter.save()
    painter.setClipRect(area.adjusted(-2, -2, 2, 2), Qt.ClipOperation.IntersectClip)
    painter.setRenderHints(
        QtGui.QPainter.RenderHint.Antialiasing | QtGui.QPainter.RenderHint.SmoothPixmapTransform
    )
    painter.fillPath(outline, QtGui.QColor(theme.skin))
    _paint_levels(painter, area, frame, outline, shown, range_db or shown.range_db, table)
    if shown.noisy:
        _paint_noise(painter, frame, outline, shown)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.skin_line), 1))
    painter.drawPath(outline)
    if design is not None:
        _paint_inputs(painter, frame, limb_map, design, theme)
    painter.restore()


#: A map is at least so high, px.
LEAST_MAP_PX = 64.0
# Height of a map over its width: hand and arm.
_HIGH = 2.3


def map_grid(
    room: QRectF, n: int, around_px: float, *, most_px: float = inf, most_cell_px: float = inf
) -> tuple[QRectF, ...]:
    """Return the cells of ``n`` maps, in the fewest rows in which maps are largest.

    Parameters
    ----------
    room
        Area of all cells.
    around_px
        Height of a cell beside that of its map.
    most_px, most_cell_px
        Largest width of a map that counts, and of a cell; narrow cells stand in the middle.
    """
    if n == 0:
        return ()

    def map_width(rows: int) -> float:
        width = min(room.width() / ceil(n / rows), (room.height() / rows - around_px) / _HIGH)
        return min(width, most_px) - 1e-6 * rows if width > 0.0 else -float(rows)

    rows = max(range(1, n + 1), key=map_width)
    columns = ceil(n / rows)
    width, height = min(room.width() / columns, most_cell_px), room.height() / rows
    left = room.left() + (room.width() - width * columns) / 2.0
    return tuple(
        QRectF(left + width * (k % columns), room.top() + height * (k // columns), width, height)
        for k in range(n)
    )


def small_frame(shown: SmallMap, area: QRectF) -> Frame:
    """Return the frame in which `paint_small_map` draws a map."""
    return fitted(shown.bounds, area, up=True)


def _paint_levels(
    painter: QtGui.QPainter,
    area: QRectF,
    frame: Frame,
    outline: QtGui.QPainterPath,
    shown: SmallMap,
    range_db: Range,
    table: NDArray[np.uint32] | None,
) -> None:
    colours = colour_table() if table is None else table
    if shown.field is not None and shown.field_levels_db is not None:
        painter.save()
        painter.setClipPath(outline, Qt.ClipOperation.IntersectClip)
        shown.field.paint(painter, frame, area, shown.field_levels_db, range_db, colours)
        painter.restore()
    elif shown.levels_db is not None:
        painter.setPen(Qt.PenStyle.NoPen)
        places = frame.to_screen(shown.limb_map.output_positions)
        fills = level_colours(shown.levels_db, range_db, colours)
        for place, fill in zip(places, fills, strict=True):
            if np.isfinite(place).all():
                painter.setBrush(fill)
                painter.drawEllipse(QPointF(*place), _DISC_PX, _DISC_PX)


@lru_cache(maxsize=8)
def smallest_spacing(limb_map: LimbMap) -> float:
    """Return the smallest distance between outputs, in outline pixels; 0 for a single one."""
    places = limb_map.output_positions
    places = places[np.isfinite(places).all(axis=1)]
    distances = np.linalg.norm(places[:, None] - places[None], axis=-1)
    return float(distances[distances > 0].min(initial=np.inf)) if distances.any() else 0.0


def _paint_noise(
    painter: QtGui.QPainter, frame: Frame, outline: QtGui.QPainterPath, shown: SmallMap
) -> None:
    places = frame.to_screen(shown.limb_map.output_positions)
    placed = [QPointF(*places[number - 1]) for number in shown.noisy if is_placed(places, number)]
    reach = max(_NOISE_SPACINGS * smallest_spacing(shown.limb_map) * frame.scale, _DISC_PX)
    paint_strokes(painter, placed, reach, outline)


def _paint_inputs(
    painter: QtGui.QPainter, frame: Frame, limb_map: LimbMap, design: Design, theme: Theme
) -> None:
    audible = set(audible_indices(design.inputs))
    places = frame.to_screen(limb_map.input_positions)
    for index, track in enumerate(design.inputs):
        if index in audible and is_placed(places, track.location):
            centre = QPointF(*places[track.location - 1])
            pen = QtGui.QPen(theme.input_colour(track.colour), 1.5)
            paint_ring(painter, centre, _RING_PX, pen, theme)


def paint_ring(
    painter: QtGui.QPainter, centre: QPointF, radius: float, pen: QtGui.QPen, theme: Theme
) -> None:
    """Draw a ring on a wider one in the colour of the background, to be visible on any colour."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for drawn in (QtGui.QPen(QtGui.QColor(theme.base), 2.0 * pen.widthF()), pen):
        painter.setPen(drawn)
        painter.drawEllipse(centre, radius, radius)


def paint_band(painter: QtGui.QPainter, band: QRectF, theme: Theme) -> None:
    """Draw a rubber band."""
    fill = QtGui.QColor(theme.accent)
    painter.setPen(QtGui.QPen(fill, 1))
    fill.setAlphaF(0.15)
    painter.setBrush(fill)
    painter.drawRect(band)


def bounds_of(points: Floats) -> QRectF:
    """Return the box around points, in outline pixels; its top is the lowest y."""
    (x0, y0), (x1, y1) = points.min(axis=0), points.max(axis=0)
    return QRectF(float(x0), float(y0), float(x1 - x0), float(y1 - y0))


def hand_bounds(limb_map: LimbMap, lengths: float = 1.01) -> QRectF:
    """Return box around the outline from the fingertips to so many lengths of the hand below."""
    outline = limb_map.outline
    wrist = outline[:, 1].max() - lengths * limb_map.hand_length_px
    box = bounds_of(outline[outline[:, 1] >= wrist])
    box.setTop(max(wrist, outline[:, 1].min()))
    return box


def offer_arm(button: QtWidgets.QAbstractButton, limb_maps: Sequence[LimbMap], hint: str) -> None:
    """Enable what shows the arm where some of a limb lies below its hand; else say why not."""
    has_arm = not limb_maps or any(
        hand_bounds(limb_map).height() < bounds_of(limb_map.outline).height()
        for limb_map in limb_maps
    )
    button.setEnabled(has_arm)
    show_tooltip(button, hint if has_arm else "This limb has no arm")


#: Shown where the user has fixed the range of colours.
FIXED_MARK = "range fixed"
MAP_RANGE = RangeSpec(label="Range", unit="dB")
COLOURS = choice_of("colours_of_maps")

# The panel whose settings hold the colours and the range.
_PANEL = "skin"


@dataclass(frozen=True, slots=True, kw_only=True)
class LevelStyle(fields.CheckedModel):
    """How maps of levels look, whichever panel shows them.

    Attributes
    ----------
    map_range_db
        Levels of the ends of the colour bar, dB re 1 m/s²; None: each map follows its content
        (`skinsource.signals.map_range.map_range_db`).
    colours
        Colour map of levels.
    """

    map_range_db: Range | None = fields.interval(None, MAP_RANGE)
    colours: str = fields.choice(VIRIDIS, COLOURS)


#: The look unless the user chooses another one.
USUAL_STYLE = LevelStyle()


def level_style(view: View) -> LevelStyle:
    """Return the look of all maps of levels."""
    return settings_of(view, _PANEL, LevelStyle)


def with_colours_of(view: View, other: View) -> View:
    """Return ``view`` with the colours of ``other``, unless it has colours of its own."""
    look, colours = level_style(view), level_style(other).colours
    if look.colours != USUAL_STYLE.colours or look.colours == colours:
        return view
    return with_settings(view, _PANEL, replace(look, colours=colours))


_LENGTHS_MM = (100, 50, 20, 10, 5, 2, 1)
# A scale bar takes at most this part of the width.
_MOST = 0.25
# Size of its text on small maps, in usual sizes.
_BAR_TEXT = 0.8


def bar_length_mm(px_per_mm: float, width_px: float) -> int:
    """Return the longest round length that fits, mm."""
    fitting = (length for length in _LENGTHS_MM if length * px_per_mm <= _MOST * width_px)
    return next(fitting, _LENGTHS_MM[-1])


def paint_small_bar(
    painter: QtGui.QPainter, area: QRectF, shown: SmallMap, limb: str, theme: Theme
) -> None:
    """Draw the scale bar of a small map, only on paper, into the lower right corner of ``area``.

    Nothing is drawn where the length of the hand of ``limb`` is not known.
    """
    length_mm = facts_of(limb).hand_length_mm
    if not is_on_paper() or length_mm <= 0.0:
        return
    limb_map = shown.limb_map
    px_per_mm = small_frame(shown, area).scale * limb_map.hand_length_px / length_mm
    bar_mm = bar_length_mm(px_per_mm, area.width())
    text, plain = f"{bar_mm} mm", painter.font()
    painter.setFont(scaled(plain, _BAR_TEXT))
    metrics = QtGui.QFontMetricsF(painter.font())
    width, text_width = bar_mm * px_per_mm, metrics.horizontalAdvance(text)
    middle = area.right() - max(width, text_width) / 2 - 2.0
    bottom = area.bottom() - 2.0
    above = QRectF(middle - text_width / 2 - 1.0, 0.0, text_width + 2.0, metrics.height())
    above.moveBottom(bottom - 1.0)
    # The text has to be readable on the arm, too.
    ground = translucent(theme.base, 224)
    painter.fillRect(above, ground)
    pen = QtGui.QPen(QtGui.QColor(theme.text), 2.0)
    pen.setCapStyle(Qt.PenCapStyle.FlatCap)
    painter.setPen(pen)
    painter.drawLine(QLineF(middle - width / 2, bottom, middle + width / 2, bottom))
    painter.drawText(above, Qt.AlignmentFlag.AlignCenter, text)
    painter.setFont(plain)


# Radius of the ring of a selected output, and of the output under the pointer.
_OUTPUT_RING_PX, _WIDE_PX = 4.0, 7.0
_FEW_RINGS = 12


def ring_size(n: int, spacing_px: float) -> tuple[float, float]:
    """Return radius and width of ``n`` rings, px; many rings are small."""
    if n <= _FEW_RINGS:
        return _OUTPUT_RING_PX, 2.0
    return min(max(0.3 * spacing_px, 1.5), _OUTPUT_RING_PX), 1.0


def paint_rings(
    painter: QtGui.QPainter,
    small: SmallMap,
    area: QRectF,
    outputs: tuple[int, ...],
    theme: Theme,
    pointed_at: int | None = None,
) -> None:
    """Draw rings around selected outputs, in the colours of their curves, and ``pointed_at``."""
    limb_map, frame = small.limb_map, small_frame(small, area)
    points = frame.to_screen(limb_map.output_positions)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    radius, width = ring_size(len(outputs), smallest_spacing(limb_map) * frame.scale)
    rings = [(number, theme.output_pen(rank, width), radius) for rank, number in enumerate(outputs)]
    if pointed_at is not None:
        rings.append((pointed_at, QtGui.QPen(QtGui.QColor(theme.text), 1.5), _WIDE_PX))
    for number, pen, radius in rings:
        # Those of the arm lie below the hand.
        if is_placed(points, number) and points[number - 1, 1] <= area.bottom():
            paint_ring(painter, QPointF(*points[number - 1]), radius, pen, theme)


def tick_text(
    value: float, range_db: Range, reached_db: Range | None, *, signed: bool = False
) -> str:
    """Return the text of a tick; "≤ −20" or "≥ +20" where values beyond have the same colour.

    Parameters
    ----------
    value
        Value at the tick.
    range_db
        Values of the lowest and the highest colour.
    reached_db
        The smallest and the largest value of the map; None: all lie within the range.
    signed
        Whether positive numbers have a sign.
    """
    text = minus(f"{value:+.4g}" if signed and value != 0.0 else f"{value:.4g}")
    if reached_db is None:
        return text
    if value <= range_db[0] and reached_db[0] < range_db[0]:
        return f"≤ {text}"
    if value >= range_db[1] and reached_db[1] > range_db[1]:
        return f"≥ {text}"
    return text


#: Text for the level of silence.
SILENT = "silent"
_LEVELS = "dB re 1 m/s²"
_OF_OWN = (-MAP_RANGE_DB, 0.0)
_RAMP_PX, _ABOVE_PX, _GAP_PX = 9.0, 2.0, 3.0
_CENTRE = Qt.AlignmentFlag.AlignCenter
# Numbers of ticks: of levels, of differences with zero in the middle, and of narrow scales.
_TICKS, _SIGNED_TICKS, _FEW_TICKS = 6, 5, 3


@dataclass(frozen=True, slots=True, kw_only=True)
class ColourScale:
    """A scale of colours.

    Attributes
    ----------
    range_db
        Values of the lowest and the highest colour.
    words
        Unit, and what the values are.
    colours
        Name of the colour map.
    signed
        Whether positive values have a sign.
    reached_db
        The smallest and the largest value; those beyond the range have the colour of its end.
        None: all lie within.
    unit
        Unit of values beside which none is written.
    shorter
        Texts in place of ``text_below`` where it has no room, the longest first.
    """

    range_db: Range
    text_below: str
    colours: str = VIRIDIS
    signed: bool = False
    reached_db: Range | None = None
    unit: str = "dB"
    shorter: tuple[str, ...] = ()

    def text(self, value_db: float) -> str:
        """Return ``"−12.3 dB"``; differences have a sign."""
        if self.unit != "dB":
            return minus(
                f"{value_db:+.3g} {self.unit}" if self.signed else f"{value_db:.3g} {self.unit}"
            )
        if not self.signed and value_db <= FLOOR_DB:
            return SILENT
        return minus(f"{value_db:+z.1f} dB" if self.signed else f"{value_db:z.1f} dB")


def scale_of_levels(levels_db: Floats, look: LevelStyle) -> ColourScale:
    """Return the scale of RMS levels; its text tells where the user has fixed the range."""
    fixed = look.map_range_db
    return ColourScale(
        range_db=fixed or map_range_db(levels_db),
        text_below=f"{_LEVELS} · {FIXED_MARK}" if fixed else _LEVELS,
        colours=look.colours,
        reached_db=(fixed[0], float(np.max(levels_db, initial=FLOOR_DB))) if fixed else None,
    )


def scale_of_own(look: LevelStyle) -> ColourScale:
    """Return the scale of RMS levels relative to the loudest output of each map."""
    return ColourScale(
        range_db=_OF_OWN, text_below="dB re each map's maximum", colours=look.colours
    )


def with_matched(scale: ColourScale, matched: str) -> ColourScale:
    """Return the scale with a text that tells how much louder or softer than stored values are."""
    return replace(scale, text_below=f"{scale.text_below}, {matched}") if matched else scale


def scale_row_px(line_px: float, *, low: bool = False) -> float:
    """Return the height of `paint_scale_row` for lines of text of this height.

    ``low``: its text stands beside it.
    """
    return _ABOVE_PX + _RAMP_PX + (1.0 if low else 2.0) * line_px


def paint_scale_row(
    painter: QtGui.QPainter, area: QRectF, scale: ColourScale, theme: Theme
) -> None:
    """Draw the colours in the middle of ``area``, with numbers, and a text below or beside them."""
    line = painter.fontMetrics().height()
    width = max(min(area.width() - 4.0 * line, 20.0 * line), 4.0 * line)
    low = area.height() < scale_row_px(line) - line / 2.0
    texts, metrics = (scale.text_below, *scale.shorter), QtGui.QFontMetricsF(painter.font())
    text = fitting(texts, metrics, area.width() - (10.0 * line if low else 0.0)) or texts[-1]
    text_px = metrics.horizontalAdvance(text) if low else 0.0
    width = max(min(width, area.width() - text_px - 6.0 * line), 4.0 * line)
    left = area.center().x() - (width + text_px) / 2.0
    ramp = QRectF(left, area.top() + _ABOVE_PX, width, _RAMP_PX)
    paint_ramp(painter, ramp, scale, theme)
    painter.setPen(QtGui.QColor(theme.dim))
    below = QRectF(area.left(), ramp.bottom() + line, area.width(), line)
    beside = QRectF(ramp.right() + 3.0 * line, area.top(), area.width(), area.height())
    centred = Qt.AlignmentFlag.AlignVCenter if low else _CENTRE
    painter.drawText(beside if low else below, centred, text)


def paint_ramp(painter: QtGui.QPainter, ramp: QRectF, scale: ColourScale, theme: Theme) -> None:
    """Draw the colours into ``ramp``, and numbers below it."""
    line = painter.fontMetrics().height()
    row = np.ascontiguousarray(colour_table(scale.colours))
    image = QtGui.QImage(row.data, len(row), 1, 4 * len(row), QtGui.QImage.Format.Format_RGB32)
    painter.drawImage(ramp, image)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.border), 1))
    painter.drawRect(ramp)
    low, high = scale.range_db
    painter.setPen(QtGui.QColor(theme.text))
    n_ticks = _SIGNED_TICKS if scale.signed else _TICKS
    if ramp.width() < 3.0 * line * n_ticks:
        n_ticks = _FEW_TICKS
    ends = (
        tick_text(end, (low, high), scale.reached_db, signed=scale.signed) for end in (low, high)
    )
    widest = max(map(painter.fontMetrics().horizontalAdvance, ends))
    # Fewer where they would run into each other: both ends, or none.
    n_ticks = next((n for n in (n_ticks, 2) if (n - 1) * (widest + _GAP_PX) <= ramp.width()), 0)
    for value in np.linspace(low, high, n_ticks):
        x = ramp.left() + (value - low) / (high - low) * ramp.width()
        text_area = QRectF(x - 3.0 * line, ramp.bottom(), 6.0 * line, line)
        number = tick_text(value, scale.range_db, scale.reached_db, signed=scale.signed)
        painter.drawText(text_area, _CENTRE, number)
