"""The skin map as a picture for a page or a slide, and its content at no particular time."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from PySide6 import QtGui
from PySide6.QtCore import QRectF, QSizeF, Qt

from skinsource.base.decibels import FLOOR_DB
from skinsource.base.quoting import sentence
from skinsource.design.design import Design
from skinsource.design.labels import limb_label, signal_label
from skinsource.design.view import View
from skinsource.limbs.limb import LimbMap
from skinsource.limbs.own_limbs import facts_of
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource.perception.sensation import LIMITS
from skinsource.signals.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource_gui.panels.skin.layout import ALL, MapLayout, VisiblePart, map_layout
from skinsource_gui.panels.skin.map import paint_map_texts
from skinsource_gui.panels.skin.painting import MapContent, MapPainter, small_font
from skinsource_gui.panels.skin.scale import paint_colour_scale
from skinsource_gui.panels.skin.settings import LEVELS, SENSATION, STILL, MapQuantity, SkinSettings
from skinsource_gui.plots.colour_maps import colour_table
from skinsource_gui.plots.small_map import FieldImage, px_per_mm_of
from skinsource_gui.qt.frames import UncachedPicture
from skinsource_gui.qt.theme import Theme, tabular
from skinsource_gui.state.compared import SILENT

#: What strokes over a map mean.
HATCHED = f"hatched: less than {LEAST_ABOVE_NOISE_DB:g} dB above the noise"
# Lines of text in the height of the picture, also of one that is wide; the limits of a line, px.
_LINES, _WIDE_LINES = 48, 32
_SMALLEST_FONT_PX, _LARGEST_FONT_PX = 9, 64
# Share of the height for each part of a heading; where it needs more, its font shrinks.
_HEADING_LINE = 0.06
# Size of the details, as a share of the font of the title.
_DETAILS = 0.8
_WRAPPED = Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop | Qt.TextFlag.TextWordWrap


@dataclass(frozen=True, slots=True, kw_only=True)
class Heading:
    """Title, details and note above a map."""

    title: str
    details: str
    note: str = ""


def heading_of(design: Design | None, view: View, quantity: MapQuantity | None = None) -> Heading:
    """Return the heading of a picture of the map; of levels unless ``quantity`` is given."""
    quantity = quantity or MapQuantity(span=view.span)
    limb = facts_of("" if design is None else design.limb)
    parts = [quantity.details_on(limb.axes) or signal_label(view.axes, view.method)]
    if design is not None:
        band_hz = limb.band_hz
        if quantity.name == SENSATION and band_hz is not None:
            parts.append(f"{band_hz[0]:g} to {band_hz[1]:g} Hz")
        parts = [limb_label(design.limb).title, *parts]
    return Heading(title=quantity.heading, details=" · ".join(parts))


def paint_picture(
    painter: QtGui.QPainter,
    size: QSizeF,
    content: MapContent,
    heading: Heading,
    theme: Theme,
    family: str,
    visible: VisiblePart = ALL,
) -> None:
    """Draw the map with heading, colour bar and, where due, the synthetic mark.

    Parameters
    ----------
    painter
        Of an image, a page or a drawing.
    size
        Of the picture, px.
    content, heading
        What the map shows, and how it is called.
    theme, family
        Colours, and the family of the font.
    seen
        What part of the map; all of it unless given.
    """
    if content.hatched:
        heading = replace(heading, details=f"{heading.details} · {HATCHED}")
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    page = QRectF(0, 0, size.width(), size.height())
    painter.fillRect(page, QtGui.QColor(theme.base))
    font = QtGui.QFont(family)
    # The map is narrow: in a wide picture, as on a slide, text has more room.
    lines = _LINES if page.width() <= page.height() else _WIDE_LINES
    pixels = min(page.height() / lines, page.width() / _LINES * 1.6)
    font.setPixelSize(round(min(max(pixels, _SMALLEST_FONT_PX), _LARGEST_FONT_PX)))
    font = tabular(font)
    line = QtGui.QFontMetricsF(font).height()
    inner = page.adjusted(line, 0.6 * line, -line, -line)
    inner.setTop(_paint_heading(painter, inner, heading, font, theme) + 0.4 * line)
    room = inner.adjusted(0, 0, -6.2 * line, 0)
    painter.setFont(small_font(font))
    layout = None
    if content.limb_map is not None:
        layout = _paint_map(painter, content, content.limb_map, room, theme, visible)
    ramp = QRectF(room.right() + line, room.top() + line, line, room.height() - 2 * line)
    levels = content.value_range
    painter.setFont(small_font(font))
    table = colour_table(content.colours)
    paint_colour_scale(painter, ramp, levels, levels, table, theme, content.quantity)
    painter.setFont(font)
    paint_map_texts(painter, content, layout, room, theme)


def heading_font(font: QtGui.QFont, text: str, area: QRectF) -> QtGui.QFont:
    """Return a copy of ``font``, shrunk until the wrapped ``text`` fits into ``area``."""
    copy = QtGui.QFont(font)
    while copy.pixelSize() > 1:
        needed = QtGui.QFontMetricsF(copy).boundingRect(QRectF(area), int(_WRAPPED), text)
        if needed.width() <= area.width() and needed.height() <= area.height():
            break
        copy.setPixelSize(copy.pixelSize() - 1)
    return copy


def _paint_heading(
    painter: QtGui.QPainter, inner: QRectF, heading: Heading, font: QtGui.QFont, theme: Theme
) -> float:
    """Draw title, details and note; return where they end."""
    title_font = QtGui.QFont(font)
    title_font.setBold(True)
    top = inner.top()
    for text, usual, colour in (
        (heading.title, title_font, theme.text),
        (heading.details, small_font(font, _DETAILS), theme.dim),
        (heading.note, small_font(font, _DETAILS), theme.warning),
    ):
        if not text:
            continue
        area = QRectF(inner.left(), top, inner.width(), _HEADING_LINE * inner.height())
        painter.setFont(heading_font(usual, text, area))
        painter.setPen(QtGui.QColor(colour))
        painter.drawText(area, int(_WRAPPED), text)
        metrics = QtGui.QFontMetricsF(painter.font())
        top += metrics.boundingRect(area, int(_WRAPPED), text).height() + 0.15 * metrics.height()
    return top


def _paint_map(
    painter: QtGui.QPainter,
    content: MapContent,
    limb_map: LimbMap,
    room: QRectF,
    theme: Theme,
    visible: VisiblePart,
) -> MapLayout:
    metrics = QtGui.QFontMetricsF(painter.font())
    frame = visible.frame_in(limb_map, room, metrics)
    layout = map_layout(limb_map, frame, room, metrics)
    map_painter = MapPainter(limb_map, UncachedPicture)
    painter.save()
    # Magnified, the map would lie on heading and scale.
    painter.setClipRect(room, Qt.ClipOperation.IntersectClip)
    map_painter.paint(painter, content, layout, theme)
    painter.restore()
    return layout


#: By quantity: names of the results at the outputs and over the skin.
_NAMES = {
    LEVELS: ("output_levels_db", "surface_levels_db"),
    SENSATION: ("sensation_db", "surface_sensation_db"),
}


def needs_of(quantity: str) -> frozenset[str]:
    """Return the results that are needed at the outputs."""
    more = {"sensation"} if quantity == SENSATION else set()
    return frozenset({_NAMES[quantity][0]} | more)


def surface_name(quantity: str) -> str:
    """Return the result that is needed over the skin."""
    return _NAMES[quantity][1]


def content_of(
    before: MapContent,
    results: Mapping[str, Any],
    settings: SkinSettings,
    *,
    limb: str,
    surface: SurfaceOperator | None,
    field: FieldImage | None,
) -> MapContent:
    """Return the content of the map with results, before design, view and playhead are known.

    Parameters
    ----------
    before
        What the map showed; what does not follow from results is taken over.
    results, settings
        Quantities by name, computed for these settings.
    limb
        Name of the limb.
    surface, field
        The interpolated map and its image; None: sensors carry the colours.
    """
    limb_data, shown = results["limb_data"], settings.quantity
    limits = LIMITS if shown == SENSATION else ""
    drawn_note = " ".join(filter(None, (limits, *(() if surface is None else surface.warnings))))
    source = sentence(f"{limb_data.note[:1].upper()}{limb_data.note[1:]}") if limb_data.note else ""
    content = replace(
        before,
        limb_map=results["limb_map"],
        limb=limb,
        px_per_mm=px_per_mm_of(limb_data),
        field=field,
        note=" ".join(filter(None, (drawn_note, source))),
        drawn_note=drawn_note,
    )
    if shown not in STILL:
        return content
    at_outputs, over_skin = _NAMES[shown]
    values = results[at_outputs]
    if not values.size:
        problem = results["sensation"].problem
        return replace(content, values=None, field_values=None, message=problem)
    return replace(
        content,
        values=values,
        field_values=None if surface is None else results[over_skin],
        message=SILENT if float(np.max(values)) <= FLOOR_DB else "",
    )
