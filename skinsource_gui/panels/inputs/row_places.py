"""Where everything is in a row of the list of inputs."""

from dataclasses import dataclass

from PySide6.QtCore import QRect, QRectF

from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.inputs.letter_button import BUTTON_PX
from skinsource_gui.widgets.inputs.swatch import SWATCH_PX

#: Height of a row; it is lower where everything stands in one line of columns.
ROW_PX, LOW_ROW_PX = 48, 36
#: From this width on, everything stands in one line of columns.
WIDE_PX = 420

#: Height of a line of text at which sizes are as written here, px.
USUAL_LINE_PX = 14
_LINE_PX, _LOW_LINE_PX = 20, 16
_FIRST_LINE_PX = 3
_TEXT_LEFT_PX = UNIT_PX + SWATCH_PX + UNIT_PX
# Room for the words of most inputs.
_TEXT_PX = 172
_AMPLITUDE_PX, _AMPLITUDE_HIGH_PX = 90, 26
_PREVIEW_PX = 64
_BETWEEN_BUTTONS_PX = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class RowPlaces:
    """Where the parts of a row are, px.

    Attributes
    ----------
    row
        All of it.
    swatch, name, figure
        Place, its name, and what is played, which are painted.
    preview, amplitude, mute, solo, remove
        The controls.
    words
        What has to be painted anew when the words change.
    """

    row: QRect
    swatch: QRectF
    name: QRect
    figure: QRect
    preview: QRect
    amplitude: QRect
    mute: QRect
    solo: QRect
    remove: QRect
    words: QRect


def row_places(width: int, line_px: int = USUAL_LINE_PX) -> RowPlaces:
    """Places in a row: in one line of columns if it is wide, else in two.

    Parameters
    ----------
    width
        Of the row, px.
    line_px
        Height of a line of text; where it is larger than usual, so is the row.
    """
    scale = max(line_px / USUAL_LINE_PX, 1.0)

    def px(usual: int) -> int:
        return round(scale * usual)

    wide = width >= px(WIDE_PX)
    first_line = px(_FIRST_LINE_PX)
    height = px(LOW_ROW_PX if wide else ROW_PX)
    line = px(_LOW_LINE_PX if wide else _LINE_PX)
    button = px(BUTTON_PX if wide else _LINE_PX)
    button_top = (height - button) // 2 if wide else first_line
    step = button + _BETWEEN_BUTTONS_PX
    remove, solo, mute = (
        QRect(width - UNIT_PX - step * count, button_top, button, button) for count in (1, 2, 3)
    )
    amplitude_px = px(_AMPLITUDE_PX)
    if wide:
        left = mute.x() - UNIT_PX - amplitude_px
        high = px(_AMPLITUDE_HIGH_PX)
        amplitude = QRect(left, (height - high) // 2, amplitude_px, high)
        right = left - UNIT_PX
        preview_px = max(_PREVIEW_PX, right - _TEXT_LEFT_PX - px(_TEXT_PX))
        preview = QRect(right - preview_px, 5, preview_px, height - 10)
        words_end = preview.x()
    else:
        left, top = width - UNIT_PX - amplitude_px, first_line + line + 2
        amplitude = QRect(left, top, amplitude_px, line + 1)
        left = mute.x() - UNIT_PX - _PREVIEW_PX
        preview = QRect(left, first_line, _PREVIEW_PX, line)
        # The preview stands above the field, and not so far to the right.
        words_end = amplitude.x()
    name_px = preview.x() - UNIT_PX - _TEXT_LEFT_PX
    figure_px = words_end - UNIT_PX - _TEXT_LEFT_PX
    return RowPlaces(
        row=QRect(0, 0, width, height),
        swatch=QRectF(UNIT_PX, (height - SWATCH_PX) / 2, SWATCH_PX, SWATCH_PX),
        name=QRect(_TEXT_LEFT_PX, first_line, name_px, line),
        figure=QRect(_TEXT_LEFT_PX, first_line + line, figure_px, line),
        preview=preview,
        amplitude=amplitude,
        mute=mute,
        solo=solo,
        remove=remove,
        words=QRect(0, 0, words_end, height),
    )
