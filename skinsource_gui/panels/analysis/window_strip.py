"""The strip of consecutive windows: its content, layout, painter and widget."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import ceil

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal

from skinsource.base.arrays import Floats
from skinsource.design.design import Design, audible_inputs
from skinsource.limbs.extent import Extent
from skinsource.signals.analysis.windows import Windows
from skinsource_gui.fields.inputs import duration_text
from skinsource_gui.fields.units import axis_unit
from skinsource_gui.plots.colour_maps import colour_table
from skinsource_gui.plots.small_map import (
    LEAST_MAP_PX,
    USUAL_STYLE,
    ColourScale,
    LevelStyle,
    SmallMap,
    map_grid,
    paint_scale_row,
    paint_small_bar,
    paint_small_map,
    scale_of_levels,
    scale_row_px,
    with_matched,
)
from skinsource_gui.qt.frames import paint_focus_frame
from skinsource_gui.qt.theme import Theme, current_theme, tabular


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WindowedContent:
    """Maps of windows, and how far each of them reaches.

    Attributes
    ----------
    design
        Its inputs are marked on the maps.
    small
        Outline, places and pixels that all maps share.
    windows, sample_rate_hz
        Where the windows lie.
    levels_db : (n_windows, n_outputs)
        Level of each output in each window.
    field_levels_db : (n_windows, rows, columns)
        The interpolated maps.
    extents
        Of each window; None where it is silent.
    noisy, in_noise
        Outputs of each window that are mostly noise, and whether all of them are.
    synthetic
        Whether the responses are computed, not measured.
    traces_delay_s
        How much later the traces show the same, s; 0 where their delay is removed.
    matched
        By how much levels are louder or softer than they were stored, or "".
    look
        Colours and range of the skin map.
    """

    design: Design
    small: SmallMap
    windows: Windows
    sample_rate_hz: float
    levels_db: Floats
    field_levels_db: Floats
    extents: tuple[Extent | None, ...]
    synthetic: bool
    noisy: tuple[tuple[int, ...], ...] = ()
    in_noise: tuple[bool, ...] = ()
    traces_delay_s: float = 0.0
    matched: str = ""
    look: LevelStyle = USUAL_STYLE

    @property
    def begin_phrases(self) -> tuple[str, ...]:
        """Texts that say what stands above the maps, the longest first."""
        length = duration_text(self.windows.window_samples / self.sample_rate_hz)
        unit, _ = axis_unit(self.bounds_s[-1][1])
        whole = f"Windows of {length}; above each when it begins, in {unit} of the stimulus"
        short, later = f"{length} each, begins in {unit}", f"; traces +{self._delay}"
        if not self.traces_delay_s:
            return whole, short, unit
        whole_later = f"{whole}; the traces show it about {self._delay} later"
        return whole_later, f"{short}{later}", f"{length} each{later}", unit

    @property
    def _delay(self) -> str:
        return f"{self.traces_delay_s * 1e3:.0f} ms"

    @property
    def shown_extents(self) -> tuple[Extent | None, ...]:
        """Extents of the windows, None where a window is silent or mostly noise."""
        if not any(self.in_noise):
            return self.extents
        pairs = zip(self.extents, self.in_noise, strict=True)
        return tuple(None if in_noise else extent for extent, in_noise in pairs)

    def extent_text(self, window: int) -> str:
        """Return the measures of a window, for a tooltip."""
        if self.in_noise and self.in_noise[window]:
            return "Mostly noise of the measurement: its extent means nothing"
        return _extent_text(self.extents[window], self.origin)

    @property
    def origin(self) -> str:
        """Origin of the distances."""
        places = {track.location for track in audible_inputs(self.design.inputs)}
        return "the nearest input" if len(places) > 1 else "the input"

    @property
    def scale(self) -> ColourScale:
        """The colour scale of all maps."""
        return with_matched(scale_of_levels(self.levels_db, self.look), self.matched)

    @property
    def bounds_s(self) -> list[tuple[float, float]]:
        """Begin and end of each window, s from the begin of the stimulus."""
        return self.windows.bounds_s(self.sample_rate_hz)

    def map_of(self, window: int) -> SmallMap:
        """Return the map of one window."""
        return replace(
            self.small,
            levels_db=self.levels_db[window],
            field_levels_db=self.field_levels_db[window],
            noisy=self.noisy[window] if self.noisy else (),
        )

    def window_at(self, time_s: float) -> int | None:
        """Return the window in which an instant of the stimulus lies."""
        for window, (begin_s, end_s) in enumerate(self.bounds_s):
            if begin_s <= time_s < end_s:
                return window
        return None


def window_text(bounds_s: tuple[float, float], until_s: float) -> str:
    """Return ``"0–120 ms"``, or seconds where the last window ends at 1 s or later."""
    begin, end = (time_number(bound_s, until_s) for bound_s in bounds_s)
    return f"{begin}–{end} {axis_unit(until_s)[0]}"


def time_number(time_s: float, until_s: float) -> str:
    """Return a time to the millisecond, in the unit of times up to ``until_s``."""
    in_s = axis_unit(until_s)[0] == "s"
    return f"{time_s:.3f}".rstrip("0").rstrip(".") if in_s else f"{1e3 * time_s:.0f}"


def _extent_text(extent: Extent | None, origin: str) -> str:
    if extent is None:
        return "No active input"
    return (
        f"Mean distance from {origin} {extent.mean_distance_mm:.1f} mm\n"
        f"90 % of the energy within {extent.d90_mm:.1f} mm\n"
        f"Outputs less than 12 dB below the loudest {100 * extent.share_above_12_db:.0f} %, "
        f"20 dB {100 * extent.share_above_20_db:.0f} %\n"
        f"Participation {extent.participation:.1f} outputs"
    )


def window_titles(
    bounds_s: Sequence[tuple[float, float]],
    cells: Sequence[QRectF],
    width_of: Callable[[str], float],
) -> tuple[str, ...]:
    """Return when each window begins; where maps are narrow, only every n-th says it.

    Parameters
    ----------
    bounds_s
        Begin and end of each, s.
    cells
        Where the maps are, row by row.
    width_of
        Width of words, px.
    """
    if not cells:
        return ()
    begins = tuple(time_number(begin, bounds_s[-1][1]) for begin, _ in bounds_s)
    least = min(cell.width() for cell in cells)
    widest = max(map(width_of, begins)) + width_of(" ")
    step = next(n for n in range(1, len(cells) + 1) if widest <= n * least or n == len(cells))
    columns = sum(cell.top() == cells[0].top() for cell in cells)
    return tuple(begin if k % columns % step == 0 else "" for k, begin in enumerate(begins))


def windows_heading(content: WindowedContent, width_of: Callable[[str], float], room: float) -> str:
    """Return the longest text on the times of the windows that fits into ``room``, or ""."""
    return next((phrase for phrase in content.begin_phrases if width_of(phrase) <= room), "")


_MOST_MAP_PX = 190.0
# Usual height of the plot, in lines of text, and the least at which its three numbers are legible.
_PLOT_LINES, _LEAST_PLOT_LINES = 6.5, 4.6


@dataclass(frozen=True, slots=True, kw_only=True)
class StripLayout:
    """Areas of the strip, px.

    Attributes
    ----------
    head
        Text above.
    cells
        Of the windows: a line of text, and the map below.
    scale
        The colours, with a line of numbers and one of text below.
    plot
        The extent, with room for numbers on its left and text above.
    """

    head: QRectF
    cells: tuple[QRectF, ...]
    scale: QRectF
    plot: QRectF


def least_height(line: float) -> float:
    """Return the height in which one row of maps, scale and plot can be read."""
    text_px = 1.4 * line + line + 3 * _edge(line)
    return text_px + LEAST_MAP_PX + scale_row_px(line) + _LEAST_PLOT_LINES * line


def strip_layout(room: QRectF, n_windows: int, line: float) -> StripLayout:
    """Lay ``n_windows`` maps out in ``room``, in the number of rows that gives the largest maps.

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
    most_cell_px = max(_MOST_MAP_PX, 5.5 * line)
    cells = map_grid(maps, n_windows, line, most_px=_MOST_MAP_PX, most_cell_px=most_cell_px)
    return StripLayout(head=head, cells=cells, scale=scale, plot=plot)


