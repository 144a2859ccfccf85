"""Pictures of a plot, for papers and slides: whole, with a legend, without a crosshair."""

from collections.abc import Iterator
from dataclasses import replace
from math import ceil

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen

from skinsource_gui.theme import LIGHT, UNIT_PX, Theme, current_theme, drawn_in
from skinsource_gui.widgets.paper import on_paper
from skinsource_gui.widgets.plot.plot import Plot

_SCALE = 2
_SWATCH_PX, _GAP_PX = 16, 4


def usual_size(plot: Plot) -> QSize:
    """Of a picture of what ``plot`` shows, px: twice as large as on the screen, with its legend."""
    copy = copy_of(plot, plot.size())
    size = QSize(copy.width(), copy.height() + _head_px(copy)) * _SCALE
    copy.deleteLater()
    return size


def draw_signals(
    painter: QPainter, width: int, height: int, *, plot: Plot, theme: Theme = LIGHT
) -> None:
    """Draw what ``plot`` shows, ``width`` by ``height`` px; words grow with the picture."""
    with drawn_in(theme):
        _draw(painter, width, height, plot)


def _draw(painter: QPainter, width: int, height: int, plot: Plot) -> None:
    usual = usual_size(plot).toSizeF() * (1.0 / _SCALE)
    scale = min(width / usual.width(), height / usual.height())
    room = QSize(round(width / scale), round(height / scale))
    # As wide as it will be, so that the head takes as many lines as it needs there.
    measured = copy_of(plot, room)
    head_px = _head_px(measured)
    measured.deleteLater()
    # A plot that is not shown is laid out for the size in which it was made.
    left_px = max(room.height() - head_px, measured.minimumHeight())
    copy = copy_of(plot, QSize(room.width(), left_px))
    painter.save()
    painter.fillRect(QRectF(0, 0, width, height), QColor(current_theme().base))
    painter.scale(scale, scale)
    _paint_head(painter, copy)
    painter.translate(0, head_px)
    whole = QRectF(copy.rect())
    with on_paper():
        copy.scene().render(painter, whole, whole)
    painter.restore()
    copy.deleteLater()


def copy_of(plot: Plot, size: QSize) -> Plot:
    """What ``plot`` shows, in the colours in use, in another size and on paper."""
    # A plot of its own: the one on the screen keeps its colours, its crosshair and its picture.
    copy = Plot(on_paper=True)
    copy.resize(size)
    copy.set_view(plot.x_window.axis, plot.zoom, stacked=plot.stacked, fitted=plot.fitted)
    copy.set_words(replace(plot.words, stale=False))
    copy.held = plot.held.copied()
    if plot.curves is not None:
        copy.show_curves(plot.curves)
    for item in copy.scene().items():
        # As lines and letters, not as pictures of them.
        item.setCacheMode(item.CacheMode.NoCache)
    return copy


def _head_px(plot: Plot) -> int:
    n_lines = len(_heading_lines(plot)) + len(_legend_lines(plot))
    return ceil(n_lines * _line_px(plot)) + UNIT_PX // 2


def _paint_head(painter: QPainter, plot: Plot) -> None:
    line_px = _line_px(plot)
    painter.setFont(plot.words_font)
    painter.setPen(QColor(current_theme().text))
    heading = _heading_lines(plot)
    for row, words in enumerate(heading):
        room = QRectF(UNIT_PX, row * line_px, plot.width(), line_px)
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, words)
    for row, line in enumerate(_legend_lines(plot), start=len(heading)):
        middle = (row + 0.5) * line_px
        for left, pen, text in line:
            if pen is not None:
                painter.setPen(pen)
                painter.drawLine(left, int(middle), left + _SWATCH_PX, int(middle))
                left += _SWATCH_PX + _GAP_PX
            painter.setPen(QColor(current_theme().text))
            room = QRectF(left, row * line_px, plot.width(), line_px)
            painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, text)


def _line_px(plot: Plot) -> float:
    return QFontMetricsF(plot.words_font).height() + 2


def _heading_lines(plot: Plot) -> list[str]:
    """The heading in as many lines as its parts need; one that is too long is broken."""
    metrics, room_px = QFontMetricsF(plot.words_font), plot.width() - 2 * UNIT_PX
    lines: list[str] = []
    for part in () if plot.curves is None else plot.curves.heading:
        between = " · "
        for word in [part] if metrics.horizontalAdvance(part) <= room_px else part.split(" "):
            longer = f"{lines[-1]}{between}{word}" if lines else word
            if lines and metrics.horizontalAdvance(longer) <= room_px:
                lines[-1] = longer
            else:
                lines.append(word)
            between = " "
    return lines


def _legend_lines(plot: Plot) -> list[list[tuple[int, QPen | None, str]]]:
    """Left edge, pen and text of each entry, line by line."""
    metrics = QFontMetricsF(plot.words_font)
    lines: list[list[tuple[int, QPen | None, str]]] = [[]]
    left = UNIT_PX
    for pen, text in _entries(plot):
        swatch_px = 0 if pen is None else _SWATCH_PX + _GAP_PX
        width = ceil(swatch_px + metrics.horizontalAdvance(text) + 2 * UNIT_PX)
        if lines[-1] and left + width > plot.width():
            lines.append([])
            left = UNIT_PX
        lines[-1].append((left, pen, text))
        left += width
    return lines


def _entries(plot: Plot) -> Iterator[tuple[QPen | None, str]]:
    """Pens and texts: where axes have the pens, outputs are told by the numbers of their rows."""
    curves = plot.curves
    if curves is None:
        return
    for rank, axis in enumerate(curves.axes):
        yield QPen(current_theme().axis_colour(rank), 2.0), axis
    for rank, name in enumerate(curves.names):
        text = f"{name.number}  {name.short}" if name.number else name.short
        if curves.peaks:
            text += f", peak {curves.peak_words[rank]} {curves.peak_unit.symbol}"
        yield None if curves.axes else current_theme().output_pen(rank, 2.0), text
