"""Buttons whose words are written smaller where there is too little room for them."""

from collections.abc import Sequence

from PySide6.QtGui import QFont, QFontMetrics
from PySide6.QtWidgets import QAbstractButton

from skinsource_gui.theme import scaled

# How much smaller words may be.
_SCALES = (1.0, 0.9, 0.8, 0.7, 0.6)


def fitting_font(rows: Sequence[Sequence[QAbstractButton]], font: QFont, room_px: int) -> QFont:
    """The largest font, of about the size of ``font``, in which each row has room for its words."""
    fonts = [scaled(font, scale) for scale in _SCALES]
    fit = (one for one in fonts if max(width_in(one, row) for row in rows) <= room_px)
    return next(fit, fonts[-1])


def width_in(font: QFont, buttons: Sequence[QAbstractButton]) -> int:
    """Width of buttons that are written in ``font``, px."""
    metrics = QFontMetrics(font)
    # What the style leaves around words does not depend on them.
    return sum(
        metrics.horizontalAdvance(one.text())
        + one.sizeHint().width()
        - one.fontMetrics().horizontalAdvance(one.text())
        for one in buttons
    )


def smallest_of(font: QFont) -> QFont:
    """The smallest font in which words of ``font`` are written."""
    return scaled(font, _SCALES[-1])


def write_in(font: QFont, buttons: Sequence[QAbstractButton]) -> None:
    """Have the words of buttons in that font."""
    for one in buttons:
        if one.font() != font:
            one.setFont(font)
