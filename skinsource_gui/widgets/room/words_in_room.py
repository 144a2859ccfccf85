"""Buttons whose words are written smaller where there is too little room for them."""

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QFont, QFontInfo, QFontMetrics
from PySide6.QtWidgets import QAbstractButton, QToolButton

from skinsource_gui.theme import scaled

# How much smaller words may be; and large ones, while they are no smaller than so many px.
_SCALES = (1.0, 0.9, 0.8, 0.7, 0.6)
_SCALES_OF_LARGE, _LEAST_PX = (0.55, 0.5, 0.45, 0.4), 12
# Words that can be cut instead are no smaller than this.
_WORTH_READING = 0.7
# Below this they are hard to read: where they can, some go into a row below instead.
_READABLE = 0.8


def fitting_font(rows: Sequence[Sequence[QAbstractButton]], font: QFont, room_px: int) -> QFont:
    """The largest font, of about the size of ``font``, in which each row has room for its words."""
    fonts = fonts_of(font)
    fit = (one for one in fonts if max(width_in(one, row) for row in rows) <= room_px)
    return next(fit, fonts[-1])


def width_in(font: QFont, buttons: Sequence[QAbstractButton]) -> int:
    """Width of buttons that are written in ``font``, px, whatever they are written in now.

    Did it depend on that, words would change to and fro without end.
    """
    metrics = QFontMetrics(font)
    # What the style leaves around words does not depend on them.
    return sum(
        _words_px(one, metrics) + one.sizeHint().width() - _words_px(one, one.fontMetrics())
        for one in buttons
    )


def _words_px(button: QAbstractButton, metrics: QFontMetrics) -> int:
    """What Qt counts as words: around those of a tool button there are blanks as well."""
    words_px = metrics.size(int(Qt.TextFlag.TextShowMnemonic), button.text()).width()
    if isinstance(button, QToolButton):
        words_px += 2 * metrics.horizontalAdvance(" ")
    return words_px


def readable_in(words: str, font: QFont, room_px: float) -> QFont:
    """The largest font in which words have room of those that are not too small to be read.

    For words that may be cut, if they have to be: in the smallest of these.
    """
    fonts = [scaled(font, scale) for scale in _SCALES if scale >= _WORTH_READING]
    fit = (one for one in fonts if QFontMetrics(one).horizontalAdvance(words) <= room_px)
    return next(fit, fonts[-1])


def smallest_of(font: QFont) -> QFont:
    """The smallest font in which words of ``font`` are written."""
    return fonts_of(font)[-1]


def readable_of(font: QFont) -> QFont:
    """The smallest font in which all words of a row shall stand, while there may be another row."""
    return scaled(font, _READABLE)


def write_in(font: QFont, buttons: Sequence[QAbstractButton]) -> None:
    """Have the words of buttons in that font."""
    for one in buttons:
        if one.font() != font:
            one.setFont(font)


def fonts_of(font: QFont) -> list[QFont]:
    """Those in which words of ``font`` may be written, from large to small."""
    large = (scaled(font, scale) for scale in _SCALES_OF_LARGE)
    readable = [one for one in large if QFontInfo(one).pixelSize() >= _LEAST_PX]
    return [*(scaled(font, scale) for scale in _SCALES), *readable]
