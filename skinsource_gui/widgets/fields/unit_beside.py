"""The unit that stands in a line of text, right of a number."""

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QColor, QPainter
from PySide6.QtWidgets import QLineEdit, QStyle, QStyleOptionFrame

from skinsource_gui.theme import Theme

_GAP_PX = 4
# Qt leaves this at each side of the text of a line edit.
_TEXT_EDGE_PX = 2


class UnitBeside:
    """Keeps room for a unit at the right end of a line, and paints it there.

    Parameters
    ----------
    line
        Where it stands.
    widest
        Unit for which there is room at least, so that digits align with those of other lines.
    """

    def __init__(self, line: QLineEdit, widest: str) -> None:
        self._line, self._widest = line, widest

    @property
    def room_px(self) -> int:
        """Width that is left for the number."""
        margins = self._line.textMargins()
        return _inside(self._line).width() - margins.right() - 2 * _TEXT_EDGE_PX

    def width_px(self, number: str) -> int:
        """Width of a line that has just room for a number."""
        around = self._line.width() - self.room_px
        return around + self._line.fontMetrics().horizontalAdvance(number)

    def make_room(self, symbol: str) -> None:
        """Keep room for a unit, or for the widest one."""
        widths = map(self._line.fontMetrics().horizontalAdvance, (symbol, self._widest))
        self._line.setTextMargins(0, 0, max(widths) + _GAP_PX, 0)

    def paint(self, painter: QPainter, symbol: str, theme: Theme) -> None:
        """Write the unit."""
        place = _inside(self._line)
        place.setLeft(place.right() - self._line.textMargins().right() + _GAP_PX)
        painter.setPen(QColor(theme.dim))
        painter.drawText(place, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, symbol)


def _inside(line: QLineEdit) -> QRect:
    """Area of the text and the unit."""
    option = QStyleOptionFrame()
    line.initStyleOption(option)
    return line.style().subElementRect(QStyle.SubElement.SE_LineEditContents, option, line)
