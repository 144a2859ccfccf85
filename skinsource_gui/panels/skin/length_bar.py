"""The bar on the skin map that says how long some millimetres are."""

from PySide6.QtCore import QLineF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from skinsource_gui.panels.skin.stage.map_layout import MapLayout
from skinsource_gui.theme import Theme
from skinsource_gui.widgets.map.length_bar import bar_length_mm


def paint_length_bar(painter: QPainter, layout: MapLayout, px_per_mm: float, theme: Theme) -> None:
    """Draw the bar into the lower left corner.

    Parameters
    ----------
    painter
        Its font is that of labels.
    layout
        Where the map lies.
    px_per_mm
        Outline pixels in a millimetre; 0: that is not known, and nothing is drawn.
    """
    on_screen = px_per_mm * layout.frame.scale
    if on_screen <= 0.0:
        return
    length_mm = bar_length_mm(on_screen, layout.room.width())
    line, unit = painter.fontMetrics().height(), layout.unit
    left, bottom = layout.room.left() + 8 * unit, layout.room.bottom() - 6 * unit
    words = f"{length_mm} mm"
    width = max(length_mm * on_screen, painter.fontMetrics().horizontalAdvance(words))
    ground = QColor(theme.base)
    ground.setAlphaF(0.88)
    card = QRectF(left - 4 * unit, bottom - 1.5 * line, width + 8 * unit, 1.5 * line + 3 * unit)
    painter.fillRect(card, ground)
    pen = QPen(QColor(theme.text), 2 * unit)
    pen.setCapStyle(Qt.PenCapStyle.FlatCap)
    painter.setPen(pen)
    painter.drawLine(QLineF(left, bottom, left + length_mm * on_screen, bottom))
    painter.setPen(QColor(theme.text))
    beside = QRectF(left, bottom - 1.4 * line, width, 1.2 * line)
    painter.drawText(beside, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, words)
