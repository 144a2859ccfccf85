"""What the head of a track paints beside its controls."""

from PySide6.QtCore import QRect, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPen

from skinsource.limbs.locations import input_words
from skinsource_gui.panels.timeline.heads.row_places import RowPlaces
from skinsource_gui.panels.timeline.heads.row_state import RowState
from skinsource_gui.theme import UNIT_PX, Theme, scaled
from skinsource_gui.widgets.inputs.swatch import paint_swatch

_MARK_PX = 3
_TINT_ALPHA = 28
_SMALLER = 0.8


def paint_row(painter: QPainter, state: RowState, places: RowPlaces, theme: Theme) -> None:
    """Paint ground, place and name of a track, and the peak that results from a gain."""
    _paint_ground(painter, state, places.row, theme)
    shown, silent = state.shown, state.silent
    paint_swatch(
        painter,
        places.swatch,
        shown.location,
        theme.input_colour(shown.colour),
        QColor(theme.text),
        silent=silent,
    )
    usual = painter.font()
    painter.setPen(QColor(theme.dim if silent else theme.text))
    font = QFont(usual)
    font.setWeight(QFont.Weight.Medium)
    painter.setFont(font)
    place = input_words(shown.location, state.limb)
    fits = painter.fontMetrics().horizontalAdvance(place.name) <= places.name.width()
    short_name = place.short_name[0].upper() + place.short_name[1:]
    _write(painter, places.name, place.name if fits else short_name)
    painter.setFont(usual)
    if state.peak:
        painter.setPen(QColor(theme.dim))
        painter.setFont(scaled(usual, _SMALLER))
        room, said = places.peak.width(), f"peak {state.peak}"
        fits = painter.fontMetrics().horizontalAdvance(said) <= room
        _write(painter, places.peak, said if fits else state.peak)
        painter.setFont(usual)


def _paint_ground(painter: QPainter, state: RowState, row: QRect, theme: Theme) -> None:
    painter.setPen(QPen(QColor(theme.border), 1))
    painter.drawLine(UNIT_PX, row.bottom(), row.width() - UNIT_PX, row.bottom())
    if not state.selected:
        return
    tint = QColor(theme.accent)
    if state.last:
        painter.fillRect(0, 0, _MARK_PX, row.height(), tint)
    if state.last and state.list_focused:
        painter.setPen(QPen(tint, 2))
        painter.drawRect(QRectF(row).adjusted(1, 1, -1, -1))
    tint.setAlpha(_TINT_ALPHA)
    painter.fillRect(row, tint)


def _write(painter: QPainter, place: QRect, text: str) -> None:
    shown = painter.fontMetrics().elidedText(text, Qt.TextElideMode.ElideRight, place.width())
    painter.drawText(place, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, shown)
