"""Draws the dorsal map."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetricsF,
    QImage,
    QPainter,
    QPainterPath,
    QPen,
    QPolygonF,
)

from skinsource.limb import VOLAR_OUTPUTS, LimbMap
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.colour_maps import is_light, level_colours
from skinsource_gui.widgets.map_content import MapContent
from skinsource_gui.widgets.map_layout import PALMAR_TITLE, MapLayout
from skinsource_gui.widgets.output_labels import output_labels, square
from skinsource_gui.widgets.output_picking import DORSAL_OUTPUTS

_HINTS = QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform


class MapPainter:
    """Draws maps, and keeps what stays the same from one frame to the next.

    Parameters
    ----------
    limb_map
        Outline and places.
    table
        Colours, see `colour_table`.
    """

    def __init__(self, limb_map: LimbMap, table: NDArray[np.uint32]) -> None:
        self._outline = QPainterPath()
        self._outline.addPolygon(QPolygonF([QPointF(x, y) for x, y in limb_map.outline]))
        self._outline.closeSubpath()
        self._table = table
        self._layout: MapLayout | None = None
        self._screen_outline = QPainterPath()
        self._kept: dict[str, tuple[tuple[object, ...], QImage]] = {}

    def paint(
        self, painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        """Draw ``content``; the painter's font is that of labels."""
        if layout is not self._layout:
            self._layout = layout
            self._screen_outline = layout.frame.transform().map(self._outline)
            self._kept = {}
        painter.setRenderHints(_HINTS)
        self._paint_field(painter, content, layout, theme)
        self._paint_marks(painter, content, layout, theme)
        if content.shown_field is None:
            self._paint_discs(painter, content, layout, theme)
        self._paint_palmar(painter, content, layout, theme)
        self._paint_selection(painter, content, layout, theme)

    def _paint_field(
        self, painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        field, levels = content.shown_field, content.field_levels_db
        if field is None or levels is None:
            painter.fillPath(self._screen_outline, QColor(theme.skin))
            return
        painter.save()
        painter.setClipPath(self._screen_outline)
        # The picture's first line is the highest y: it is drawn downwards from there.
        area = layout.frame.transform().mapRect(field.rect)
        image = field.image(levels, content.range_db, self._table)
        painter.translate(area.topLeft())
        painter.scale(area.width() / image.width(), area.height() / image.height())
        painter.drawImage(QPointF(0, 0), image)
        painter.restore()

    def _paint_marks(
        self, painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        """Outline and sensor dots."""
        dots = content.sensors_shown and content.shown_field is not None

        def paint(on_image: QPainter) -> None:
            line = QPen(QColor(theme.skin_line), 1.25 * layout.unit)
            on_image.strokePath(self._screen_outline, line)
            if dots:
                _paint_dots(on_image, layout)

        self._paint_kept(painter, "marks", (theme.name, dots), paint)

    def _paint_selection(
        self, painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        """Rings in the colours of the curves, and numbers."""
        if not content.outputs:
            return

        def paint(on_image: QPainter) -> None:
            _paint_rings(on_image, content, layout, theme)
            _paint_labels(on_image, content, layout, theme)

        on_field = content.shown_field is not None
        self._paint_kept(painter, "selection", (theme.name, content.outputs, on_field), paint)

    def _paint_kept(
        self,
        painter: QPainter,
        name: str,
        depends_on: tuple[object, ...],
        paint: Callable[[QPainter], None],
    ) -> None:
        """Draw what is slow to draw and rarely different: it is kept as a picture."""
        room, ratio = self._layout.room, painter.device().devicePixelRatioF()
        key = (*depends_on, ratio, painter.font().toString())
        if name not in self._kept or self._kept[name][0] != key:
            size = room.size() * ratio
            image = QImage(size.toSize(), QImage.Format.Format_ARGB32_Premultiplied)
            image.setDevicePixelRatio(ratio)
            image.fill(Qt.GlobalColor.transparent)
            on_image = QPainter(image)
            on_image.setRenderHints(_HINTS)
            on_image.setFont(painter.font())
            on_image.translate(-room.topLeft())
            paint(on_image)
            on_image.end()
            self._kept[name] = key, image
        painter.drawImage(room.topLeft(), self._kept[name][1])

    def _paint_discs(
        self, painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        painter.setPen(QPen(QColor(theme.skin_line), 1))
        fills = self._fills(content, theme)
        radius = layout.disc_radius
        for number in DORSAL_OUTPUTS:
            painter.setBrush(fills[number - 1])
            painter.drawEllipse(QPointF(*layout.points[number - 1]), radius, radius)

    def _paint_palmar(
        self, painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        card, radius = layout.palmar_card, layout.palmar_radius
        ground = QColor(theme.base)
        ground.setAlphaF(0.88)
        painter.setPen(QPen(QColor(theme.grid), 1))
        painter.setBrush(ground)
        painter.drawRoundedRect(card, 4 * layout.unit, 4 * layout.unit)
        painter.setPen(QColor(theme.dim))
        line = painter.fontMetrics().height()
        head = QRectF(card.left(), card.top(), card.width(), 1.4 * line)
        painter.drawText(head, Qt.AlignmentFlag.AlignCenter, PALMAR_TITLE)
        fills = self._fills(content, theme)
        for number in VOLAR_OUTPUTS:
            fill, centre = fills[number - 1], QPointF(*layout.points[number - 1])
            painter.setPen(QPen(QColor(theme.skin_line), 1))
            painter.setBrush(fill)
            painter.drawEllipse(centre, radius, radius)
            painter.setPen(QColor("black" if is_light(fill) else "white"))
            painter.drawText(square(centre, radius), Qt.AlignmentFlag.AlignCenter, str(number))

    def _fills(self, content: MapContent, theme: Theme) -> list[QColor]:
        """Colour of each of the 72 outputs."""
        levels = content.coloured_levels_db
        if levels is None:
            return [QColor(theme.base)] * 72
        return level_colours(levels, content.range_db, self._table)


def ring_radius(number: int, content: MapContent, layout: MapLayout) -> float:
    """Radius of the ring around an output, px."""
    if number in VOLAR_OUTPUTS:
        return layout.palmar_radius + 2 * layout.unit
    if content.shown_field is None:
        return layout.disc_radius + 1.5 * layout.unit
    return max(layout.dot_radius + 2.5 * layout.unit, 4.5 * layout.unit)


def paint_ring(
    painter: QPainter, centre: QPointF, radius: float, colour: QColor, ground: QColor, unit: float
) -> None:
    """Draw a ring that stands out from any colour under it."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(ground, 4.5 * unit))
    painter.drawEllipse(centre, radius, radius)
    painter.setPen(QPen(colour, 2.2 * unit))
    painter.drawEllipse(centre, radius, radius)


def small_font(font: QFont, factor: float = 0.86) -> QFont:
    """Copy of ``font`` for labels."""
    copy = QFont(font)
    if font.pixelSize() > 0:
        copy.setPixelSize(max(round(font.pixelSize() * factor), 8))
    else:
        copy.setPointSizeF(font.pointSizeF() * factor)
    return copy


def _paint_dots(painter: QPainter, layout: MapLayout) -> None:
    painter.setPen(QPen(QColor(0, 0, 0, 150), layout.unit))
    painter.setBrush(QColor(255, 255, 255, 230))
    for number in DORSAL_OUTPUTS:
        centre = QPointF(*layout.points[number - 1])
        painter.drawEllipse(centre, layout.dot_radius, layout.dot_radius)


def _paint_rings(painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme) -> None:
    """Rings in the colours of the curves around the selected outputs."""
    ground = QColor(theme.base)
    for rank, number in enumerate(content.outputs):
        centre = QPointF(*layout.points[number - 1])
        radius = ring_radius(number, content, layout)
        paint_ring(painter, centre, radius, theme.output_colour(rank), ground, layout.unit)


def _paint_labels(painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme) -> None:
    """Numbers beside the rings of dorsal outputs; palmar ones carry theirs anyway."""
    dorsal = [number for number in content.outputs if number not in VOLAR_OUTPUTS]
    if not dorsal:
        return
    radius = ring_radius(dorsal[0], content, layout)
    ground = QColor(theme.base)
    ground.setAlphaF(0.9)
    painter.setBrush(ground)
    for label in output_labels(dorsal, layout, radius, QFontMetricsF(painter.font())):
        colour = theme.output_colour(content.outputs.index(label.number))
        painter.setPen(QPen(colour, 1))
        painter.drawRoundedRect(label.area, 3 * layout.unit, 3 * layout.unit)
        painter.setPen(QColor(theme.text))
        painter.drawText(label.area, Qt.AlignmentFlag.AlignCenter, str(label.number))
