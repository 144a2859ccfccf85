"""Pictures are written whole or not at all."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from PySide6.QtCore import QBuffer, QIODevice, QMarginsF, QRect, QSize, QSizeF
from PySide6.QtGui import QImage, QPageSize, QPainter, QPdfWriter, QPixmap
from PySide6.QtSvg import QSvgGenerator

from skinsource.base.errors import StorageError
from skinsource.base.files import write_bytes
from skinsource_gui.widgets.pictures.layouts import PER_INCH
from skinsource_gui.widgets.pictures.searchable import searchable

#: Draws a picture with a painter, so wide and so high, px; may take a ``theme`` too.
Draw = Callable[..., None]

_POINTS = 72
_INCHES_IN_METRE = 1 / 0.0254


def save_picture(path: Path, picture: QImage | QPixmap) -> None:
    """Write ``picture`` to ``path`` as PNG.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    """
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    # The stubs of PySide ask for bytes, which it does not take.
    image: Any = picture
    image.save(buffer, "PNG")
    write_bytes(path, bytes(buffer.data().data()))


def save_drawing(
    path: Path,
    draw: Draw,
    width: int,
    height: int,
    *,
    title: str = "SkinSource",
    dpi: int = PER_INCH,
) -> None:
    """Write what ``draw`` draws to ``path``, as its ending says: PNG, or lines as SVG or PDF.

    Parameters
    ----------
    path
        The file; another ending than ``.svg`` and ``.pdf`` means PNG.
    draw
        Draws the picture.
    width, height
        Of the picture, px; 96 of them are an inch of a page.
    title
        What readers of drawings and pages are told.
    dpi
        Dots in an inch of a PNG.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    """
    writers = {".svg": _svg, ".pdf": _pdf}
    write = writers.get(path.suffix.lower())
    if write is None:
        save_picture(path, drawn_image(draw, width, height, dpi))
        return
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    write(buffer, draw, width, height, title)
    written = bytes(buffer.data().data())
    write_bytes(path, searchable(written) if write is _pdf else written)


def drawn_image(draw: Draw, width: int, height: int, dpi: int = PER_INCH) -> QImage:
    """What ``draw`` draws, as pixels: of so many in an inch, of which it has 96."""
    scale = dpi / PER_INCH
    size = QSize(max(round(width * scale), 1), max(round(height * scale), 1))
    image = QImage(size, QImage.Format.Format_RGB32)
    if image.isNull():
        raise StorageError(
            f"A picture of {size.width()} x {size.height()} pixels does not fit into memory. "
            "Choose a smaller size or resolution, or save it as SVG or PDF."
        )
    # Letters are sized in points, by the dots of the image: with those of the file they would grow
    # twice, and out of their places.
    _say_dots(image, PER_INCH)
    painter = QPainter(image)
    painter.scale(size.width() / width, size.height() / height)
    draw(painter, width, height)
    painter.end()
    _say_dots(image, dpi)
    return image


def _say_dots(image: QImage, dpi: int) -> None:
    dots = round(dpi * _INCHES_IN_METRE)
    image.setDotsPerMeterX(dots)
    image.setDotsPerMeterY(dots)


def _svg(device: QIODevice, draw: Draw, width: int, height: int, title: str) -> None:
    drawing = QSvgGenerator()
    drawing.setOutputDevice(device)
    drawing.setResolution(PER_INCH)
    drawing.setSize(QSize(width, height))
    drawing.setViewBox(QRect(0, 0, width, height))
    drawing.setTitle(title)
    painter = QPainter(drawing)
    draw(painter, width, height)
    painter.end()


def _pdf(device: QIODevice, draw: Draw, width: int, height: int, title: str) -> None:
    page = QPdfWriter(device)
    page.setTitle(title)
    page.setResolution(PER_INCH)
    points = QSizeF(width, height) * (_POINTS / PER_INCH)
    page.setPageSize(QPageSize(points, QPageSize.Unit.Point))
    page.setPageMargins(QMarginsF())
    painter = QPainter(page)
    # Colours of a map are levels: JPEG would change them.
    painter.setRenderHint(QPainter.RenderHint.LosslessImageRendering)
    draw(painter, width, height)
    painter.end()