def _edge(line: float) -> float:
    return 0.4 * line


_DOT_PX = 2.5
# Marks of inputs at fingertips reach beyond the map.
_RING_PX = 4.0
_CENTRE = Qt.AlignmentFlag.AlignCenter
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
#: Names of the curves of the extent, and shorter ones; each has the colour of an output.
CURVES = (("mean distance", "90 % of the energy within"), ("mean", "90 %"))


def paint_strip(
    painter: QtGui.QPainter,
    content: WindowedContent,
    layout: StripLayout,
    theme: Theme,
    chosen: int | None = None,
) -> None:
    """Draw ``content`` in the painter's font.

    Parameters
    ----------
    painter, layout, theme
        On what, where, in which colours.
    content
        What is shown.
    chosen
        The window that is framed; None: none is.
    """
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    line = float(painter.fontMetrics().height())
    scale = content.scale
    table = colour_table(scale.colours)
    width_of = painter.fontMetrics().horizontalAdvance
    titles = window_titles(content.bounds_s, layout.cells, width_of)
    for window, (cell, title) in enumerate(zip(layout.cells, titles, strict=True)):
        painter.setPen(QtGui.QColor(theme.text))
        # A begin that stands for several windows may be wider than its map.
        middle = QRectF(cell.left(), cell.top(), cell.width(), line)
        painter.drawText(middle, _CENTRE | Qt.TextFlag.TextDontClip, title)
        area = cell.adjusted(2.0, line + _RING_PX, -2.0, -2.0)
        paint_small_map(
            painter, area, content.map_of(window), content.design, theme, scale.range_db, table
        )
        if window == len(titles) - 1:  # all maps have the same scale
            limb = content.design.limb
            paint_small_bar(painter, area, content.map_of(window), limb, theme)
        if window == chosen:
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 1.5))
            painter.drawRoundedRect(cell.adjusted(1.0, 0.5, -1.0, -1.0), 3.0, 3.0)
    paint_scale_row(painter, layout.scale, scale, theme)
    _paint_extent(painter, layout.plot, content, theme)


