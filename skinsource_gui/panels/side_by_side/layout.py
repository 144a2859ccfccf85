"""Where maps side by side and their scales lie."""

from dataclasses import dataclass
from math import ceil

from PySide6.QtCore import QRectF

from skinsource_gui.widgets.map.scale_row import scale_row_px

# Height of a map over its width: hand and arm.
_HIGH = 2.3
_LEAST_MAP_PX = 70.0


@dataclass(frozen=True, slots=True, kw_only=True)
class CellPlace:
    """Areas of one map, px.

    Attributes
    ----------
    whole
        All of it.
    heading, value
        Some lines of words, and one.
    map
        Room for the map.
    scale
        Its own scale; empty where all have one in common.
    """

    whole: QRectF
    heading: QRectF
    value: QRectF
    map: QRectF
    scale: QRectF


@dataclass(frozen=True, slots=True, kw_only=True)
class Places:
    """Areas of all maps, px.

    Attributes
    ----------
    head
        A line of words above.
    cells
        Of the maps.
    scale
        The scale of all of them; empty where each has its own.
    """

    head: QRectF
    cells: tuple[CellPlace, ...]
    scale: QRectF


def places_of(room: QRectF, n: int, line: float, *, common: bool, heading_lines: int = 1) -> Places:
    """Lay ``n`` maps out in ``room``, in as many rows as give the largest maps.

    Parameters
    ----------
    room
        In which.
    n
        How many maps.
    line
        Height of a line of words.
    common
        Whether one scale serves all of them.
    heading_lines
        How many lines the heading of each has; below it is one for a value.
    """
    edge = 0.3 * line
    scale_height = scale_row_px(line)
    inner = room.adjusted(edge, 0.0, -edge, -edge)
    head = QRectF(inner.left(), inner.top(), inner.width(), 1.2 * line)
    foot = scale_height if common else 0.0
    scale = QRectF(inner.left(), inner.bottom() - foot, inner.width(), foot)
    maps = QRectF(inner.left(), head.bottom(), inner.width(), scale.top() - head.bottom())
    beside = (heading_lines + 1.0) * line + (0.0 if common else scale_height) + edge
    rows = _rows(maps, n, beside)
    columns = ceil(n / rows) if n else 1
    width, height = maps.width() / columns, maps.height() / rows
    cells = tuple(
        _cell(
            QRectF(
                maps.left() + width * (k % columns),
                maps.top() + height * (k // columns),
                width,
                height,
            ),
            line,
            0.0 if common else scale_height,
            heading_lines * line,
        )
        for k in range(n)
    )
    return Places(head=head, cells=cells, scale=scale)


def least_height(line: float) -> float:
    """Height in which maps in one row can be told apart, with lines of that height."""
    return 1.2 * line + 3.0 * line + 0.9 * line + scale_row_px(line) + _LEAST_MAP_PX


def _rows(room: QRectF, n: int, beside: float) -> int:
    """In how many rows maps are largest; as few as give that."""

    def map_width(rows: int) -> float:
        wide = room.width() / ceil(n / rows)
        return min(wide, (room.height() / rows - beside) / _HIGH) - 1e-6 * rows

    return max(range(1, n + 1), key=map_width, default=1)


def _cell(whole: QRectF, line: float, scale_height: float, heading: float) -> CellPlace:
    top = whole.top() + heading + line
    bottom = whole.bottom() - scale_height
    edge = 0.3 * line
    return CellPlace(
        whole=whole,
        heading=QRectF(whole.left(), whole.top(), whole.width(), heading),
        value=QRectF(whole.left(), whole.top() + heading, whole.width(), line),
        map=QRectF(whole.left() + edge, top, whole.width() - 2 * edge, bottom - top - edge),
        scale=QRectF(whole.left(), bottom, whole.width(), scale_height),
    )
