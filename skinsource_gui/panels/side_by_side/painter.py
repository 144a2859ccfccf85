"""Draws maps side by side, what is selected and pointed at in all of them, and their scales."""

from collections.abc import Sequence

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QFont, QPainter

from skinsource_gui.panels.side_by_side.content import Cell, Content
from skinsource_gui.panels.side_by_side.headings import bold, paint_heading, places_for
from skinsource_gui.panels.side_by_side.layout import CellPlace, Places
from skinsource_gui.panels.side_by_side.seen_maps import SeenMaps
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.figure.shrunk import shrunk
from skinsource_gui.widgets.map.colour_maps import colour_table
from skinsource_gui.widgets.map.length_bar import paint_small_bar
from skinsource_gui.widgets.map.output_rings import paint_rings
from skinsource_gui.widgets.map.scale_row import paint_scale_row
from skinsource_gui.widgets.map.small_map import paint_small_map

_CENTRE = Qt.AlignmentFlag.AlignCenter
_PALE, _BAND_ALPHA = 0.5, 0.15


def paint_view(
    painter: QPainter,
    seen: SeenMaps,
    theme: Theme,
    pointed_at: int | None,
    *,
    outdated: bool,
    band: QRectF | None,
) -> None:
    """Draw what a widget shows; the painter's font is that of all words.

    Parameters
    ----------
    painter, seen, theme, pointed_at
        As for `paint_content`.
    outdated
        Whether it belongs to an older design.
    band
        What is dragged around outputs, if anything.
    """
    content, places = seen.content, seen.places
    if outdated:
        painter.setPen(QColor(theme.dim))
        painter.drawText(places.head, Qt.AlignmentFlag.AlignVCenter, "Computing…")
    if any(cell.synthetic for cell in content.cells):
        painter.setPen(QColor(theme.warning))
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        painter.drawText(places.head, right, "SYNTHETIC")
    painter.setOpacity(_PALE if outdated else 1.0)
    paint_content(painter, content, places, theme, pointed_at)
    painter.setOpacity(1.0)
    if band is not None:
        fill = QColor(theme.accent)
        painter.setPen(fill)
        fill.setAlphaF(_BAND_ALPHA)
        painter.setBrush(fill)
        painter.drawRect(band)


def paint_content(
    painter: QPainter,
    content: Content,
    places: Places,
    theme: Theme,
    pointed_at: int | None = None,
) -> None:
    """Draw ``content``; the painter's font is that of all words.

    Parameters
    ----------
    painter, places, theme
        On what, where, in which colours.
    content
        What is shown.
    pointed_at
        Number of the output that is marked in every map; None: none is.
    """
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    common = content.common_scale
    for cell, place in zip(content.cells, places.cells, strict=True):
        _paint_cell(painter, cell, place, content, theme, pointed_at)
        if common is None and cell.scale is not None:
            paint_scale_row(painter, place.scale, cell.scale, theme)
    if common is not None:
        paint_scale_row(painter, places.scale, common, theme)


def paint_page(painter: QPainter, content: Content, room: QRectF, theme: Theme) -> None:
    """Draw ``content`` into ``room``, with a line that says of what it is."""
    painter.setPen(QColor(theme.text))
    line = painter.fontMetrics().height()
    if content.message or not content.cells:
        painter.drawText(room, _CENTRE, content.message)
        return
    synthetic = any(cell.synthetic for cell in content.cells)
    words = f"{content.about} · SYNTHETIC" if synthetic else content.about
    painter.drawText(QRectF(0, 0, room.width(), 1.5 * line), _CENTRE, words)
    below = room.adjusted(0, 1.5 * line, 0, 0)
    paint_content(painter, content, places_for(below, content, painter.font()), theme)


def _paint_cell(
    painter: QPainter,
    cell: Cell,
    place: CellPlace,
    content: Content,
    theme: Theme,
    pointed_at: int | None,
) -> None:
    plain = QFont(painter.font())
    painter.setFont(bold(plain))
    painter.setPen(QColor(theme.text))
    paint_heading(painter, cell.headings, place.heading)
    painter.setFont(plain)
    if cell.small is None or cell.scale is None:
        painter.setPen(QColor(theme.dim))
        flags = _CENTRE | Qt.TextFlag.TextWordWrap
        words = cell.words or "Computing…"
        painter.setFont(shrunk(plain, words.split(), place.map.width()))
        painter.drawText(place.map, flags, words)
        painter.setFont(plain)
        return
    painter.setPen(QColor(theme.text if pointed_at is not None else theme.dim))
    values, width = cell.value_texts(pointed_at), place.value.width()
    painter.setFont(shrunk(plain, values[-1:], width - 0.5 * painter.fontMetrics().height()))
    painter.drawText(place.value, _CENTRE, fitting(painter, values, width))
    painter.setFont(plain)
    table = colour_table(cell.scale.colours)
    paint_small_map(painter, place.map, cell.small, cell.design, theme, cell.scale.range_db, table)
    paint_rings(painter, cell.small, place.map, content.outputs, theme, pointed_at)
    paint_small_bar(painter, place.map, cell.small, cell.limb, theme)


def fitting(painter: QPainter, wordings: Sequence[str], width: float) -> str:
    """The first of some wordings, each shorter than the one before, for which there is room."""
    metrics = painter.fontMetrics()
    width -= 0.5 * metrics.height()
    fits = (words for words in wordings if metrics.horizontalAdvance(words) <= width)
    shortest = metrics.elidedText(wordings[-1], Qt.TextElideMode.ElideRight, int(width))
    return next(fits, shortest)