def _paint_extent(
    painter: QtGui.QPainter, area: QRectF, content: WindowedContent, theme: Theme
) -> None:
    """Paint mean distance and the distance of 90 % of the energy, a dot for each window."""
    extents = [extent for extent in content.shown_extents if extent is not None]
    top = _rounded_up(
        max((max(extent.mean_distance_mm, extent.d90_mm) for extent in extents), default=1.0)
    )
    line = painter.fontMetrics().height()
    _paint_axis(painter, area, top, content.origin, theme)
    n = max(len(content.extents), 1)
    for rank in range(2):
        colour = theme.output_colour(rank)
        painter.setPen(QtGui.QPen(colour, 1.5))
        painter.setBrush(colour)
        before: QPointF | None = None
        for window, extent in enumerate(content.shown_extents):
            if extent is None:
                before = None
                continue
            value = extent.mean_distance_mm if rank == 0 else extent.d90_mm
            x = area.left() + (window + 0.5) / n * area.width()
            at = QPointF(x, area.bottom() - value / top * area.height())
            if before is not None:
                painter.drawLine(before, at)
            painter.drawEllipse(at, _DOT_PX, _DOT_PX)
            before = at
    x, metrics = area.left(), painter.fontMetrics()
    for rank, name in enumerate(curve_names(area.width(), metrics.horizontalAdvance, line)):
        painter.setPen(theme.output_colour(rank))
        room = metrics.horizontalAdvance(name) + line
        painter.drawText(QRectF(x, area.top() - 1.2 * line, room, line), Qt.AlignmentFlag(0), name)
        x += room


def curve_names(room: float, width_of: Callable[[str], float], gap: float) -> tuple[str, str]:
    """Return the names of the curves, or shorter ones where these do not fit."""
    names, shorter = CURVES
    return names if sum(map(width_of, names)) + gap <= room else shorter


def _paint_axis(
    painter: QtGui.QPainter, area: QRectF, top: float, origin: str, theme: Theme
) -> None:
    line = painter.fontMetrics().height()
    for part in (0.0, 0.5, 1.0):
        y = area.bottom() - part * area.height()
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.grid), 1))
        painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y))
        painter.setPen(QtGui.QColor(theme.text))
        beside = QRectF(area.left() - 3.2 * line, y - line / 2.0, 2.9 * line, line)
        painter.drawText(beside, _RIGHT, f"{part * top:g}")
    painter.setPen(QtGui.QColor(theme.dim))
    below = QRectF(area.left(), area.bottom() + 0.15 * line, area.width(), line)
    text = f"mm from {origin}"
    fits = painter.fontMetrics().horizontalAdvance(text) <= below.width()
    painter.drawText(below, _CENTRE, text if fits else "mm")


