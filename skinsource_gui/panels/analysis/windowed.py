"""Maps of consecutive windows, and how far each reaches: what is painted, and its panel."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import ceil
from typing import Any, ClassVar

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal

from skinsource.base.conventions import Floats
from skinsource.base.decibels import FLOOR_DB
from skinsource.design.comparing import match_text
from skinsource.design.describing import duration_text
from skinsource.design.design import (
    WINDOW_COUNT,
    WINDOW_LENGTH,
    WINDOWS_CUT,
    Design,
    View,
    audible_inputs,
)
from skinsource.design.labels import limb_label, signal_label
from skinsource.limbs.extent import Extent
from skinsource.limbs.own_limbs import facts_of
from skinsource.signals.analysis.windows import Windows
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.units import axis_unit
from skinsource_gui.panels.analysis.view import AnalysisView
from skinsource_gui.plots.colour_maps import colour_table
from skinsource_gui.plots.curves import fitting
from skinsource_gui.plots.figure import Figure
from skinsource_gui.plots.small_map import (
    LEAST_MAP_PX,
    USUAL_STYLE,
    ColourScale,
    LevelStyle,
    SmallMap,
    level_style,
    map_grid,
    paint_scale_row,
    paint_small_bar,
    paint_small_map,
    scale_of_levels,
    scale_row_px,
    small_map_of,
    with_matched,
)
from skinsource_gui.qt.fitting import FoldingRow, grouped
from skinsource_gui.qt.layouts import in_column
from skinsource_gui.qt.theme import LIGHT, UNIT_PX, Theme, current_theme, on_paper, tabular
from skinsource_gui.state.compared import SILENT


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
# Names of the curves of the extent, and shorter ones; each has the colour of an output.
_CURVES = (("mean distance", "90 % of the energy within"), ("mean", "90 %"))


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
    far = max((max(extent.mean_distance_mm, extent.d90_mm) for extent in extents), default=1.0)
    top = max(ceil(far / 20.0) * 20.0, 20.0)
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
    x, metrics, (names, shorter) = area.left(), painter.fontMetrics(), _CURVES
    if sum(map(metrics.horizontalAdvance, names)) + line > area.width():
        names = shorter
    for rank, name in enumerate(names):
        painter.setPen(theme.output_colour(rank))
        room = metrics.horizontalAdvance(name) + line
        painter.drawText(QRectF(x, area.top() - 1.2 * line, room, line), Qt.AlignmentFlag(0), name)
        x += room


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


_SYNTHETIC = "SYNTHETIC"
_STEPS = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}


class StripView(Figure):
    """Shows windows, and tells which one is chosen."""

    #: Begin of a window that was chosen, s.
    time_chosen = Signal(float)

    def __init__(self) -> None:
        super().__init__("window_strip", "Windows")
        self.content: WindowedContent | None = None
        self.chosen: int | None = None
        self.setAccessibleDescription("Left and right go from window to window")

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
        metrics = QtGui.QFontMetricsF(tabular(self.font()))
        room = self.places.head.width() - metrics.height()
        if self.content.synthetic:
            room -= metrics.horizontalAdvance(_SYNTHETIC)
        return fitting(self.content.begin_phrases, metrics, room)

    def draw(self, painter: QtGui.QPainter, room: QRectF) -> None:
        if self.content is None:
            return
        painter.setFont(tabular(self.font()))
        places, theme = self.places, current_theme()
        painter.setPen(QtGui.QColor(theme.warning if self.content.synthetic else theme.dim))
        text = _SYNTHETIC if self.content.synthetic else ""
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        painter.drawText(places.head, right, text)
        painter.setPen(QtGui.QColor(theme.dim))
        painter.drawText(places.head, Qt.AlignmentFlag.AlignVCenter, self.head_text)
        paint_strip(painter, self.content, places, theme, self.chosen)

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        self.setToolTip(self.text_at(event.position()))

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


# Width and height of a picture in those of letters: on a slide they are read from far away.
_LETTERS, _LINES = 46, 24
_TOO_SHORT = "No whole window fits into the response. Choose shorter ones."


class WindowedView(AnalysisView):
    """A map of the RMS for each of consecutive windows, and how far each of them reaches."""

    name: ClassVar[str] = "windowed"
    needs = frozenset(
        {"limb_map", "limb_data", "surface", "sample_rate_hz", "windows", "levels_of_windows_db"}
        | {"surface_of_windows_db", "extents_of_windows", "noisy_outputs_of_windows"}
        | {"windows_in_noise", "match_gain"}
    )
    copies: ClassVar[bool] = False

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.strip = StripView()
        self.cells = {
            "windows_cut": FieldCell("windows_cut", WINDOWS_CUT, edited=self._change),
            "window_count": FieldCell("window_count", WINDOW_COUNT, edited=self._change),
            "window_s": FieldCell("window_s", WINDOW_LENGTH, edited=self._change),
        }
        cut, *others = self.cells.values()
        fields = [part for cell in others for part in (cell.label, cell)]
        gap_px = UNIT_PX // 2
        groups = grouped(cut.label, cut, gap_px=gap_px), grouped(*fields, None, gap_px=gap_px)
        in_column(
            FoldingRow(groups, gap_px),
            (self.strip, 1),
            of=self,
            margins=UNIT_PX // 2,
            gap_px=UNIT_PX // 2,
        )
        self.setFocusProxy(self.strip)
        self.guessed = self.computed = (self.strip,)
        self.strip.time_chosen.connect(self.playhead_requested)
        self._show_view()

    @property
    def message(self) -> str:
        return self.strip.message

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        self._show_view()
        content = self.strip.content
        if content is None:
            return
        looks = self._looks
        if any(getattr(content, name) != value for name, value in looks.items()):
            # Only texts and colours change, which needs no new results.
            self.strip.show_content(replace(content, **looks), self.strip.message)

    def show_playhead(self, view: View) -> None:
        self._view = view
        self.strip.show_time(view.playhead_s)

    def show_results(self, results: Mapping[str, Any]) -> None:
        levels = results["levels_of_windows_db"]
        maps = {"surface_levels_db": results["surface_of_windows_db"], **results}
        content = WindowedContent(
            design=self._design,
            small=small_map_of(maps),
            windows=results["windows"],
            sample_rate_hz=results["sample_rate_hz"],
            levels_db=levels,
            field_levels_db=results["surface_of_windows_db"],
            extents=results["extents_of_windows"],
            noisy=results["noisy_outputs_of_windows"],
            in_noise=results["windows_in_noise"],
            synthetic=results["limb_data"].synthetic,
            matched=match_text(results["match_gain"]),
            **self._looks,
        )
        message = ""
        if content.windows.count == 0:
            message = _TOO_SHORT
        elif float(np.max(levels)) <= FLOOR_DB:
            message = SILENT
        self.strip.show_content(content, message)
        self.strip.show_time(self._view.playhead_s)

    def say_instead(self, message: str) -> None:
        self.strip.show_content(None, message)

    def draw_picture(
        self, painter: QtGui.QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """Draw the strip for a page or a slide, with all that is needed to read it; size in px."""
        font = painter.font()
        font.setFamily(self.font().family())
        font.setPixelSize(max(round(min(width / _LETTERS, height / _LINES)), 8))
        painter.setFont(font)
        painter.fillRect(QRectF(0, 0, width, height), QtGui.QColor(theme.base))
        content, line = self.strip.content, float(painter.fontMetrics().height())
        painter.setPen(QtGui.QColor(theme.text))
        heading = QRectF(line, 0.5 * line, width - 2 * line, 3.4 * line)
        if content is None or self.strip.message:
            painter.drawText(heading, 0, self._heading())
            painter.drawText(QRectF(line, 5 * line, width, line), 0, self.strip.message)
            return
        # The layout leaves a line for the head of the panel, which the heading covers.
        room = QRectF(0.0, 2.4 * line, width, height - 2.9 * line)
        layout = strip_layout(room, content.windows.count, line)
        metrics = QtGui.QFontMetricsF(painter.font())
        times = fitting(content.begin_phrases, metrics, heading.width())
        painter.drawText(heading, 0, self._heading(times))
        with on_paper():
            paint_strip(painter, content, layout, theme)

    @property
    def _looks(self) -> dict[str, Any]:
        """Fields of the content that follow from the view alone."""
        delay_s = 0.0
        if not self._view.delay_removed:
            delay_s = facts_of(self._design.limb).pre_trigger_delay_s
        return {"traces_delay_s": delay_s, "look": level_style(self._view)}

    def _heading(self, times: str = "") -> str:
        content, view = self.strip.content, self._view
        limb = limb_label(self._design.limb).title
        lines = [f"{limb}: RMS of {signal_label(view.axes, view.method)} in windows"]
        if times:
            lines.append(times)
        if content is not None and content.synthetic:
            lines.append("SYNTHETIC LIMB")
        return "\n".join(lines)

    def _show_view(self) -> None:
        for name, cell in self.cells.items():
            cell.set_value(getattr(self._view, name))
        by_count = self._view.windows_cut == "count"
        for name, shown in (("window_count", by_count), ("window_s", not by_count)):
            self.cells[name].setVisible(shown)
            self.cells[name].label.setVisible(shown)
        self.strip.show_time(self._view.playhead_s)

    def _change(self, name: str, value: object, gesture: int | None) -> None:
        changed: dict[str, Any] = {name: value}
        self.view_changed.emit(replace(self._view, **changed))
