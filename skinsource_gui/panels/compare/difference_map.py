"""A map of how much louder one design is than another."""

from dataclasses import dataclass
from math import ceil

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QHelpEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QToolTip, QWidget

from skinsource.design.comparing import end_db
from skinsource_gui.theme import UNIT_PX, current_theme, tabular
from skinsource_gui.widgets.fields.level_text import minus, output_text
from skinsource_gui.widgets.map.colour_maps import DIVERGING, colour_table
from skinsource_gui.widgets.map.output_rings import paint_numbers, paint_rings
from skinsource_gui.widgets.map.scale_row import Scale, paint_scale_row, scale_row_px
from skinsource_gui.widgets.map.small_map import Range, SmallMap, paint_small_map, small_frame
from skinsource_gui.widgets.outputs.picking import output_at

_LEAST_MAP_PX = 70.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Difference:
    """What the map shows.

    Attributes
    ----------
    shown
        Differences in dB, in place of levels; None: nothing can be shown.
    heading, words
        What minus what, and what else one should know; without a map: why there is none.
    limb
        Whose outputs they are.
    outputs
        Those that are selected: marked on the map.
    """

    shown: SmallMap | None = None
    heading: str = ""
    words: str = ""
    limb: str = ""
    outputs: tuple[int, ...] = ()

    @property
    def end_db(self) -> float:
        """Largest difference that the colours tell, dB."""
        levels = None if self.shown is None else self.shown.levels_db
        return end_db() if levels is None else end_db(levels)

    @property
    def reached_db(self) -> Range | None:
        """The smallest and the largest difference, dB."""
        levels = None if self.shown is None else self.shown.levels_db
        return None if levels is None else (float(levels.min()), float(levels.max()))


class DifferenceMap(QWidget):
    """The map, and below it a scale with zero in its middle."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._difference = Difference()
        self.setObjectName("difference_map")

    @property
    def difference(self) -> Difference:
        """What is shown."""
        return self._difference

    def show_difference(self, difference: Difference) -> None:
        """Take over what to show."""
        self._difference = difference
        words = f"{difference.heading}. {difference.words}".strip(". ")
        self.setAccessibleName(words)
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(240, 320)

    def minimumSizeHint(self) -> QSize:
        line = self.fontMetrics().height()
        return QSize(180, ceil(line + scale_row_px(line) + UNIT_PX + _LEAST_MAP_PX))

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            words = self.words_at(QPointF(event.pos()))
            QToolTip.showText(event.globalPos(), words, self)
            return True
        return super().event(event)

    def words_at(self, point: QPointF) -> str:
        """The difference at the output under the pointer; empty where there is none."""
        shown = self._difference.shown
        if shown is None or shown.levels_db is None:
            return ""
        places = small_frame(shown.limb_map, self._areas()[1]).to_screen(
            shown.limb_map.output_positions
        )
        number = output_at(places, point)
        if number is None:
            return ""
        difference = minus(f"{shown.levels_db[number - 1]:+z.1f} dB")
        return f"{output_text(number, self._difference.limb)}: {difference}"

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, theme, difference = QPainter(self), current_theme(), self._difference
        painter.setFont(tabular(self.font()))
        top, area, bottom = self._areas()
        flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
        if difference.shown is None:
            painter.setPen(QColor(theme.dim))
            painter.drawText(QRectF(self.rect()), flags, difference.words)
            painter.end()
            return
        painter.setPen(QColor(theme.text))
        painter.drawText(top, flags, difference.heading)
        end, reached = difference.end_db, difference.reached_db
        scale = Scale(
            range_db=(-end, end),
            words=difference.words,
            colours=DIVERGING,
            signed=True,
            reached_db=reached,
        )
        table = colour_table(DIVERGING)
        paint_small_map(painter, area, difference.shown, None, theme, scale.range_db, table)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_rings(painter, difference.shown, area, difference.outputs, theme)
        paint_numbers(painter, difference.shown, area, difference.outputs, theme)
        paint_scale_row(painter, bottom, scale, theme)
        painter.end()

    def _areas(self) -> tuple[QRectF, QRectF, QRectF]:
        """Room for the heading, the map and the scale."""
        line = self.fontMetrics().height()
        room = QRectF(self.rect())
        top = QRectF(room.left(), room.top(), room.width(), line)
        below = scale_row_px(line)
        bottom = QRectF(room.left(), room.bottom() - below, room.width(), below)
        area = room.adjusted(UNIT_PX, line + UNIT_PX // 2, -UNIT_PX, -below - UNIT_PX // 2)
        return top, area, bottom