def _rounded_up(value: float) -> float:
    """Return the next multiple of 20 mm."""
    return max(ceil(value / 20.0) * 20.0, 20.0)


_SYNTHETIC = "SYNTHETIC"
_STEPS = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}


class StripView(QtWidgets.QWidget):
    """Shows windows, and tells which one is chosen."""

    #: Begin of a window that was chosen, s.
    time_chosen = Signal(float)

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self.content: WindowedContent | None = None
        self.message = ""
        self.chosen: int | None = None
        self.setObjectName("window_strip")
        self.setAccessibleName("Windows")
        self.setAccessibleDescription("Left and right go from window to window")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    def sizeHint(self) -> QSize:
        return QSize(520, 460)

    def minimumSizeHint(self) -> QSize:
        return QSize(220, ceil(least_height(self.fontMetrics().height())))

    @property
    def places(self) -> StripLayout:
        """Where the parts of the strip lie."""
        n = 0 if self.content is None else self.content.windows.count
        return strip_layout(QRectF(self.rect()), n, self.fontMetrics().height())

    def show_content(self, content: WindowedContent | None, message: str = "") -> None:
        """Show windows, or a message instead of them."""
        self.content, self.message = content, message
        self.update()

    def show_time(self, time_s: float) -> None:
        """Frame the window in which the playhead is."""
        chosen = None if self.content is None else self.content.window_at(time_s)
        if chosen != self.chosen:
            self.chosen = chosen
            self.update()

    def window_under(self, point: QPointF) -> int | None:
        """Return the window under a point."""
        cells = enumerate(self.places.cells)
        return next((window for window, cell in cells if cell.contains(point)), None)

    @property
    def head_text(self) -> str:
        """The text above the strip: what its times are, as long as fits."""
        if self.content is None or self.message:
            return ""
        metrics = QtGui.QFontMetrics(tabular(self.font()))
        room = self.places.head.width() - metrics.height()
        if self.content.synthetic:
            room -= metrics.horizontalAdvance(_SYNTHETIC)
        return windows_heading(self.content, metrics.horizontalAdvance, room)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter, theme = QtGui.QPainter(self), current_theme()
        painter.setFont(tabular(self.font()))
        painter.fillRect(self.rect(), QtGui.QColor(theme.base))
        if self.content is None or self.message:
            painter.setPen(QtGui.QColor(theme.dim))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(QRectF(self.rect()).adjusted(8, 8, -8, -8), flags, self.message)
            painter.end()
            return
        places = self.places
        painter.setPen(QtGui.QColor(theme.warning if self.content.synthetic else theme.dim))
        text = _SYNTHETIC if self.content.synthetic else ""
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        painter.drawText(places.head, right, text)
        painter.setPen(QtGui.QColor(theme.dim))
        painter.drawText(places.head, Qt.AlignmentFlag.AlignVCenter, self.head_text)
        paint_strip(painter, self.content, places, theme, self.chosen)
        if self.hasFocus():
            paint_focus_frame(painter, QRectF(self.rect()), theme)
        painter.end()

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QtGui.QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            text = self.text_at(QPointF(event.pos()))
            QtWidgets.QToolTip.showText(event.globalPos(), text, self)
            return True
        return super().event(event)

    def text_at(self, point: QPointF) -> str:
        """Return times and extent of the window under a point."""
        window = self.window_under(point)
        if window is None or self.content is None or self.message:
            return ""
        extent = self.content.extent_text(window)
        bounds_s = self.content.bounds_s
        return f"{window_text(bounds_s[window], bounds_s[-1][1])}\n{extent}"

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        window = self.window_under(event.position())
        if event.button() == Qt.MouseButton.LeftButton and window is not None:
            self._choose(window)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        step = _STEPS.get(Qt.Key(event.key()))
        if step is None or self.content is None or event.modifiers():
            super().keyPressEvent(event)
            return
        n = self.content.windows.count
        if n:
            start = (-1 if step > 0 else n) if self.chosen is None else self.chosen
            self._choose(min(max(start + step, 0), n - 1))

    def _choose(self, window: int) -> None:
        if self.content is not None and not self.message:
            self.time_chosen.emit(self.content.bounds_s[window][0])
