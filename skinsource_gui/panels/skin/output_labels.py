"""Where the numbers of selected outputs stand."""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import product

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter

from skinsource_gui.panels.skin.stage.map_layout import WORDS_LINES, MapLayout
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.outputs.picking import dorsal_outputs

# Directions in which a label may lie from its ring, the better ones first, and how far beyond
# the nearest place, in heights of a label.
_WAYS = ((1, 0), (-1, 0), (0, -1), (0, 1), (1, -1), (-1, -1), (1, 1), (-1, 1))
_FURTHER = (0.0, 0.8, 1.6, 2.4)


# From so many selected outputs on numbers need discs of this radius beside each other.
_MANY, _ROOMY_PX = 20, 8.0


def is_crowded(n: int, layout: MapLayout) -> bool:
    """Whether ``n`` selected outputs are so many, and so near, that numbers would hide the map.

    Magnified they have room again.
    """
    return n > _MANY and layout.disc_radius < _ROOMY_PX * layout.unit


def is_on_card(number: int, layout: MapLayout) -> bool:
    """Whether an output that has a place on the map lies under one of the cards."""
    if number in layout.unplaced:
        return False
    place = QPointF(*layout.points[number - 1])
    return any(card.contains(place) for card in (layout.palmar_card, layout.triad_card))


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputLabel:
    """A number and the area it is written in; ``far`` from its ring a line leads to it."""

    number: int
    area: QRectF
    far: bool


def output_labels(
    numbers: Iterable[int],
    layout: MapLayout,
    radius: float,
    metrics: QFontMetricsF,
    taken: QRectF,
) -> tuple[OutputLabel, ...]:
    """Labels of dorsal outputs, each beside its ring, and where that is taken at some distance.

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
    wanted = tuple(numbers)
    rings = [square(QPointF(*layout.points[number - 1]), radius) for number in wanted]
    gap = 1.5 * layout.unit
    placed: list[OutputLabel] = []
    # Words stand above the map.
    room = layout.room.adjusted(0, WORDS_LINES * metrics.height(), 0, 0)
    for number in wanted:
        hidden = [label.area.adjusted(-gap, -gap, gap, gap) for label in placed]
        hidden += [layout.palmar_card, layout.triad_card, taken]
        free = [
            label
            for label in _candidates(number, layout, radius, metrics)
            if room.contains(label.area) and not any(map(label.area.intersects, hidden + rings))
        ]
        placed += free[:1]
    return tuple(placed)


def paint_labels(
    painter: QPainter,
    outputs: tuple[int, ...],
    layout: MapLayout,
    radius: float,
    theme: Theme,
    taken: QRectF,
) -> None:
    """Draw numbers beside the rings of dorsal outputs; palmar ones carry theirs anyway."""
    drawn = dorsal_outputs(layout.points, layout.unplaced)
    dorsal = [one for one in outputs if one in drawn and not is_on_card(one, layout)]
    if is_crowded(len(outputs), layout):
        return
    painter.setBrush(QColor(theme.base))
    for label in output_labels(dorsal, layout, radius, QFontMetricsF(painter.font()), taken):
        painter.setPen(theme.output_pen(outputs.index(label.number), 1.0))
        if label.far:
            centre = QPointF(*layout.points[label.number - 1])
            edge = QLineF(centre, label.area.center())
            edge.setLength(radius)
            painter.drawLine(QLineF(edge.p2(), label.area.center()))
        painter.drawRoundedRect(label.area, 3 * layout.unit, 3 * layout.unit)
        painter.setPen(QColor(theme.text))
        painter.drawText(label.area, Qt.AlignmentFlag.AlignCenter, str(label.number))


def square(centre: QPointF, radius: float) -> QRectF:
    """The square around a circle."""
    return QRectF(centre.x() - radius, centre.y() - radius, 2 * radius, 2 * radius)


def _candidates(
    number: int, layout: MapLayout, radius: float, metrics: QFontMetricsF
) -> list[OutputLabel]:
    x, y = layout.points[number - 1]
    width = metrics.horizontalAdvance(str(number)) + 6 * layout.unit
    height = metrics.height()
    labels = []
    for further, (right, down) in product(_FURTHER, _WAYS):
        away = radius + 3 * layout.unit + further * height
        if right and down:
            away *= 0.75  # the same distance from the ring, slantwise
        centre = QPointF(x + right * (away + width / 2), y + down * (away + height / 2))
        corner = centre - QPointF(width / 2, height / 2)
        area = QRectF(corner.x(), corner.y(), width, height)
        labels.append(OutputLabel(number=number, area=area, far=further > 0))
    return labels
