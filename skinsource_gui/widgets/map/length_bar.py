"""A bar on a map that says how long some millimetres are."""

from PySide6.QtCore import QLineF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen

from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.theme import Theme, scaled
from skinsource_gui.widgets.map.small_map import SmallMap, small_frame
from skinsource_gui.widgets.paper import is_on_paper

_LENGTHS_MM = (100, 50, 20, 10, 5, 2, 1)
# It takes at most this part of the width.
_MOST = 0.25
# Its words on small maps, in usual sizes.
_WORDS = 0.8


def bar_length_mm(px_per_mm: float, width_px: float) -> int:
    """The longest round length that fits, mm."""
    fitting = (length for length in _LENGTHS_MM if length * px_per_mm <= _MOST * width_px)
    return next(fitting, _LENGTHS_MM[-1])


def paint_small_bar(
    painter: QPainter, area: QRectF, shown: SmallMap, limb: str, theme: Theme
) -> None:
    """Draw the bar of a small map, on paper alone, into the lower right corner of its ``area``.

    On the screen small maps are looked at, not measured.  Nothing is drawn where it is not known
    how long the hand of the ``limb`` is.
    """
    length_mm = facts_of(limb).hand_length_mm
    if not is_on_paper() or length_mm <= 0.0:
        return
    limb_map = shown.limb_map
    px_per_mm = small_frame(limb_map, area).scale * limb_map.hand_length_px / length_mm
    bar_mm = bar_length_mm(px_per_mm, area.width())
    words, plain = f"{bar_mm} mm", painter.font()
    painter.setFont(scaled(plain, _WORDS))
    metrics = QFontMetricsF(painter.font())
    width, wide = bar_mm * px_per_mm, metrics.horizontalAdvance(words)
    middle = area.right() - max(width, wide) / 2 - 2.0
    bottom = area.bottom() - 2.0
    above = QRectF(middle - wide / 2 - 1.0, 0.0, wide + 2.0, metrics.height())
    above.moveBottom(bottom - 1.0)
    # Where it lies on the arm it is read all the same.
    ground = QColor(theme.base)
    ground.setAlphaF(0.88)
    painter.fillRect(above, ground)
    pen = QPen(QColor(theme.text), 2.0)
    pen.setCapStyle(Qt.PenCapStyle.FlatCap)
    painter.setPen(pen)
    painter.drawLine(QLineF(middle - width / 2, bottom, middle + width / 2, bottom))
    painter.drawText(above, Qt.AlignmentFlag.AlignCenter, words)
    painter.setFont(plain)
