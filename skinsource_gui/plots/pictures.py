"""Pictures for print and for slides: their sizes, files, captions, and the form that asks.

A picture is drawn by a function, so that a page keeps lines and letters.  Its file is written whole
or not at all.
"""

import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from math import ceil
from pathlib import Path
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import (
    QBuffer,
    QIODevice,
    QMarginsF,
    QPoint,
    QPointF,
    QRect,
    QRectF,
    QSize,
    QSizeF,
    Signal,
)
from PySide6.QtSvg import QSvgGenerator

from skinsource.base.errors import StorageError, sentence
from skinsource.base.files import write_bytes
from skinsource.design.comparing import common_title
from skinsource.design.describing import stimulus_text
from skinsource.design.design import Design
from skinsource.design.labels import SCALINGS, label_of, limb_label
from skinsource.specs import fields
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec, Spec
from skinsource.studies import scenes
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.units import minus
from skinsource_gui.qt.layouts import form_of
from skinsource_gui.qt.resources import number_named
from skinsource_gui.qt.theme import LIGHT, THEMES, Theme, on_paper, theme_label

#: Pixels in an inch of a page or a drawing, as in CSS.
PER_INCH = 96

#: Returns by how much a caption makes a picture of this width and height higher, px.
Below = Callable[[int, int], int]


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """A size for a purpose.

    Attributes
    ----------
    width_in, height_in
        Inches; a height of 0 follows from the picture.
    dpi
        Dots per inch of a PNG.
    """

    name: str
    title: str
    width_in: float
    height_in: float = 0.0
    dpi: int = 300

    def size_px(self, usual: tuple[int, int], below: Below | None = None) -> tuple[int, int]:
        """Return width and height, px, of a picture that usually has the size ``usual``.

        A height that follows from the picture includes the caption ``below``.
        """
        width = round(self.width_in * PER_INCH)
        if self.height_in:
            return width, round(self.height_in * PER_INCH)
        height = max(round(width * usual[1] / usual[0]), 100)
        return width, height + (0 if below is None else below(width, height))


#: Column widths are those of IEEE's journals; a poster's figure is as wide as a sheet of A3.
LAYOUTS = (
    Layout(name="column", title="One column (89 mm)", width_in=3.5),
    Layout(name="two_columns", title="Two columns (182 mm)", width_in=7.16),
    Layout(name="slide", title="Slide (16 : 9)", width_in=13.333, height_in=7.5, dpi=144),
    Layout(name="poster", title="Poster (420 mm)", width_in=16.54),
)
#: Name of a size that is none of these.
OWN = "own"


#: Draws a picture: painter, width and height in px, and for some a ``theme``.
Draw = Callable[..., None]

_POINTS = 72
_MM_IN_INCH = 25.4
_INCHES_IN_METRE = 1 / 0.0254


def png_of(picture: QtGui.QImage | QtGui.QPixmap) -> bytes:
    """Return ``picture`` as PNG; empty for an empty picture."""
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    # The stubs of PySide ask for bytes, which it does not take.
    image: Any = picture
    image.save(buffer, "PNG")
    return bytes(buffer.data().data())


def save_picture(path: Path, picture: QtGui.QImage | QtGui.QPixmap) -> None:
    """Write ``picture`` to ``path`` as PNG.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    """
    write_bytes(path, png_of(picture))


