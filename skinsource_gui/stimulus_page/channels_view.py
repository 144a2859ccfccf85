"""The channels of a stimulus below each other: their picture, peak, and what would clip."""

from collections.abc import Mapping

import numpy as np
from PySide6.QtCore import QLineF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from skinsource.base.arrays import Floats
from skinsource.export.stimulus_export.preparing import ChannelOverview, Overview
from skinsource_gui.theme import UNIT_PX, current_theme, tabular
from skinsource_gui.widgets.over.veil import PALE

_ROW_PX, _GAP_PX = 58, 6
_WORDS_PX = 208
_LEAST_PX = 160


class ChannelsView(QWidget):
    """Paints one row for each channel."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("stimulus_channels")
        self._overview: Overview | None = None
        self._colours: Mapping[int, int] = {}
        self._pale = False
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName("Channels as they will be written")

    @property
    def overview(self) -> Overview | None:
        """What is painted."""
        return self._overview

    def sizeHint(self) -> QSize:
        n = len(self._overview.channels) if self._overview else 0
        return QSize(_WORDS_PX + 2 * _LEAST_PX, n * (_ROW_PX + _GAP_PX))

    def minimumSizeHint(self) -> QSize:
        return QSize(_WORDS_PX + _LEAST_PX, self.sizeHint().height())

    def show_overview(self, overview: Overview | None, colours: Mapping[int, int]) -> None:
        """Paint ``overview``; ``colours`` has the number of the colour of each input."""
        self._overview, self._colours, self._pale = overview, colours, False
        words = [line for one in overview.channels for line in words_of(one)] if overview else []
        self.setAccessibleDescription("; ".join(words))
        self.updateGeometry()
        self.update()

    def set_pale(self, pale: bool) -> None:
        """Say that what is painted is about to change."""
        self._pale = pale
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        if self._overview is None:
            return
        painter = QPainter(self)
        painter.setOpacity(PALE if self._pale else 1.0)
        for row, one in enumerate(self._overview.channels):
            top = row * (_ROW_PX + _GAP_PX)
            if event.rect().intersects(QRectF(0, top, self.width(), _ROW_PX).toRect()):
                self._paint_words(painter, one, top)
                area = QRectF(_WORDS_PX, top, self.width() - _WORDS_PX, _ROW_PX)
                self._paint_picture(painter, one, area)

    def _paint_words(self, painter: QPainter, one: ChannelOverview, top: float) -> None:
        title, peak, clipped = (*words_of(one), "")[:3]
        room = QRectF(0, top, _WORDS_PX - UNIT_PX, _ROW_PX / 3)
        left = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
        painter.setFont(tabular(self.font()))
        metrics = painter.fontMetrics()
        rows = (
            (title, current_theme().text),
            (peak, current_theme().dim),
            (clipped, current_theme().error),
        )
        for number, (words, colour) in enumerate(rows):
            painter.setPen(QColor(colour))
            shown = metrics.elidedText(words, Qt.TextElideMode.ElideRight, int(room.width()))
            painter.drawText(room.translated(0, number * _ROW_PX / 3), left, shown)

    def _paint_picture(self, painter: QPainter, one: ChannelOverview, area: QRectF) -> None:
        painter.fillRect(area, QColor(current_theme().base))
        middle, reach = area.center().y(), area.height() / 2.0 - 3.0
        painter.setPen(QPen(QColor(current_theme().grid), 1))
        for level in (-1.0, 0.0, 1.0):
            y = middle - reach * level
            painter.drawLine(QLineF(area.left(), y, area.right(), y))
        colour = (
            current_theme().input_colour(self._colours.get(one.inputs[0], 0))
            if one.inputs
            else (QColor(current_theme().dim))
        )
        low, high = joined(np.clip(one.extremes, -1.0, 1.0))
        x = area.left() + (np.arange(low.size) + 0.5) * area.width() / low.size
        width = max(area.width() / low.size, 1.0)
        painter.setPen(QPen(colour, width, c=Qt.PenCapStyle.FlatCap))
        tops, bottoms = middle - reach * high, middle - reach * low
        painter.drawLines(
            [
                QLineF(at, y - 0.5, at, max(bottom, y) + 0.5)
                for at, y, bottom in zip(x.tolist(), tops.tolist(), bottoms.tolist(), strict=True)
            ]
        )
        beyond = np.flatnonzero((one.extremes[0] < -1.0) | (one.extremes[1] > 1.0))
        if one.clipped and beyond.size:
            painter.setPen(QPen(QColor(current_theme().error), max(width, 2.0)))
            painter.drawLines(
                [QLineF(at, area.top(), at, area.top() + 5.0) for at in x[beyond].tolist()]
            )


def joined(extremes: Floats) -> Floats:
    """Least and largest of each stretch, (2, n_columns), up to where the stretch before it ends.

    Stretches of few samples would be dots that nothing holds together.
    """
    low, high = extremes
    met = extremes.copy()
    met[0, 1:] = np.minimum(low[1:], high[:-1])
    met[1, 1:] = np.maximum(high[1:], low[:-1])
    return met


def words_of(one: ChannelOverview) -> list[str]:
    """Lines on a channel: what it is, how strong, and what would be cut off."""
    title = one.title if one.place is None else f"Place {one.place}, {one.title}"
    peak = "silent" if one.peak == 0.0 else f"peak {20.0 * np.log10(one.peak):z.1f} dB"
    rms = "" if one.rms == 0.0 else f", RMS {20.0 * np.log10(one.rms):z.1f} dB"
    words = [f"{one.number}  {title}", f"{peak}{rms}".replace("-", "\u2212")]
    if one.clipped:
        words.append(f"{one.clipped} sample{'' if one.clipped == 1 else 's'} would clip")
    return words
