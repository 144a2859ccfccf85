"""How the skin map is painted: colours, inputs, length bar, hatching and labels."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from PySide6 import QtGui
from PySide6.QtCore import QLineF, QPointF, QRectF, QSizeF, Qt

from skinsource.limbs.limb import LimbMap
from skinsource_gui.panels.skin.content import InputMark, MapContent
from skinsource_gui.panels.skin.layout import TEXT_LINES, MapLayout
from skinsource_gui.plots.colour_maps import colour_table, is_light, level_colours
from skinsource_gui.plots.outputs import dorsal_outputs, is_placed
from skinsource_gui.plots.small_map import (
    bar_length_mm,
    outline_of,
    paint_dark_strokes,
    paint_ring,
    paint_strokes,
)
from skinsource_gui.qt.frames import CachedPicture
from skinsource_gui.qt.theme import Theme, scaled, translucent

_INPUT_RING_PX, _DASH, _REACH_PX = 7.5, (3.0, 2.0), 10.0


def marks_at(
    marks: tuple[InputMark, ...], limb_map: LimbMap, layout: MapLayout, at: QPointF
) -> tuple[InputMark, ...]:
    """Return the marks within reach of a screen place, nearest first, later ones before earlier."""
    reached = []
    for rank, mark in enumerate(marks):
        centre = _centre(mark, limb_map, layout)
        if centre is not None:
            away = float(np.hypot(at.x() - centre.x(), at.y() - centre.y()))
            if away <= _REACH_PX * layout.unit:
                reached.append((away, -rank, mark))
    return tuple(mark for *_, mark in sorted(reached, key=lambda each: each[:2]))


def paint_marks(
    painter: QtGui.QPainter,
    marks: tuple[InputMark, ...],
    limb_map: LimbMap,
    layout: MapLayout,
    theme: Theme,
    pointed_at: int | None = None,
) -> None:
    """Draw a dashed ring for each input, and a number at the one that is pointed at."""
    painter.save()
    for mark in marks:
        centre = _centre(mark, limb_map, layout)
        if centre is None:
            continue
        wide = mark.selected or mark.id == pointed_at
        radius = (_INPUT_RING_PX + (1.5 if wide else 0.0)) * layout.unit
        width = (2.4 if wide else 1.6) * layout.unit
        painter.setOpacity(1.0 if mark.audible else 0.45)
        pen = QtGui.QPen(theme.input_colour(mark.colour), width)
        pen.setDashPattern(list(_DASH))
        paint_ring(painter, centre, radius, pen, theme)
        if mark.id == pointed_at:
            _paint_number(painter, mark, centre, radius, layout, theme)
    painter.restore()


def _paint_number(
    painter: QtGui.QPainter,
    mark: InputMark,
    centre: QPointF,
    radius: float,
    layout: MapLayout,
    theme: Theme,
) -> None:
    text = str(mark.location)
    line = painter.fontMetrics().height()
    width = painter.fontMetrics().horizontalAdvance(text) + 0.5 * line
    area = QRectF(centre.x() + radius + 2 * layout.unit, centre.y() - line / 2, width, line)
    painter.setPen(QtGui.QPen(theme.input_colour(mark.colour), layout.unit))
    painter.setBrush(QtGui.QColor(theme.base))
    painter.drawRoundedRect(area, 3 * layout.unit, 3 * layout.unit)
    painter.setPen(QtGui.QColor(theme.text))
    painter.drawText(area, Qt.AlignmentFlag.AlignCenter, text)


def _centre(mark: InputMark, limb_map: LimbMap, layout: MapLayout) -> QPointF | None:
    if not 1 <= mark.location <= len(limb_map.input_positions):
        return None
    [[x, y]] = layout.frame.to_screen(limb_map.input_positions[mark.location - 1 : mark.location])
    return QPointF(float(x), float(y)) if np.isfinite((x, y)).all() else None


def paint_length_bar(
    painter: QtGui.QPainter, layout: MapLayout, px_per_mm: float, card: QRectF, theme: Theme
) -> None:
    """Draw the bar into its card, in the font of labels, which the painter has."""
    if card.isEmpty():
        return
    line, unit = painter.fontMetrics().height(), layout.unit
    on_screen = px_per_mm * layout.frame.scale
    length_mm = bar_length_mm(on_screen, layout.room.width())
    left, bottom = card.left() + 4 * unit, card.bottom() - 3 * unit
    ground = translucent(theme.base, 224)
    painter.fillRect(card, ground)
    pen = QtGui.QPen(QtGui.QColor(theme.text), 2 * unit)
    pen.setCapStyle(Qt.PenCapStyle.FlatCap)
    painter.setPen(pen)
    painter.drawLine(QLineF(left, bottom, left + length_mm * on_screen, bottom))
    painter.setPen(QtGui.QColor(theme.text))
    above = QRectF(left, bottom - 1.4 * line, card.width() - 8 * unit, 1.2 * line)
    left_middle = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
    painter.drawText(above, left_middle, f"{length_mm} mm")


def bar_card(
    layout: MapLayout, px_per_mm: float, skin: QtGui.QPainterPath, metrics: QtGui.QFontMetrics
) -> QRectF:
    """Return the first corner in which the bar hides neither skin nor a card.

    Where there is none, as on a magnified hand, return the lower left one.

    Parameters
    ----------
    layout
        Where the map lies.
    px_per_mm
        Outline pixels in a millimetre; 0: that is not known, and the card is empty.
    skin
        The outline on the screen.
    metrics
        Of the font of labels.
    """
    on_screen = px_per_mm * layout.frame.scale
    if on_screen <= 0.0:
        return QRectF()
    length_mm, line = bar_length_mm(on_screen, layout.room.width()), metrics.height()
    width = max(length_mm * on_screen, metrics.horizontalAdvance(f"{length_mm} mm"))
    size = QSizeF(width + 8 * layout.unit, 1.5 * line + 3 * layout.unit)
    room, unit = layout.room, layout.unit
    card = layout.palmar_card
    left, top = room.left() + 4 * unit, room.top() + TEXT_LINES * line
    low, right = room.bottom() - 3 * unit - size.height(), room.right() - 4 * unit - size.width()
    corners = (
        QPointF(left, low),
        QPointF((card.left() if card.width() else room.right()) - 4 * unit - size.width(), low),
        QPointF(right, top),
        QPointF(left, top),
    )
    places = [QRectF(corner, size) for corner in corners]
    free = (
        place
        for place in places
        if room.contains(place) and not skin.intersects(place) and not card.intersects(place)
    )
    return next(free, places[0])


# Hatched area around a sensor, in radii of its disc: about half of the way to its neighbours.
_HATCH_RADII = 3.0


def paint_hatch(
    painter: QtGui.QPainter, noisy: tuple[int, ...], layout: MapLayout, outline: QtGui.QPainterPath
) -> None:
    """Hatch the surroundings of noisy outputs, dark and light so that it shows on any colour.

    On the back of the hand inside of the outline; on the palm side their discs.
    """
    dorsal = dorsal_outputs(layout.points, layout.unplaced)
    on_limb = [number for number in noisy if number <= len(layout.points)]
    places = {number: QPointF(*layout.points[number - 1]) for number in on_limb}
    aside = [place for number, place in places.items() if number not in dorsal]
    paint_dark_strokes(painter, aside, layout.palmar_radius)
    on_map = [place for number, place in places.items() if number in dorsal]
    paint_strokes(painter, on_map, _HATCH_RADII * layout.disc_radius, outline)


# Directions from a ring to its label, the better ones first, and distances beyond the nearest
# place, in heights of a label.
_DIRECTIONS = ((1, 0), (-1, 0), (0, -1), (0, 1), (1, -1), (-1, -1), (1, 1), (-1, 1))
_FARTHER = (0.0, 0.8, 1.6, 2.4)


# With more selected outputs, numbers are drawn only where discs have at least this radius.
_MANY, _ROOMY_PX = 20, 8.0


def is_crowded(n: int, layout: MapLayout) -> bool:
    """Return whether ``n`` selected outputs are too many for numbers beside their rings.

    A magnified map has room for more.
    """
    return n > _MANY and layout.disc_radius < _ROOMY_PX * layout.unit


def is_on_card(number: int, layout: MapLayout) -> bool:
    """Return whether an output that has a place on the map lies under the palmar group."""
    if number in layout.unplaced:
        return False
    return layout.palmar_card.contains(QPointF(*layout.points[number - 1]))


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputLabel:
    """A number and its area; a line leads to a label that is ``far`` from its ring."""

    number: int
    area: QRectF
    far: bool


def output_labels(
    numbers: Iterable[int],
    layout: MapLayout,
    radius: float,
    metrics: QtGui.QFontMetricsF,
    occupied: QRectF,
) -> tuple[OutputLabel, ...]:
    """Return labels of dorsal outputs beside their rings, or farther off where there is no room.

    One that would cover another label or a ring is left out: a pile of numbers says less than the
    output that is pointed at.

    Parameters
    ----------
    numbers
        The earlier ones are placed first.
    layout
        Places of the outputs.
    radius
        Of the rings, px.
    metrics
        Of the font of the labels.
    taken
        Where none may lie, as on the cards.
    """
    ranked = tuple(numbers)
    rings = [square(QPointF(*layout.points[number - 1]), radius) for number in ranked]
    gap = 1.5 * layout.unit
    placed: list[OutputLabel] = []
    # Text stands above the map.
    room = layout.room.adjusted(0, TEXT_LINES * metrics.height(), 0, 0)
    for number in ranked:
        hidden = [label.area.adjusted(-gap, -gap, gap, gap) for label in placed]
        hidden += [layout.palmar_card, occupied]
        free = [
            label
            for label in _candidates(number, layout, radius, metrics)
            if room.contains(label.area) and not any(map(label.area.intersects, hidden + rings))
        ]
        placed += free[:1]
    return tuple(placed)


def paint_labels(
    painter: QtGui.QPainter,
    outputs: tuple[int, ...],
    layout: MapLayout,
    radius: float,
    theme: Theme,
    occupied: QRectF,
) -> None:
    """Draw numbers beside the rings of dorsal outputs; palmar ones contain their numbers."""
    drawn = dorsal_outputs(layout.points, layout.unplaced)
    dorsal = [output for output in outputs if output in drawn and not is_on_card(output, layout)]
    if is_crowded(len(outputs), layout):
        return
    painter.setBrush(QtGui.QColor(theme.base))
    for label in output_labels(
        dorsal, layout, radius, QtGui.QFontMetricsF(painter.font()), occupied
    ):
        painter.setPen(theme.output_pen(outputs.index(label.number), 1.0))
        if label.far:
            centre = QPointF(*layout.points[label.number - 1])
            edge = QLineF(centre, label.area.center())
            edge.setLength(radius)
            painter.drawLine(QLineF(edge.p2(), label.area.center()))
        painter.drawRoundedRect(label.area, 3 * layout.unit, 3 * layout.unit)
        painter.setPen(QtGui.QColor(theme.text))
        painter.drawText(label.area, Qt.AlignmentFlag.AlignCenter, str(label.number))


def square(centre: QPointF, radius: float) -> QRectF:
    """Return the square around a circle."""
    return QRectF(centre.x() - radius, centre.y() - radius, 2 * radius, 2 * radius)


def _candidates(
    number: int, layout: MapLayout, radius: float, metrics: QtGui.QFontMetricsF
) -> list[OutputLabel]:
    x, y = layout.points[number - 1]
    width = metrics.horizontalAdvance(str(number)) + 6 * layout.unit
    height = metrics.height()
    labels = []
    for further, (right, down) in product(_FARTHER, _DIRECTIONS):
        away = radius + 3 * layout.unit + further * height
        if right and down:
            away *= 0.75  # the same distance from the ring, slantwise
        centre = QPointF(x + right * (away + width / 2), y + down * (away + height / 2))
        corner = centre - QPointF(width / 2, height / 2)
        area = QRectF(corner.x(), corner.y(), width, height)
        labels.append(OutputLabel(number=number, area=area, far=further > 0))
    return labels


_OUTPUT_RING_PX, _THIN_PX = 2.2, 1.2
# A map is at least this many lines of text high, and wide, if a line is larger than the last, px.
_MAP_LINES, _MAP_WIDTH_LINES, _USUAL_PX = 12.0, 9.0, 18.0
# Size of letters of labels, in those of messages.
_OF_LABELS = 0.86
_HINTS = QtGui.QPainter.RenderHint.Antialiasing | QtGui.QPainter.RenderHint.SmoothPixmapTransform


class MapPainter:
    """Paints maps, and caches what stays the same from one frame to the next.

    Parameters
    ----------
    limb_map
        Outline and places.
    """

    def __init__(self, limb_map: LimbMap) -> None:
        self._limb_map = limb_map
        self._layout: MapLayout | None = None
        self._screen_outline, self._bar_card = QtGui.QPainterPath(), QRectF()
        self._about_bar: tuple[float, QtGui.QFont] | None = None
        self._forget_pictures()

    def _forget_pictures(self) -> None:
        self._still, self._numbers = CachedPicture(), CachedPicture()
        self._marks, self._about_bar = CachedPicture(), None

    def paint(
        self,
        painter: QtGui.QPainter,
        content: MapContent,
        layout: MapLayout,
        theme: Theme,
        pointed_at: int | None = None,
    ) -> None:
        """Draw ``content``, and the input that is ``pointed_at``; the font is that of labels."""
        if layout is not self._layout:
            self._layout = layout
            self._screen_outline = layout.frame.transform().map(outline_of(self._limb_map))
            self._forget_pictures()
        painter.setRenderHints(_HINTS)
        self._paint_ground(painter, content, layout, theme)
        self._paint_still(painter, content, layout, theme)
        if content.shown_field is None:
            dorsal = dorsal_outputs(layout.points, layout.unplaced)
            _paint_discs(painter, dorsal, layout.disc_radius, content, layout, theme)
            _paint_palm_ground(painter, layout, theme)
        self._paint_palmar(painter, content, layout, theme)
        about_bar = content.px_per_mm, painter.font()
        if about_bar != self._about_bar:
            self._about_bar = about_bar
            self._bar_card = bar_card(
                layout, content.px_per_mm, self._screen_outline, painter.fontMetrics()
            )
        self._paint_marks(painter, content, layout, theme, pointed_at)

    def _paint_ground(
        self, painter: QtGui.QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        """Paint the field, a little beyond the outline, or the bare skin."""
        field, levels = content.shown_field, content.field_values
        if field is None or levels is None:
            painter.fillPath(self._screen_outline, QtGui.QColor(theme.skin))
            return
        table = colour_table(content.colours)
        field.paint(painter, layout.frame, layout.room, levels, content.value_range, table)

    def _paint_still(
        self, painter: QtGui.QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        """Paint the outline; on a field also sensor dots, the card of the palm and the outside."""
        on_field = content.shown_field is not None
        dots = content.sensors_shown and on_field

        def paint(on_image: QtGui.QPainter) -> None:
            if on_field:
                # Covering the outside is far quicker than clipping the inside.
                outside = QtGui.QPainterPath(self._screen_outline)
                # A pixel more: on its rim, a part of one would let the field through.
                outside.addRect(layout.room.adjusted(-1, -1, 1, 1))
                on_image.fillPath(outside, QtGui.QColor(theme.base))
            line = QtGui.QPen(QtGui.QColor(theme.skin_line), 1.25 * layout.unit)
            on_image.strokePath(self._screen_outline, line)
            if dots:
                _paint_dots(on_image, layout)
            if on_field:
                _paint_palm_ground(on_image, layout, theme)

        self._still.paint(painter, layout.room, (theme.name, dots, on_field), paint)

    def _paint_marks(
        self,
        painter: QtGui.QPainter,
        content: MapContent,
        layout: MapLayout,
        theme: Theme,
        pointed_at: int | None,
    ) -> None:
        """Paint hatching, inputs, rings and numbers of outputs, and the bar of length."""

        def paint(on_image: QtGui.QPainter) -> None:
            paint_hatch(on_image, content.hatched, layout, self._screen_outline)
            paint_marks(on_image, content.inputs, self._limb_map, layout, theme, pointed_at)
            _paint_rings(on_image, content, layout, theme)
            _paint_target(on_image, content, layout, theme)
            radius = ring_radius(0, content, layout)
            paint_labels(on_image, content.outputs, layout, radius, theme, self._bar_card)
            paint_length_bar(on_image, layout, content.px_per_mm, self._bar_card, theme)

        painted = content.strong, content.quiet
        shown = content.hatched, content.inputs, pointed_at, content.outputs, painted
        key = (theme.name, *shown, content.shown_field is None, self._bar_card.getRect())
        self._marks.paint(painter, layout.room, key, paint)

    def _paint_palmar(
        self, painter: QtGui.QPainter, content: MapContent, layout: MapLayout, theme: Theme
    ) -> None:
        radius = layout.palmar_radius
        fills = _paint_discs(painter, layout.unplaced, radius, content, layout, theme)
        inks = tuple("black" if is_light(fill) else "white" for fill in fills)

        def paint(on_image: QtGui.QPainter) -> None:
            for number, ink in zip(layout.unplaced, inks, strict=True):
                on_image.setPen(QtGui.QColor(ink))
                place = square(QPointF(*layout.points[number - 1]), radius)
                on_image.drawText(place, Qt.AlignmentFlag.AlignCenter, str(number))

        card = QRectF(layout.palmar_card.toAlignedRect())
        self._numbers.paint(painter, card, inks, paint)


def _paint_discs(
    painter: QtGui.QPainter,
    outputs: Sequence[int],
    radius: float,
    content: MapContent,
    layout: MapLayout,
    theme: Theme,
) -> list[QtGui.QColor]:
    """Paint discs at outputs, and return the colour of each."""
    levels, fills = content.coloured_values, [QtGui.QColor(theme.base)] * len(outputs)
    if levels is not None:
        table = colour_table(content.colours)
        fills = level_colours(levels[np.array(outputs, int) - 1], content.value_range, table)
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.skin_line), 1))
    for number, fill in zip(outputs, fills, strict=True):
        painter.setBrush(fill)
        painter.drawEllipse(QPointF(*layout.points[number - 1]), radius, radius)
    return fills


def ring_radius(number: int, content: MapContent, layout: MapLayout) -> float:
    """Return radius of the ring around an output, px."""
    if number in layout.unplaced:
        return layout.palmar_radius + 2 * layout.unit
    if content.shown_field is None:
        return layout.disc_radius + 1.5 * layout.unit
    return max(layout.dot_radius + 2.5 * layout.unit, 4.5 * layout.unit)


def paint_mark(
    painter: QtGui.QPainter,
    number: int,
    colour: str,
    content: MapContent,
    layout: MapLayout,
    theme: Theme,
) -> None:
    """Draw a wide ring around an output that is pointed at."""
    radius = ring_radius(number, content, layout) + 3.5 * layout.unit
    centre = QPointF(*layout.points[number - 1])
    pen = QtGui.QPen(QtGui.QColor(colour), 0.8 * _OUTPUT_RING_PX * layout.unit)
    paint_ring(painter, centre, radius, pen, theme)


def letters_for(font: QtGui.QFont, room: QRectF) -> QtGui.QFont:
    """Return a copy of ``font`` so small that the map in ``room`` is not hidden by its text.

    Letters of a usual size stay as they are.
    """
    line = QtGui.QFontMetricsF(font).height()
    most = max(min(room.height() / _MAP_LINES, room.width() / _MAP_WIDTH_LINES), _USUAL_PX)
    return font if line <= most else scaled(font, most / line)


def small_font(font: QtGui.QFont) -> QtGui.QFont:
    """Return a copy of ``font`` for labels."""
    return scaled(font, _OF_LABELS)


def _paint_palm_ground(painter: QtGui.QPainter, layout: MapLayout, theme: Theme) -> None:
    """Draw the ground of the palmar group."""
    card = layout.palmar_card
    if card.isEmpty():
        return
    ground = translucent(theme.base, 224)
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.grid), 1))
    painter.setBrush(ground)
    painter.drawRoundedRect(card, 4 * layout.unit, 4 * layout.unit)
    painter.setPen(QtGui.QColor(theme.dim))
    line = painter.fontMetrics().height()
    head = QRectF(card.left(), card.top(), card.width(), 1.4 * line)
    painter.drawText(head, Qt.AlignmentFlag.AlignCenter, layout.card_title)


def _paint_dots(painter: QtGui.QPainter, layout: MapLayout) -> None:
    painter.setPen(QtGui.QPen(QtGui.QColor(0, 0, 0, 150), layout.unit))
    painter.setBrush(QtGui.QColor(255, 255, 255, 230))
    for number in dorsal_outputs(layout.points, layout.unplaced):
        centre = QPointF(*layout.points[number - 1])
        painter.drawEllipse(centre, layout.dot_radius, layout.dot_radius)


def _paint_rings(
    painter: QtGui.QPainter, content: MapContent, layout: MapLayout, theme: Theme
) -> None:
    """Paint rings in the colours of the curves around the selected outputs."""
    crowded = is_crowded(len(content.outputs), layout)
    for rank, number in enumerate(content.outputs):
        if number > len(layout.points) or is_on_card(number, layout):
            continue  # not on this limb, or hidden
        centre = QPointF(*layout.points[number - 1])
        radius = ring_radius(number, content, layout)
        width = (_THIN_PX if crowded else _OUTPUT_RING_PX) * layout.unit
        pen = theme.output_pen(rank, width, layout.unit)
        paint_ring(painter, centre, radius, pen, theme)


# Half the side of the square around an output of a target, and of the sign in it.
_SQUARE_PX, _SIGN_PX = 7.0, 4.0


def _paint_target(
    painter: QtGui.QPainter, content: MapContent, layout: MapLayout, theme: Theme
) -> None:
    """Paint a square around each painted output, with a plus where it is strong, else a minus."""
    unit = layout.unit
    for number in (*content.strong, *content.quiet):
        if not is_placed(layout.points, number) or is_on_card(number, layout):
            continue
        centre, is_strong = QPointF(*layout.points[number - 1]), number in content.strong
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.text), unit))
        painter.setBrush(QtGui.QColor(theme.accent if is_strong else theme.base))
        painter.drawRect(square(centre, _SQUARE_PX * unit))
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.base if is_strong else theme.text), 2 * unit))
        for along in [QPointF(_SIGN_PX * unit, 0.0), QPointF(0.0, _SIGN_PX * unit)][
            : 1 + is_strong
        ]:
            painter.drawLine(QLineF(centre - along, centre + along))
