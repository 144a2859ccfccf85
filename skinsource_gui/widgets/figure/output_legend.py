"""Which colour is which output: a line above a figure."""

from PySide6.QtCore import QLineF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter

from skinsource_gui.theme import Theme

_STROKE_PX, _WIDE_PX, _GAP_PX = 3.0, 12.0, 5.0


def legend_words(outputs: tuple[int, ...], room_px: float, painter: QPainter) -> list[str]:
    """Its head, numbers of the outputs, and how many more there is no room for."""
    head = "Output" if len(outputs) == 1 else "Outputs"
    numbers = [str(one) for one in outputs]
    for count in range(len(numbers), 0, -1):
        left = len(numbers) - count
        words = [head, *numbers[:count], *([f"+{left}"] if left else [])]
        if _wide(words, painter) <= room_px:
            return words
    return numbers[:1]


def draw_legend(
    painter: QPainter,
    room: QRectF,
    outputs: tuple[int, ...],
    theme: Theme,
    *,
    broken: bool = False,
) -> None:
    """Numbers of outputs, each behind a stroke of its colour, in one line.

    ``broken``: lines of the figure are, where colours begin again, and so are these strokes.
    """
    metrics, at = painter.fontMetrics(), room.left()
    words = legend_words(outputs, room.width(), painter)
    ranks = dict(zip(map(str, outputs), range(len(outputs)), strict=True))
    for word in words:
        if word in ranks:
            rank = ranks[word] if broken else ranks[word] % len(theme.outputs)
            pen = theme.output_pen(rank, _STROKE_PX)
            pen.setCapStyle(Qt.PenCapStyle.FlatCap)
            painter.setPen(pen)
            painter.drawLine(QLineF(at, room.center().y(), at + _WIDE_PX, room.center().y()))
            at += _WIDE_PX + _GAP_PX
        wide = float(metrics.horizontalAdvance(word))
        painter.setPen(QColor(theme.text))
        painter.drawText(
            QRectF(at, room.top(), wide + 1.0, room.height()), Qt.AlignmentFlag.AlignVCenter, word
        )
        at += wide + 2.0 * _GAP_PX


def _wide(words: list[str], painter: QPainter) -> float:
    metrics = painter.fontMetrics()
    strokes = (_WIDE_PX + _GAP_PX) * sum(word.isdigit() for word in words)
    return strokes + sum(metrics.horizontalAdvance(word) + 2.0 * _GAP_PX for word in words)
