"""Where the inputs are, seen through the hand, and how they are drawn."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from skinsource.design.design import Design, audible_indices
from skinsource.design.view import View
from skinsource.limbs.limb import LimbMap
from skinsource_gui.panels.skin.stage.map_layout import MapLayout
from skinsource_gui.theme import Theme

_RING_PX, _DASH, _REACH_PX = 7.5, (3.0, 2.0), 10.0


@dataclass(frozen=True, slots=True, kw_only=True)
class InputMark:
    """One input on the map.

    Attributes
    ----------
    id, location, colour
        As those of the input; colours are numbers of the theme's palette.
    heard, selected
        Whether it is heard; whether it is selected.
    """

    id: int
    location: int
    colour: int
    heard: bool
    selected: bool


def marks_of(design: Design, view: View) -> tuple[InputMark, ...]:
    """Marks of all inputs of a design."""
    heard = set(audible_indices(design.inputs))
    return tuple(
        InputMark(
            id=one.id,
            location=one.location,
            colour=one.colour,
            heard=index in heard,
            selected=one.id in view.selected_inputs,
        )
        for index, one in enumerate(design.inputs)
    )


def marks_at(
    marks: tuple[InputMark, ...], limb_map: LimbMap, layout: MapLayout, at: QPointF
) -> tuple[InputMark, ...]:
    """The marks within reach of a place of the screen, nearest first, of one place the last one."""
    found = []
    for rank, one in enumerate(marks):
        centre = _centre(one, limb_map, layout)
        if centre is not None:
            away = float(np.hypot(at.x() - centre.x(), at.y() - centre.y()))
            if away <= _REACH_PX * layout.unit:
                found.append((away, -rank, one))
    return tuple(one for *_, one in sorted(found, key=lambda each: each[:2]))


def paint_marks(
    painter: QPainter,
    marks: tuple[InputMark, ...],
    limb_map: LimbMap,
    layout: MapLayout,
    theme: Theme,
    pointed_at: int | None = None,
) -> None:
    """Draw a dashed ring for each input; the one that is pointed at with its number."""
    painter.save()
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for one in marks:
        centre = _centre(one, limb_map, layout)
        if centre is None:
            continue
        wide = one.selected or one.id == pointed_at
        radius = (_RING_PX + (1.5 if wide else 0.0)) * layout.unit
        width = (2.4 if wide else 1.6) * layout.unit
        painter.setOpacity(1.0 if one.heard else 0.45)
        painter.setPen(QPen(QColor(theme.base), width + 2.0 * layout.unit))
        painter.drawEllipse(centre, radius, radius)
        pen = QPen(theme.input_colour(one.colour), width)
        pen.setDashPattern(list(_DASH))
        painter.setPen(pen)
        painter.drawEllipse(centre, radius, radius)
        if one.id == pointed_at:
            _paint_number(painter, one, centre, radius, layout, theme)
    painter.restore()


def _paint_number(
    painter: QPainter,
    one: InputMark,
    centre: QPointF,
    radius: float,
    layout: MapLayout,
    theme: Theme,
) -> None:
    words = str(one.location)
    line = painter.fontMetrics().height()
    width = painter.fontMetrics().horizontalAdvance(words) + 0.5 * line
    area = QRectF(centre.x() + radius + 2 * layout.unit, centre.y() - line / 2, width, line)
    painter.setPen(QPen(theme.input_colour(one.colour), layout.unit))
    painter.setBrush(QColor(theme.base))
    painter.drawRoundedRect(area, 3 * layout.unit, 3 * layout.unit)
    painter.setPen(QColor(theme.text))
    painter.drawText(area, Qt.AlignmentFlag.AlignCenter, words)
    painter.setBrush(Qt.BrushStyle.NoBrush)


def _centre(one: InputMark, limb_map: LimbMap, layout: MapLayout) -> QPointF | None:
    if not 1 <= one.location <= len(limb_map.input_positions):
        return None
    [[x, y]] = layout.frame.to_screen(limb_map.input_positions[one.location - 1 : one.location])
    return QPointF(float(x), float(y)) if np.isfinite((x, y)).all() else None
