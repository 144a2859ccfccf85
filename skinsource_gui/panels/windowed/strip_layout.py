"""Where maps, scale and plot of the strip lie."""

from dataclasses import dataclass
from math import ceil

from PySide6.QtCore import QRectF

from skinsource_gui.widgets.map.scale_row import scale_row_px

_MOST_MAP_PX = 190.0
# Of the plot with its words: as many lines as are liked, and those in which three numbers beside it
# can be told apart.
_PLOT_LINES, _LEAST_PLOT_LINES = 6.5, 4.6
# Height of a map over its width: hand and arm.
_HIGH = 2.3
_LEAST_MAP_PX = 70.0


@dataclass(frozen=True, slots=True, kw_only=True)
class StripLayout:
    """Areas of the strip, px.

    Attributes
    ----------
    head
        Words above.
    cells
        Of the windows: a line of words, and the map below.
    scale
        The colours, with a line of numbers and one of words below.
    plot
        The extent, with room for numbers on its left and words above.
    """

    head: QRectF
    cells: tuple[QRectF, ...]
    scale: QRectF
    plot: QRectF


def least_height(line: float) -> float:
    """Height in which maps in one row, scale and plot can be read, with lines of that height."""
    words = 1.4 * line + line + 3 * _edge(line)
    return words + _LEAST_MAP_PX + scale_row_px(line) + _LEAST_PLOT_LINES * line


def strip_layout(room: QRectF, n_windows: int, line: float) -> StripLayout:
    """Lay ``n_windows`` maps out in ``room``, in as many rows as give the largest maps.

    In less than `least_height` all of it is as high as that, and reaches below the room.
    """
    edge = _edge(line)
    high = max(room.height(), least_height(line))
    inner = QRectF(room.left(), room.top(), room.width(), high).adjusted(edge, 0.0, -edge, -edge)
    head = QRectF(inner.left(), inner.top(), inner.width(), 1.4 * line)
    plot_height = min(_PLOT_LINES * line, max(0.3 * inner.height(), _LEAST_PLOT_LINES * line))
    foot = QRectF(inner.left(), inner.bottom() - plot_height, inner.width(), plot_height)
    scale_height = scale_row_px(line)
    scale = QRectF(inner.left(), foot.top() - scale_height - edge, inner.width(), scale_height)
    maps = QRectF(inner.left(), head.bottom(), inner.width(), scale.top() - edge - head.bottom())
    plot = foot.adjusted(3.2 * line, 1.2 * line, -edge, -1.2 * line)
    return StripLayout(head=head, cells=_cells(maps, n_windows, line), scale=scale, plot=plot)


def _edge(line: float) -> float:
    return 0.4 * line


def _cells(room: QRectF, n: int, line: float) -> tuple[QRectF, ...]:
    if n == 0:
        return ()
    rows = max(range(1, n + 1), key=lambda rows: _map_width(room, n, rows, line))
    columns = ceil(n / rows)
    width = min(room.width() / columns, max(_MOST_MAP_PX, 5.5 * line))
    height = room.height() / rows
    left = room.left() + (room.width() - width * columns) / 2.0
    return tuple(
        QRectF(left + width * (k % columns), room.top() + height * (k // columns), width, height)
        for k in range(n)
    )


def _map_width(room: QRectF, n: int, rows: int, line: float) -> float:
    """Width of a map, where there are so many rows; fewer rows where it makes no difference."""
    columns = ceil(n / rows)
    width = min(room.width() / columns, (room.height() / rows - line) / _HIGH)
    return min(width, _MOST_MAP_PX) - 1e-6 * rows if width > 0.0 else -float(rows)
