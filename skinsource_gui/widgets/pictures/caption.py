"""What stands below a picture: the stimulus that it belongs to, and what it is not good for."""

from collections.abc import Callable, Sequence
from functools import partial
from math import ceil

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter

from skinsource.base.quoting import sentence
from skinsource.design.design import Design
from skinsource.design.labels import SCALINGS, limb_word, word_of
from skinsource.studies import scenes
from skinsource_gui.theme import LIGHT, Theme
from skinsource_gui.widgets.fields.level_text import minus
from skinsource_gui.widgets.pictures.picture_file import Draw
from skinsource_gui.widgets.pictures.stimulus_words import (
    BREAKS,
    Named,
    common_title,
    stimuli_words,
)

# Height of its letters, as a part of the smaller side of the picture, and their limits, px.
_PART, _SMALLEST_PX, _LARGEST_PX = 1 / 45, 8, 40
# It takes this part of the height, or its letters are smaller; as small as can be read it may take
# the larger part, and where that is too little, they are smaller still.
_PART_OF_HEIGHT, _MOST_OF_HEIGHT, _LEAST_PX = 0.16, 0.3, 5


def caption_of(
    design: Design,
    *,
    compared: Sequence[Named] = (),
    limbs: Sequence[str] = (),
    notes: Sequence[str] = (),
) -> str:
    """The stimulus in words, and the limb: what is heard, where, how strong.

    Parameters
    ----------
    design
        What is played.
    compared
        Designs that are shown side by side, with what they are called there; none: ``design`` is
        shown alone.
    limbs
        Names of limbs on which something is shown beside the design's own.
    notes
        Sentences on these limbs, and on what it is not good for; see
        `skinsource.perception.validity`.
    """
    named = compared or [("", design)]
    designs = [one for _, one in named]
    title = common_title([scenes.title_of(one) if one.title else "" for one in designs])
    first = f"{sentence(title)} " if title else ""
    scalings = dict.fromkeys(word_of(SCALINGS, one.scaling).title.lower() for one in designs)
    titles = [limb_word(one).title for one in dict.fromkeys((*(d.limb for d in designs), *limbs))]
    limb = f"Limb{'s' if len(titles) > 1 else ''}: {', '.join(titles)}"
    through = dict.fromkeys(one.actuated.words for one in designs if one.actuated is not None)
    driven = f"; predicted through {', '.join(through)}" if through else ""
    said_last = "".join(f" {one}" for one in notes)
    scaling = ", ".join(scalings)
    return minus(f"{first}{stimuli_words(named)}. {limb}; scaling: {scaling}{driven}.{said_last}")


def lines_of(words: str, metrics: QFontMetricsF, room_px: float) -> list[str]:
    """Break ``words`` into lines that have room; a number and its unit stay together."""
    lines: list[str] = []
    for part in BREAKS.split(words):
        longer = f"{lines[-1]} {part}" if lines else part
        if lines and metrics.horizontalAdvance(longer) <= room_px:
            lines[-1] = longer
        else:
            lines.append(part)
    return lines


def with_caption(draw: Draw, words: str) -> Draw:
    """Return what draws a picture with ``words`` below; without any, all of it is the picture."""
    return partial(_draw, draw, words) if words else draw


def caption_px(words: str, width: int, height: int) -> int:
    """How much higher a page is than a picture of this size, so that ``words`` have room below."""
    if not words:
        return 0
    font, more = QFont(), 0
    for _ in range(4):
        # Letters and edges grow with the page, a little less each time.
        edge = _edge_px(width, height + more)
        font.setPixelSize(_letters_px(width, height + more))
        lines = lines_of(words, QFontMetricsF(font), width - 2 * edge)
        more = ceil(_height(lines, font) + 1.5 * edge)
    return more


def _draw(
    draw: Callable[..., None],
    words: str,
    painter: QPainter,
    width: int,
    height: int,
    theme: Theme = LIGHT,
) -> None:
    lines, font, left, edge = _laid_out(words, painter.font(), width, height)
    painter.fillRect(QRectF(0, 0, width, height), QColor(theme.base))
    painter.save()
    draw(painter, width, left, theme=theme)
    painter.restore()
    painter.setFont(font)
    painter.setPen(QColor(theme.dim))
    # Line by line: on a page of more dots lines of a text would stand a little further apart.
    metrics = QFontMetricsF(font)
    first = left + edge / 2 + metrics.ascent()
    for row, line in enumerate(lines):
        painter.drawText(QPointF(edge, first + row * metrics.lineSpacing()), line)


def height_above(words: str, font: QFont, width: int, height: int) -> int:
    """What `with_caption` leaves of the height for the picture itself."""
    return _laid_out(words, font, width, height)[2] if words else height


def _laid_out(
    words: str, font: QFont, width: int, height: int
) -> tuple[list[str], QFont, int, float]:
    """Lines and letters of the caption, where it begins, and its edge; px."""
    font = QFont(font)
    edge = _edge_px(width, height)
    room_px = width - 2 * edge
    font.setPixelSize(_letters_px(width, height))
    lines = lines_of(words, QFontMetricsF(font), room_px)
    for part, least_px in ((_PART_OF_HEIGHT, _SMALLEST_PX), (_MOST_OF_HEIGHT, _LEAST_PX)):
        while _height(lines, font) > part * height and font.pixelSize() > least_px:
            font.setPixelSize(font.pixelSize() - 1)
            lines = lines_of(words, QFontMetricsF(font), room_px)
    while _height(lines, font) > _MOST_OF_HEIGHT * height and len(words) > 1:
        words = f"{words[: int(0.9 * len(words)) - 1].rstrip('…')}…"
        lines = lines_of(words, QFontMetricsF(font), room_px)
    left = max(int(height - _height(lines, font) - 1.5 * edge), 1)
    return lines, font, left, edge


def _edge_px(width: float, height: float) -> float:
    return 0.02 * min(width, height)


def _letters_px(width: float, height: float) -> int:
    return min(max(round(min(width, height) * _PART), _SMALLEST_PX), _LARGEST_PX)


def _height(lines: Sequence[str], font: QFont) -> float:
    return len(lines) * QFontMetricsF(font).lineSpacing()
