"""Pictures of a plot, for papers and slides: light, whole, with a legend, without a crosshair."""

from dataclasses import replace
from math import ceil
from pathlib import Path

from PySide6.QtCore import QBuffer, QIODevice, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QImage, QPainter
from PySide6.QtSvg import QSvgGenerator

from skinsource.files import write_bytes
from skinsource_gui.theme import LIGHT, UNIT_PX
from skinsource_gui.widgets.plot.plot import Plot

_SCALE = 2
_SWATCH_PX = 16


def signal_picture(plot: Plot) -> QImage:
    """What ``plot`` shows, in the light theme, at twice its size on the screen."""
    copy, legend_px = _copy_of(plot)
    size = QSize(copy.width(), copy.height() + legend_px)
    image = QImage(size * _SCALE, QImage.Format.Format_RGB32)
    image.setDevicePixelRatio(_SCALE)
    image.fill(QColor(LIGHT.base))
    painter = QPainter(image)
    _paint(painter, copy, legend_px)
    painter.end()
    copy.deleteLater()
    return image


def save_picture(path: Path, plot: Plot, title: str) -> None:
    """Write a picture to ``path``: a drawing where it ends in ``.svg``, else a PNG.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    """
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    if path.suffix.lower() == ".svg":
        _draw_svg(buffer, plot, title)
    else:
        signal_picture(plot).save(buffer, "PNG")
    write_bytes(path, bytes(buffer.data().data()))


def _draw_svg(buffer: QBuffer, plot: Plot, title: str) -> None:
    copy, legend_px = _copy_of(plot)
    generator = QSvgGenerator()
    generator.setOutputDevice(buffer)
    generator.setTitle(title)
    generator.setSize(QSize(copy.width(), copy.height() + legend_px))
    generator.setViewBox(QRect(0, 0, copy.width(), copy.height() + legend_px))
    painter = QPainter(generator)
    painter.fillRect(generator.viewBoxF(), QColor(LIGHT.base))
    _paint(painter, copy, legend_px)
    painter.end()
    copy.deleteLater()


def _copy_of(plot: Plot) -> tuple[Plot, int]:
    # A plot of its own: the one on the screen keeps its colours, its crosshair and its picture.
    copy = Plot()
    copy.resize(plot.size())
    copy.set_view(plot.window.axis, plot.zoom, stacked=plot.stacked)
    copy.set_words(replace(plot.words, stale=False))
    if plot.curves is not None:
        copy.show_curves(plot.curves)
    for item in copy.scene().items():
        # As lines and letters, not as pictures of them.
        item.setCacheMode(item.CacheMode.NoCache)
    n_lines = len(_heading_lines(copy)) + len(_legend_lines(copy))
    return copy, ceil(n_lines * _line_px(copy)) + UNIT_PX // 2


def _paint(painter: QPainter, plot: Plot, legend_px: int) -> None:
    _paint_head(painter, plot)
    painter.translate(0, legend_px)
    room = QRectF(plot.rect())
    plot.scene().render(painter, room, room)


def _paint_head(painter: QPainter, plot: Plot) -> None:
    line_px = _line_px(plot)
    painter.setFont(plot.words_font)
    painter.setPen(QColor(LIGHT.text))
    heading = _heading_lines(plot)
    for row, words in enumerate(heading):
        room = QRectF(UNIT_PX, row * line_px, plot.width(), line_px)
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, words)
    for row, line in enumerate(_legend_lines(plot), start=len(heading)):
        middle = (row + 0.5) * line_px
        for left, rank, text in line:
            painter.setPen(LIGHT.output_pen(rank, 2.0))
            painter.drawLine(left, int(middle), left + _SWATCH_PX, int(middle))
            painter.setPen(QColor(LIGHT.text))
            room = QRectF(left + _SWATCH_PX + 4, row * line_px, plot.width(), line_px)
            painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, text)


def _line_px(plot: Plot) -> float:
    return QFontMetricsF(plot.words_font).height() + 2


def _heading_lines(plot: Plot) -> list[str]:
    """The heading in as many lines as its parts need."""
    metrics = QFontMetricsF(plot.words_font)
    lines: list[str] = []
    for part in () if plot.curves is None else plot.curves.heading:
        longer = f"{lines[-1]} · {part}" if lines else part
        if lines and metrics.horizontalAdvance(longer) <= plot.width() - 2 * UNIT_PX:
            lines[-1] = longer
        else:
            lines.append(part)
    return lines


def _legend_lines(plot: Plot) -> list[list[tuple[int, int, str]]]:
    """Left edge, rank and text of each entry, line by line."""
    metrics = QFontMetricsF(plot.words_font)
    lines: list[list[tuple[int, int, str]]] = [[]]
    left = UNIT_PX
    for rank, name in enumerate(() if plot.curves is None else plot.curves.names):
        text = f"{name.number}  {name.short}"
        width = ceil(_SWATCH_PX + 4 + metrics.horizontalAdvance(text) + 2 * UNIT_PX)
        if lines[-1] and left + width > plot.width():
            lines.append([])
            left = UNIT_PX
        lines[-1].append((left, rank, text))
        left += width
    return lines
