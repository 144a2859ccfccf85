"""The map as a picture for a page or a slide."""

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QImage, QPainter

from skinsource_gui.panels.skin.colour_maps import colour_table
from skinsource_gui.panels.skin.colour_scale import paint_colour_scale
from skinsource_gui.panels.skin.map_content import MapContent
from skinsource_gui.panels.skin.map_layout import fitted_beside_palmar, map_layout, outline_bounds
from skinsource_gui.panels.skin.map_painter import MapPainter, small_font
from skinsource_gui.panels.skin.map_words import paint_words
from skinsource_gui.theme import Theme, tabular

# Lines of text in the height of the picture, and the limits of a line, px.
_LINES = 48
_SMALLEST_FONT_PX, _LARGEST_FONT_PX = 9, 64


def map_picture(content: MapContent, width: int, height: int, theme: Theme, family: str) -> QImage:
    """Picture of the map with title, colour bar and, where due, the synthetic mark.

    Parameters
    ----------
    content
        What the map shows.
    width, height
        Of the picture, px.
    theme, family
        Colours, and the family of the font.
    """
    picture = QImage(width, height, QImage.Format.Format_RGB32)
    picture.fill(QColor(theme.base))
    font = QFont(family)
    size = min(height / _LINES, width / _LINES * 1.6)
    font.setPixelSize(round(min(max(size, _SMALLEST_FONT_PX), _LARGEST_FONT_PX)))
    font = tabular(font)
    painter = QPainter(picture)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    line = QFontMetricsF(font).height()
    head = QRectF(line, 0.6 * line, width - 2 * line, 1.5 * line)
    painter.setFont(font)
    painter.setPen(QColor(theme.text))
    painter.drawText(head, Qt.AlignmentFlag.AlignCenter, content.title)
    bar_width = 6.2 * line
    room = QRectF(line, head.bottom(), width - 2 * line - bar_width, height - head.bottom() - line)
    painter.setFont(small_font(font))
    if content.limb_map is not None:
        _paint_map(painter, content, room, theme)
    ramp = QRectF(room.right() + line, room.top() + line, line, room.height() - 2 * line)
    levels = content.range_db
    paint_colour_scale(painter, ramp, levels, levels, colour_table(), theme)
    painter.setFont(font)
    paint_words(painter, content, room, theme)
    painter.end()
    return picture


def _paint_map(painter: QPainter, content: MapContent, room: QRectF, theme: Theme) -> None:
    metrics = QFontMetricsF(painter.font())
    bounds = outline_bounds(content.limb_map)
    frame = fitted_beside_palmar(bounds, room, metrics)
    layout = map_layout(content.limb_map, frame, room, metrics)
    MapPainter(content.limb_map, colour_table()).paint(painter, content, layout, theme)
