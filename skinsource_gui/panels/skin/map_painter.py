"""Draws the dorsal map."""

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetricsF,
    QPainter,
    QPainterPath,
    QPen,
    QPolygonF,
)

from skinsource.limbs.limb import LimbMap
from skinsource_gui.panels.skin.inputs.marks import paint_marks
from skinsource_gui.panels.skin.length_bar import length_bar, paint_length_bar
from skinsource_gui.panels.skin.map_content import MapContent
from skinsource_gui.panels.skin.noise_hatch import paint_hatch
from skinsource_gui.panels.skin.output_labels import is_crowded, is_on_card, paint_labels, square
from skinsource_gui.panels.skin.stage.map_layout import MapLayout
from skinsource_gui.panels.skin.triad import paint_triad
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.kept_picture import KeptPicture, PaintedAnew
from skinsource_gui.widgets.map.colour_maps import colour_table, is_light, level_colours
from skinsource_gui.widgets.outputs.picking import dorsal_outputs

_RING_PX, _THIN_PX = 2.2, 1.2
# A map is so many lines of its letters high, and wide, at least; a line that is no larger, px.
_MAP_LINES, _MAP_WORDS, _USUAL_PX = 12.0, 9.0, 18.0
_HINTS = QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform


class MapPainter:
    """Draws maps, and keeps what stays the same from one frame to the next.

    Parameters
    ----------
    limb_map
        Outline and places.
    kept
        `KeptPicture` on the screen, `PaintedAnew` for pages and files.
    """

    def __init__(
        self,
        limb_map: LimbMap,
        kept: type[KeptPicture | PaintedAnew] = KeptPicture,
    ) -> None:
        self._limb_map, self._outline = limb_map, QPainterPath()
        self._outline.addPolygon(QPolygonF([QPointF(x, y) for x, y in limb_map.outline]))
        self._outline.closeSubpath()
        self._kept = kept
        self._layout: MapLayout | None = None
        self._screen_outline, self._bar_card = QPainterPath(), QRectF()
        self._forget_pictures()

    def _forget_pictures(self) -> None:
        self._still, self._selection = self._kept(), self._kept()
        self._hatch, self._marks = self._kept(), self._kept()

    def paint(
        self, painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        """Draw ``content``; the painter's font is that of labels."""
        if layout is not self._layout:
            self._layout = layout
            self._screen_outline = layout.frame.transform().map(self._outline)
            self._forget_pictures()
        painter.setRenderHints(_HINTS)
        self._paint_ground(painter, content, layout, theme)
        self._paint_still(painter, content, layout, theme)
        if content.shown_field is None:
            self._paint_discs(painter, content, layout, theme)
            _paint_cards(painter, layout, theme)
        self._paint_palmar(painter, content, layout, theme)
        if content.hatched:
            self._paint_hatch(painter, content, layout)
        if content.inputs:
            self._paint_inputs(painter, content, layout, theme)
        metrics = painter.fontMetrics()
        bar = length_bar(layout, content.px_per_mm, self._screen_outline, metrics)
        self._bar_card = bar.card
        self._paint_selection(painter, content, layout, theme)
        paint_length_bar(painter, bar, theme)

    def _paint_ground(
        self, painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        """The field, a little beyond the outline, or the bare skin."""
        field, levels = content.shown_field, content.field_values
        if field is None or levels is None:
            painter.fillPath(self._screen_outline, QColor(theme.skin))
            return
        # The picture's first line is the highest y: it is drawn downwards from there.
        area = layout.frame.transform().mapRect(field.rect)
        table = colour_table(content.colours)
        painter.drawImage(area, field.image(levels, content.value_range, table))

    def _paint_still(
        self, painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        """Outline; on a field also sensor dots, the card of the palm, and all that is outside."""
        on_field = content.shown_field is not None
        dots = content.sensors_shown and on_field

        def paint(on_image: QPainter) -> None:
            if on_field:
                # To cover what is outside is far quicker than to clip what is inside.
                outside = QPainterPath(self._screen_outline)
                outside.addRect(layout.room)
                on_image.fillPath(outside, QColor(theme.base))
            line = QPen(QColor(theme.skin_line), 1.25 * layout.unit)
            on_image.strokePath(self._screen_outline, line)
            if dots:
                _paint_dots(on_image, layout)
            if on_field:
                _paint_cards(on_image, layout, theme)

        self._still.paint(painter, layout.room, (theme.name, dots, on_field), paint)

    def _paint_hatch(self, painter: QPainter, content: MapContent, layout: MapLayout) -> None:
        """Strokes where there is mostly noise."""

        def paint(on_image: QPainter) -> None:
            paint_hatch(on_image, content.noisy, layout, self._screen_outline)

        self._hatch.paint(painter, layout.room, (content.noisy,), paint)

    def _paint_inputs(
        self, painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        shown = content.inputs, self._limb_map, layout, theme, content.pointed_at
        key = (theme.name, content.inputs, content.pointed_at)
        self._marks.paint(painter, layout.room, key, lambda one: paint_marks(one, *shown))

    def _paint_selection(
        self, painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        """Rings in the colours of the curves, and numbers."""
        if not content.outputs:
            return

        def paint(on_image: QPainter) -> None:
            _paint_rings(on_image, content, layout, theme)
            radius = ring_radius(0, content, layout)
            paint_labels(on_image, content.outputs, layout, radius, theme, self._bar_card)

        on_field = content.shown_field is not None
        key = (theme.name, content.outputs, on_field, self._bar_card.getRect())
        self._selection.paint(painter, layout.room, key, paint)

    def _paint_discs(
        self, painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        painter.setPen(QPen(QColor(theme.skin_line), 1))
        dorsal = dorsal_outputs(layout.points, layout.unplaced)
        fills = self._fills(dorsal, content, theme)
        radius = layout.disc_radius
        for number, fill in zip(dorsal, fills, strict=True):
            painter.setBrush(fill)
            painter.drawEllipse(QPointF(*layout.points[number - 1]), radius, radius)

    def _paint_palmar(
        self, painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        radius = layout.palmar_radius
        fills = self._fills(layout.unplaced, content, theme)
        outline = QPen(QColor(theme.skin_line), 1)
        for number, fill in zip(layout.unplaced, fills, strict=True):
            centre = QPointF(*layout.points[number - 1])
            painter.setPen(outline)
            painter.setBrush(fill)
            painter.drawEllipse(centre, radius, radius)
            painter.setPen(QColor("black" if is_light(fill) else "white"))
            painter.drawText(square(centre, radius), Qt.AlignmentFlag.AlignCenter, str(number))

    def _fills(self, outputs: Sequence[int], content: MapContent, theme: Theme) -> list[QColor]:
        """Colour of each of ``outputs``."""
        levels = content.coloured_values
        if levels is None:
            return [QColor(theme.base)] * len(outputs)
        table = colour_table(content.colours)
        return level_colours(levels[np.array(outputs, int) - 1], content.value_range, table)


def ring_radius(number: int, content: MapContent, layout: MapLayout) -> float:
    """Radius of the ring around an output, px."""
    if number in layout.unplaced:
        return layout.palmar_radius + 2 * layout.unit
    if content.shown_field is None:
        return layout.disc_radius + 1.5 * layout.unit
    return max(layout.dot_radius + 2.5 * layout.unit, 4.5 * layout.unit)


def paint_ring(
    painter: QPainter, centre: QPointF, radius: float, pen: QPen, ground: QColor
) -> None:
    """Draw a ring that stands out from any colour under it."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(ground, 2 * pen.widthF()))
    painter.drawEllipse(centre, radius, radius)
    painter.setPen(pen)
    painter.drawEllipse(centre, radius, radius)


def paint_mark(
    painter: QPainter,
    number: int,
    colour: str,
    content: MapContent,
    layout: MapLayout,
    theme: Theme,
) -> None:
    """Draw a wide ring around an output that is pointed at."""
    radius = ring_radius(number, content, layout) + 3.5 * layout.unit
    centre = QPointF(*layout.points[number - 1])
    pen = QPen(QColor(colour), 0.8 * _RING_PX * layout.unit)
    paint_ring(painter, centre, radius, pen, QColor(theme.base))


def paint_band(painter: QPainter, band: QRectF, theme: Theme) -> None:
    """Draw a rubber band."""
    fill = QColor(theme.accent)
    painter.setPen(QPen(fill, 1))
    fill.setAlphaF(0.15)
    painter.setBrush(fill)
    painter.drawRect(band)


def letters_for(font: QFont, room: QRectF) -> QFont:
    """Copy of ``font``, smaller where in its size a map in ``room`` would be hidden by its words.

    Letters of a usual size stay as they are.
    """
    line = QFontMetricsF(font).height()
    most = max(min(room.height() / _MAP_LINES, room.width() / _MAP_WORDS), _USUAL_PX)
    return font if line <= most else small_font(font, most / line)


def small_font(font: QFont, factor: float = 0.86) -> QFont:
    """Copy of ``font`` for labels."""
    copy = QFont(font)
    if font.pixelSize() > 0:
        copy.setPixelSize(max(round(font.pixelSize() * factor), 8))
    else:
        copy.setPointSizeF(font.pointSizeF() * factor)
    return copy


def _paint_cards(painter: QPainter, layout: MapLayout, theme: Theme) -> None:
    """Draw the ground of the palmar group, and the sensors' axes."""
    card = layout.palmar_card
    if not card.isEmpty():
        _paint_card(painter, card, layout, theme)
        painter.setPen(QColor(theme.dim))
        line = painter.fontMetrics().height()
        head = QRectF(card.left(), card.top(), card.width(), 1.4 * line)
        painter.drawText(head, Qt.AlignmentFlag.AlignCenter, layout.card_title)
    if not layout.triad_card.isEmpty():
        _paint_card(painter, layout.triad_card, layout, theme)
        paint_triad(painter, layout.triad_card, theme)


def _paint_card(painter: QPainter, card: QRectF, layout: MapLayout, theme: Theme) -> None:
    ground = QColor(theme.base)
    ground.setAlphaF(0.88)
    painter.setPen(QPen(QColor(theme.grid), 1))
    painter.setBrush(ground)
    painter.drawRoundedRect(card, 4 * layout.unit, 4 * layout.unit)


def _paint_dots(painter: QPainter, layout: MapLayout) -> None:
    painter.setPen(QPen(QColor(0, 0, 0, 150), layout.unit))
    painter.setBrush(QColor(255, 255, 255, 230))
    for number in dorsal_outputs(layout.points, layout.unplaced):
        centre = QPointF(*layout.points[number - 1])
        painter.drawEllipse(centre, layout.dot_radius, layout.dot_radius)


def _paint_rings(painter: QPainter, content: MapContent, layout: MapLayout, theme: Theme) -> None:
    """Rings in the colours of the curves around the selected outputs."""
    ground, crowded = QColor(theme.base), is_crowded(len(content.outputs), layout)
    for rank, number in enumerate(content.outputs):
        if number > len(layout.points) or is_on_card(number, layout):
            continue  # not on this limb, or out of sight
        centre = QPointF(*layout.points[number - 1])
        radius = ring_radius(number, content, layout)
        width = (_THIN_PX if crowded else _RING_PX) * layout.unit
        pen = theme.output_pen(rank, width, layout.unit)
        paint_ring(painter, centre, radius, pen, ground)
