"""Where everything is in the head of a track."""

from dataclasses import dataclass

from PySide6.QtCore import QRect, QRectF

from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.inputs.swatch import SWATCH_PX

#: Height of a row.
ROW_PX = 48
#: Width of a head; height of a line of text at which sizes are as written here, px.
HEADS_PX, USUAL_LINE_PX = 196, 14
# Heads of larger text leave the lanes room too.
_MOST_HEADS_PX = 320
_LINE_PX, _FIRST_LINE_PX = 20, 3
_AMPLITUDE_PX, _GAIN_PX = 90, 54
_BETWEEN_PX = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class RowPlaces:
    """Where the parts of a head are, px.

    Attributes
    ----------
    row
        All of it.
    swatch, name
        Place and its name, which are painted.
    amplitude, mute, solo, remove
        The controls.
    peak
        The peak that results from a gain, painted beside it.
    words
        What has to be painted anew when the words change.
    """

    row: QRect
    swatch: QRectF
    name: QRect
    amplitude: QRect
    mute: QRect
    solo: QRect
    remove: QRect
    peak: QRect
    words: QRect


def heads_px(line_px: int) -> int:
    """Width of heads where a line of text is so high, px."""
    return min(round(HEADS_PX * max(line_px / USUAL_LINE_PX, 1.0)), _MOST_HEADS_PX)


def row_places(width: int, line_px: int = USUAL_LINE_PX, *, peak: bool = False) -> RowPlaces:
    """Places in a head, in two lines.

    Parameters
    ----------
    width
        Of the head, px.
    line_px
        Height of a line of text; where it is larger than usual, so is the head.
    peak
        Whether a peak stands beside the amplitude.
    """
    scale = max(line_px / USUAL_LINE_PX, 1.0)

    def px(usual: int) -> int:
        return round(scale * usual)

    height, line, swatch = px(ROW_PX), px(_LINE_PX), px(SWATCH_PX)
    text_left = UNIT_PX + swatch + UNIT_PX
    first = px(_FIRST_LINE_PX)
    second = first + line + 2
    step, right = line + _BETWEEN_PX, width - UNIT_PX // 2
    solo, mute = (QRect(right - step * count, first, line, line) for count in (1, 2))
    remove = QRect(right - step, second, line, line)
    amplitude_px = px(_GAIN_PX if peak else _AMPLITUDE_PX)
    amplitude_px = min(amplitude_px, remove.x() - text_left - UNIT_PX // 2)
    peak_left = text_left + amplitude_px + UNIT_PX // 2
    return RowPlaces(
        row=QRect(0, 0, width, height),
        swatch=QRectF(UNIT_PX, (height - swatch) / 2, swatch, swatch),
        name=QRect(text_left, first, mute.x() - text_left - _BETWEEN_PX, line),
        amplitude=QRect(text_left, second, amplitude_px, line + 1),
        mute=mute,
        solo=solo,
        remove=remove,
        peak=QRect(peak_left, second, remove.x() - peak_left, line + 1),
        words=QRect(0, 0, remove.x() if peak else mute.x(), height),
    )
