"""Words that are written smaller where there is too little room for them."""

from collections.abc import Sequence

from PySide6.QtGui import QFont, QFontMetricsF

from skinsource_gui.theme import scaled

# No smaller than that part of the letters around them.
_LEAST = 0.4


def shrunk(font: QFont, words: Sequence[str], room_px: float) -> QFont:
    """The font, or a smaller one, in which each of some words has room: numbers are not cut."""
    widest = max((QFontMetricsF(font).horizontalAdvance(one) for one in words), default=0.0)
    return scaled(font, max(room_px / widest, _LEAST)) if widest > room_px else font
