"""Which part of a clip the pointer is on."""

from enum import Enum

from PySide6.QtCore import QPointF, QRectF, Qt

_EDGE_PX, _CORNER_PX = 6.0, 11.0
# A clip narrower than this is only moved by its inside; its ends are caught from beside it.
_NARROW_PX = 26.0


class Part(Enum):
    """Parts that are dragged to different ends."""

    BODY = "body"
    START = "start"
    END = "end"
    FADE_IN = "fade in"
    FADE_OUT = "fade out"


CURSORS = {
    Part.BODY: Qt.CursorShape.OpenHandCursor,
    Part.START: Qt.CursorShape.SizeHorCursor,
    Part.END: Qt.CursorShape.SizeHorCursor,
    Part.FADE_IN: Qt.CursorShape.SizeFDiagCursor,
    Part.FADE_OUT: Qt.CursorShape.SizeBDiagCursor,
}


def part_at(rect: QRectF, at: QPointF, fades_px: tuple[float, float] = (0.0, 0.0)) -> Part:
    """The part of a clip painted in ``rect`` that lies at ``at``.

    Its fades are caught where they end, ``fades_px`` from its ends.
    """
    from_start, from_end = at.x() - rect.left(), rect.right() - at.x()
    if from_start < 0 or from_end < 0:
        return Part.START if from_start < 0 else Part.END
    if rect.width() < _NARROW_PX:
        return Part.BODY
    if at.y() - rect.top() < _CORNER_PX:
        for part, away, reach in (
            (Part.FADE_IN, from_start, fades_px[0]),
            (Part.FADE_OUT, from_end, fades_px[1]),
        ):
            if max(reach - _CORNER_PX / 2, 0.0) <= away < reach + _CORNER_PX:
                return part
    if from_start < _EDGE_PX:
        return Part.START
    return Part.END if from_end < _EDGE_PX else Part.BODY