def save_drawing(
    path: Path,
    draw: Draw,
    width: int,
    height: int,
    *,
    title: str = "SkinSource",
    dpi: int = PER_INCH,
) -> None:
    """Write a drawing to ``path``: as PNG, SVG or PDF, by its suffix.

    Parameters
    ----------
    path
        The file; another suffix than ``.svg`` and ``.pdf`` means PNG.
    draw
        Draws the picture.
    width, height
        Size of the picture, px; 96 of them are an inch of a page.
    title
        Title of an SVG or PDF document.
    dpi
        Dots per inch of a PNG.

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
    write_bytes(path, bytes(buffer.data().data()))


def drawn_image(draw: Draw, width: int, height: int, dpi: int = PER_INCH) -> QtGui.QImage:
    """Return a drawing of ``width`` by ``height`` px as an image with ``dpi`` dots per inch."""
    scale = dpi / PER_INCH
    size = QSize(max(round(width * scale), 1), max(round(height * scale), 1))
    image = QtGui.QImage(size, QtGui.QImage.Format.Format_RGB32)
    if image.isNull():
        raise StorageError(
            f"A picture of {size.width()} x {size.height()} pixels does not fit into memory. "
            "Choose a smaller size or resolution, or save it as SVG or PDF."
        )
    # Letters are sized in points by the resolution of the image: with that of the file they would
    # grow twice.
    _set_resolution(image, PER_INCH)
    painter = QtGui.QPainter(image)
    painter.scale(size.width() / width, size.height() / height)
    draw(painter, width, height)
    painter.end()
    _set_resolution(image, dpi)
    return image


def _set_resolution(image: QtGui.QImage, dpi: int) -> None:
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
    painter = QtGui.QPainter(drawing)
    draw(painter, width, height)
    painter.end()


def _pdf(device: QIODevice, draw: Draw, width: int, height: int, title: str) -> None:
    page = QtGui.QPdfWriter(device)
    page.setTitle(title)
    page.setResolution(PER_INCH)
    points = QSizeF(width, height) * (_POINTS / PER_INCH)
    page.setPageSize(QtGui.QPageSize(points, QtGui.QPageSize.Unit.Point))
    page.setPageMargins(QMarginsF())
    painter = QtGui.QPainter(page)
    # Colours of a map are levels: JPEG would change them.
    painter.setRenderHint(QtGui.QPainter.RenderHint.LosslessImageRendering)
    draw(painter, width, height)
    painter.end()


class DrawableWidget(QtWidgets.QWidget):
    """A widget that can be drawn for a page or a slide."""

    def draw_picture(
        self, painter: QtGui.QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """Draw what the widget shows; size in px.

        Here the widget has the colours in use, and ``theme`` gives only the background.
        """
        scale = min(width / max(self.width(), 1), height / max(self.height(), 1))
        painter.save()
        painter.fillRect(QRectF(0, 0, width, height), QtGui.QColor(theme.base))
        painter.translate((width - scale * self.width()) / 2, 0.0)
        painter.scale(scale, scale)
        flags = (
            QtWidgets.QWidget.RenderFlag.DrawWindowBackground
            | QtWidgets.QWidget.RenderFlag.DrawChildren
        )
        with on_paper(), _without_cache(self):
            self.render(painter, QPoint(), QtGui.QRegion(), flags)
        painter.restore()


@contextmanager
def _without_cache(widget: QtWidgets.QWidget) -> Iterator[None]:
    """Draw scenes as lines and letters, not as the pixels that views and items cache."""
    views = widget.findChildren(QtWidgets.QGraphicsView)
    view_modes = {view: view.cacheMode() for view in views}
    item_modes = {
        item: item.cacheMode()
        for view in views
        for item in view.scene().items()
        if item.cacheMode() != QtWidgets.QGraphicsItem.CacheMode.NoCache
    }
    for view in views:
        view.setCacheMode(QtWidgets.QGraphicsView.CacheModeFlag.CacheNone)
    for item in item_modes:
        item.setCacheMode(QtWidgets.QGraphicsItem.CacheMode.NoCache)
    try:
        yield
    finally:
        for view, view_mode in view_modes.items():
            view.setCacheMode(view_mode)
        for item, mode in item_modes.items():
            item.setCacheMode(mode)


#: In place of the name of a panel: the panel in use, all visible panels, and the visible one whose
#: maps move side by side.
PANEL_IN_USE, ALL_VISIBLE, MOVING = "active panel", "all visible panels", "moving maps"


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """A picture that can be drawn.

    Attributes
    ----------
    draw
        Draws it, with a ``theme`` for its colours; the caption is part of it.
    title
        Title of the panel; "" for more than one panel.
    size_px
        Usual width and height; None: the caller decides.
    seen
        The visible part, for who draws the same by other means; None: all of it.
    """

    draw: Draw
    title: str = ""
    caption: str = ""
    size_px: tuple[int, int] | None = None
    visible: Any = None


#: Where a line may break: a number stays with its unit.
BREAKS = re.compile(r"(?<!\d) | (?![^\W\d]|°)")

#: A design with the name under which it is shown.
Named = tuple[str, Design]


def stimuli_text(named: Sequence[Named]) -> str:
    """Describe the stimuli of several designs, each after its name."""
    if len(named) == 1:
        return stimulus_text(named[0][1])
    return ". ".join(f"{name}: {stimulus_text(design)}" for name, design in named)


# Height of the letters of a caption, as a part of the smaller side of the picture; their limits,
# px.
_PART, _SMALLEST_PX, _LARGEST_PX = 1 / 45, 8, 40
# Letters shrink until the caption takes at most the first part of the height.  The smallest that
# can be read may take the second part; where that is too little they shrink further.
_PART_OF_HEIGHT, _MOST_OF_HEIGHT, _LEAST_PX = 0.16, 0.3, 5


def caption_of(
    design: Design,
    *,
    compared: Sequence[Named] = (),
    limbs: Sequence[str] = (),
    notes: Sequence[str] = (),
) -> str:
    """Describe the stimulus below a picture: what is played, where, how strong, on which limb.

    Parameters
    ----------
    design
        The design that is shown.
    compared
        Designs that are shown side by side, with their names; none: ``design`` is shown alone.
    limbs
        Names of further limbs that are shown.
    notes
        Sentences on these limbs, and on validity; see `skinsource.perception.validity`.
    """
    named = compared or [("", design)]
    designs = [named_design for _, named_design in named]
    title = common_title([scenes.title_of(each) if each.title else "" for each in designs])
    first = f"{sentence(title)} " if title else ""
    scalings = dict.fromkeys(label_of(SCALINGS, each.scaling).title.lower() for each in designs)
    titles = [
        limb_label(limb_name).title
        for limb_name in dict.fromkeys((*(d.limb for d in designs), *limbs))
    ]
    limb = f"Limb{'s' if len(titles) > 1 else ''}: {', '.join(titles)}"
    through = dict.fromkeys(each.actuated.words for each in designs if each.actuated is not None)
    driven = f"; predicted through {', '.join(through)}" if through else ""
    remarks = "".join(f" {note}" for note in notes)
    scaling = ", ".join(scalings)
    return minus(f"{first}{stimuli_text(named)}. {limb}; scaling: {scaling}{driven}.{remarks}")


def lines_of(text: str, metrics: QtGui.QFontMetricsF, room_px: float) -> list[str]:
    """Break ``text`` into lines that fit ``room_px``; a number and its unit stay together."""
    lines: list[str] = []
    for part in BREAKS.split(text):
        longer = f"{lines[-1]} {part}" if lines else part
        if lines and metrics.horizontalAdvance(longer) <= room_px:
            lines[-1] = longer
        else:
            lines.append(part)
    return lines


def with_caption(draw: Draw, caption: str) -> Draw:
    """Return a drawing function that adds ``caption`` below the picture, unless it is empty."""
    return partial(_draw, draw, caption) if caption else draw


def caption_px(caption: str, width: int, height: int) -> int:
    """Return by how much ``caption`` makes a picture of this size higher, px."""
    if not caption:
        return 0
    font, more = QtGui.QFont(), 0
    for _ in range(4):
        # Letters and edges grow with the page, by less each time.
        edge = _edge_px(width, height + more)
        font.setPixelSize(letters_px(width, height + more))
        lines = lines_of(caption, QtGui.QFontMetricsF(font), width - 2 * edge)
        more = ceil(_height(lines, font) + 1.5 * edge)
    return more


def _draw(
    draw: Draw,
    caption: str,
    painter: QtGui.QPainter,
    width: int,
    height: int,
    theme: Theme = LIGHT,
) -> None:
    lines, font, left, edge = _laid_out(caption, painter.font(), width, height)
    painter.fillRect(QRectF(0, 0, width, height), QtGui.QColor(theme.base))
    painter.save()
    draw(painter, width, left, theme=theme)
    painter.restore()
    painter.setFont(font)
    painter.setPen(QtGui.QColor(theme.dim))
    # Line by line: at a higher resolution Qt would space the lines of one text differently.
    metrics = QtGui.QFontMetricsF(font)
    first = left + edge / 2 + metrics.ascent()
    for row, line in enumerate(lines):
        painter.drawText(QPointF(edge, first + row * metrics.lineSpacing()), line)


def _laid_out(
    caption: str, font: QtGui.QFont, width: int, height: int
) -> tuple[list[str], QtGui.QFont, int, float]:
    """Return lines and font of the caption, its top, and its margin; px."""
    font = QtGui.QFont(font)
    edge = _edge_px(width, height)
    room_px = width - 2 * edge
    font.setPixelSize(letters_px(width, height))
    lines = lines_of(caption, QtGui.QFontMetricsF(font), room_px)
    for part, least_px in ((_PART_OF_HEIGHT, _SMALLEST_PX), (_MOST_OF_HEIGHT, _LEAST_PX)):
        while _height(lines, font) > part * height and font.pixelSize() > least_px:
            font.setPixelSize(font.pixelSize() - 1)
            lines = lines_of(caption, QtGui.QFontMetricsF(font), room_px)
    while _height(lines, font) > _MOST_OF_HEIGHT * height and len(caption) > 1:
        caption = f"{caption[: int(0.9 * len(caption)) - 1].rstrip('…')}…"
        lines = lines_of(caption, QtGui.QFontMetricsF(font), room_px)
    left = max(int(height - _height(lines, font) - 1.5 * edge), 1)
    return lines, font, left, edge


def _edge_px(width: float, height: float) -> float:
    return 0.02 * min(width, height)


def letters_px(width: float, height: float) -> int:
    """Return the height of the letters of a caption of a picture of this size, px."""
    return min(max(round(min(width, height) * _PART), _SMALLEST_PX), _LARGEST_PX)


def _height(lines: Sequence[str], font: QtGui.QFont) -> float:
    return len(lines) * QtGui.QFontMetricsF(font).lineSpacing()


#: Formats of a picture: title and suffix.
KINDS = (("PNG", ".png"), ("SVG", ".svg"), ("PDF", ".pdf"))
KIND = ChoiceSpec(
    label="Format",
    options=tuple((ending, title) for title, ending in KINDS),
    hint="PNG has pixels; SVG and PDF have lines and letters, for print",
)
LAYOUT = ChoiceSpec(
    label="For",
    options=((OWN, "Custom size"), *((layout.name, layout.title) for layout in LAYOUTS)),
    hint="Size for a paper column, a slide or a poster",
)
WIDTH, HEIGHT = number_named("width_of_picture"), number_named("height_of_picture")
DPI = number_named("dpi_of_picture")
COLOURS = ChoiceSpec(
    label="Colours",
    options=tuple((name, theme_label(name)) for name in THEMES),
    hint="Light for paper and most slides",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureOptions(fields.CheckedModel):
    """What the user is asked before a picture is written.

    Attributes
    ----------
    kind
        How its name ends.
    layout
        Name of a layout, or `OWN`.
    dpi
        Dots per inch of a PNG.
    colours
        Name of a theme.
    """

    kind: str = fields.choice(".png", KIND)
    layout: str = fields.choice(OWN, LAYOUT)
    width_px: int = fields.number(1200, WIDTH)
    height_px: int = fields.number(1800, HEIGHT)
    dpi: int = fields.number(PER_INCH, DPI)
    colours: str = fields.choice(LIGHT.name, COLOURS)

    @property
    def theme(self) -> Theme:
        """The colours."""
        return THEMES[self.colours]

    @property
    def unused(self) -> frozenset[str]:
        """Names of the fields that have no effect beside the values of the others."""
        sides = {"width_px", "height_px"} if self.layout != OWN else set()
        return frozenset(sides if self.kind == ".png" else {*sides, "dpi"})

    @property
    def size_text(self) -> str:
        """Width and height: of a page in mm, and of a PNG in pixels."""
        sides = self.width_px, self.height_px
        across, down = (round(side / PER_INCH * _MM_IN_INCH) for side in sides)
        text = f"{across} × {down} mm"
        if self.kind == ".png":
            wide, high = (round(side * self.dpi / PER_INCH) for side in sides)
            text += f", {wide} × {high} pixels"
        return text


@dataclass(frozen=True, slots=True)
class Remark:
    """A remark on a picture before it is written.

    Attributes
    ----------
    refuses
        Whether it says that the picture cannot be written at all.
    """

    text: str
    refuses: bool = False


#: Returns the remark on a picture with these options.
RemarkOf = Callable[[Any], Remark]


class PictureForm(QtWidgets.QWidget):
    """Fields of `PictureOptions`, or of a subclass of them.

    Parameters
    ----------
    options
        The options to begin with.
    most_px
        Pixels that the longer side may have: the resolution of a layout is lowered to it.
    remark
        Returns the remark on the present options; their size unless given.
    shape
        Usual width and height of the picture; those of ``options`` unless given.
    below
        Returns by how much the caption makes the page higher, px.

    Attributes
    ----------
    options
        The options as they are in the fields.
    """

    changed = Signal()

    def __init__(
        self,
        options: PictureOptions,
        *,
        most_px: int | None = None,
        remark: RemarkOf | None = None,
        shape: tuple[int, int] | None = None,
        below: Below | None = None,
    ) -> None:
        super().__init__()
        self.options, self._most_px, self._remark = options, most_px, remark
        self._usual, self._below = shape or (options.width_px, options.height_px), below
        self._cells: dict[str, FieldCell] = {}
        self._form = form_of(self)
        for name, spec in _specs(options).items():
            self._cells[name] = cell = FieldCell(name, spec)
            cell.set_value(getattr(options, name))
            cell.edited.connect(self._edit)
            self._form.addRow(cell.label, cell)
        self._show_rows()

    @property
    def remark(self) -> Remark:
        """What there is to say on the present options."""
        return (
            Remark(self.options.size_text) if self._remark is None else self._remark(self.options)
        )

    def _edit(self, name: str, value: object, _gesture: int | None) -> None:
        spec = specs_of(self.options)[name]
        if isinstance(value, float) and isinstance(spec, NumberSpec) and spec.whole:
            value = int(value)
        changes: dict[str, Any] = {name: value}
        layout = next((each for each in LAYOUTS if each.name == value), None)
        if name == "layout" and layout is not None:
            width, height = layout.size_px(self._usual, self._below)
            dpi = layout.dpi
            if self._most_px is not None:
                dpi = min(dpi, self._most_px * PER_INCH // max(width, height))
            changes |= {"width_px": width, "height_px": height, "dpi": dpi}
        elif name in ("width_px", "height_px"):
            changes["layout"] = OWN
        self.options = replace(self.options, **changes)
        for other in changes.keys() - {name}:
            self._cells[other].set_value(getattr(self.options, other))
        self._show_rows()
        self.changed.emit()

    def _show_rows(self) -> None:
        for name, cell in self._cells.items():
            self._form.setRowVisible(cell, name not in self.options.unused)


def _specs(options: PictureOptions) -> dict[str, Spec]:
    """Return the specifications of all fields: content first, size last."""
    usual, every = specs_of(PictureOptions), specs_of(options)
    names = [*(name for name in every if name not in usual), *usual]
    return {name: every[name] for name in names}
