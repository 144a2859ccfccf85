"""Sizes of pictures for print and for the screen."""

import re
import zlib
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from math import ceil
from pathlib import Path
from typing import Any

from PySide6.QtCore import (
    QBuffer,
    QEvent,
    QIODevice,
    QMarginsF,
    QObject,
    QPoint,
    QPointF,
    QRect,
    QRectF,
    QSize,
    QSizeF,
)
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetricsF,
    QImage,
    QKeyEvent,
    QPageSize,
    QPainter,
    QPdfWriter,
    QPixmap,
    QRegion,
)
from PySide6.QtSvg import QSvgGenerator
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QGraphicsItem,
    QGraphicsView,
    QLabel,
    QWidget,
)

from skinsource.base.errors import StorageError
from skinsource.base.files import write_bytes
from skinsource.base.quoting import sentence
from skinsource.base.work import counted
from skinsource.design.amplitudes import amplitude_text
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, audible_inputs
from skinsource.design.effects.effect import Effect
from skinsource.design.effects.level import UNCHANGED, Envelope
from skinsource.design.effects.time import Stretch
from skinsource.design.labels import SCALINGS, limb_word, word_of
from skinsource.specs import fields
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ChoiceSpec, Spec
from skinsource.studies import scenes
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.inputs import duration_text, full_label
from skinsource_gui.fields.number_field import FINISHERS, NumberField
from skinsource_gui.fields.units import minus
from skinsource_gui.qt.theme import LIGHT, THEMES, Theme, on_paper, set_tone, theme_label

#: Pixels in an inch of a page or a drawing, as in CSS.
PER_INCH = 96

#: Told width and height of a picture, px: how much higher a page is that has words below it.
Below = Callable[[int, int], int]


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """A size for a purpose.

    Attributes
    ----------
    name, title
        Short name; what the page says.
    width_in, height_in
        Inches; a height of 0 follows from the picture.
    dpi
        Dots in an inch of a PNG.
    """

    name: str
    title: str
    width_in: float
    height_in: float = 0.0
    dpi: int = 300

    def size_px(self, usual: tuple[int, int], below: Below | None = None) -> tuple[int, int]:
        """Width and height, px, of a picture that usually has the size ``usual``.

        Where the height follows from the picture, what stands ``below`` comes to it.
        """
        width = round(self.width_in * PER_INCH)
        if self.height_in:
            return width, round(self.height_in * PER_INCH)
        height = max(round(width * usual[1] / usual[0]), 100)
        return width, height + (0 if below is None else below(width, height))


#: Columns are those of IEEE's journals; a poster's figure is as wide as a sheet of A3.
LAYOUTS = (
    Layout(name="column", title="One column (89 mm)", width_in=3.5),
    Layout(name="two_columns", title="Two columns (182 mm)", width_in=7.16),
    Layout(name="slide", title="Slide (16 : 9)", width_in=13.333, height_in=7.5, dpi=144),
    Layout(name="poster", title="Poster (420 mm)", width_in=16.54),
)
#: What has none of these sizes.
OWN = "own"


def layout_of(name: str) -> Layout | None:
    """The layout of that name; None for a size of one's own."""
    return next((layout for layout in LAYOUTS if layout.name == name), None)


# Pages whose words are found by those who search and copy.

_LETTERS_OF_FONT = re.compile(rb"/ToUnicode (\d+) 0 R")
_TRAILER = re.compile(rb"trailer\s*<<(.*)>>\s*startxref\s*(\d+)\s*%%EOF\s*$", re.DOTALL)
_MEANINGS = re.compile(rb"\[.*?\]", re.DOTALL)
_TAB, _BLANK = b"<0009>", b"<0020>"


def searchable(pdf: bytes) -> bytes:
    """Return a page that Qt has written, with blanks between its words.

    A tab and a blank are one empty letter of a font, and Qt says of a letter the first thing that
    it stands for: a search for two words would find nothing.  What its fonts say is mended in an
    update at the end of the file, as the format has it; the page itself stays as it is.
    """
    end = _TRAILER.search(pdf)
    numbers = sorted({int(number) for number in _LETTERS_OF_FONT.findall(pdf)})
    mended = {number: _mended(pdf, number) for number in numbers}
    if end is None or not any(mended.values()):
        return pdf
    whole, places = bytearray(pdf), {}
    for number, letters in mended.items():
        if letters:
            places[number] = len(whole)
            whole += b"%d 0 obj\n<</Length %d>>\nstream\n" % (number, len(letters))
            whole += letters + b"\nendstream\nendobj\n"
    table = len(whole)
    rows = b"".join(b"%d 1\n%010d 00000 n \n" % place for place in places.items())
    whole += b"xref\n" + rows
    whole += b"trailer\n<<%s/Prev %s\n>>\nstartxref\n%d\n%%%%EOF\n" % (end[1], end[2], table)
    return bytes(whole)


def _mended(pdf: bytes, number: int) -> bytes:
    """What the letters of a font mean, with blanks; nothing where there is nothing to mend."""
    stream = re.search(
        rb"(?<!\d)%d 0 obj\s*<<(.*?)>>\s*stream\r?\n(.*?)\r?\nendstream" % number, pdf, re.DOTALL
    )
    if stream is None:
        return b""
    letters = zlib.decompress(stream[2]) if b"/FlateDecode" in stream[1] else stream[2]
    mended = _MEANINGS.sub(lambda meanings: meanings[0].replace(_TAB, _BLANK), letters)
    return b"" if mended == letters else mended


# Pictures are written whole or not at all.

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


# A widget that can be drawn for a page or a slide.


class Pictured(QWidget):
    """Draws itself as it is, unless it knows better."""

    def draw_picture(
        self, painter: QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """Draw what it shows for a page or a slide; size in px.

        Unless it knows better that is in the colours in use: whoever wants others sees to it that
        these are in use.
        """
        scale = min(width / max(self.width(), 1), height / max(self.height(), 1))
        painter.save()
        painter.fillRect(QRectF(0, 0, width, height), QColor(theme.base))
        painter.translate((width - scale * self.width()) / 2, 0.0)
        painter.scale(scale, scale)
        flags = QWidget.RenderFlag.DrawWindowBackground | QWidget.RenderFlag.DrawChildren
        with on_paper(), _as_lines(self):
            self.render(painter, QPoint(), QRegion(), flags)
        painter.restore()


@contextmanager
def _as_lines(widget: QWidget) -> Iterator[None]:
    """Have scenes drawn as lines and letters, not as the pictures that are kept of them."""
    views = widget.findChildren(QGraphicsView)
    grounds = {view: view.cacheMode() for view in views}
    kept = {
        item: item.cacheMode()
        for view in views
        for item in view.scene().items()
        if item.cacheMode() != QGraphicsItem.CacheMode.NoCache
    }
    for view in views:
        view.setCacheMode(QGraphicsView.CacheModeFlag.CacheNone)
    for item in kept:
        item.setCacheMode(QGraphicsItem.CacheMode.NoCache)
    try:
        yield
    finally:
        for view, ground in grounds.items():
            view.setCacheMode(ground)
        for item, mode in kept.items():
            item.setCacheMode(mode)


# A picture that can be drawn, and how large it usually is.

#: In place of the name of a panel: the one in use, and all that are in sight.
IN_USE, ALL_IN_SIGHT = "panel in use", "all panels in sight"

#: Asked for the height of letters, px, in a picture of that width and height.
Letters = Callable[[int, int], float]


@dataclass(frozen=True, slots=True, kw_only=True)
class WholePicture:
    """A picture that can be drawn.

    Attributes
    ----------
    draw
        Draws it, with a ``theme`` for its colours.
    title
        Of the panel that it shows; "" where that is more than one.
    caption
        The words below it, which are a part of what is drawn.
    size_px
        Width and height that it usually has; None: whoever wants it knows.
    seen
        What part of it is in sight, for whoever draws the same by other means; None: all of it.
    letters_px
        Height of its smallest letters where these shrink and grow with it; None: they do not.
    """

    draw: Draw
    title: str = ""
    caption: str = ""
    size_px: tuple[int, int] | None = None
    seen: object | None = None
    letters_px: Letters | None = None


# What is played, in the words that stand below a picture.

# Clips of one input, and inputs, that are told apart; more are counted.
_MOST_CLIPS, _MOST_INPUTS = 3, 6
#: Where a line may end: a number stays with its unit, and a unit is not broken at its slash.
BREAKS = re.compile(r"(?<!\d) | (?![^\W\d]|°)")
# What stands behind a number, or behind a word: a unit, and what parts it from what follows.
_BEHIND = re.compile(r"(?<=\d)(?:\s[^\d]*|[^\w.]*)$|[,;:.()]*$")

#: A design, and what it is called where it is shown.
Named = tuple[str, Design]


def stimulus_text(design: Design) -> str:
    """What is heard, where, how strong."""
    heard = audible_inputs(design.inputs)
    said = [_input_words(track, design) for track in heard[:_MOST_INPUTS]]
    if len(heard) > _MOST_INPUTS:
        said.append(f"and {counted(len(heard) - _MOST_INPUTS, 'more input')}")
    return "; ".join(said) or "Silent: nothing is driven"


def stimuli_text(named: Sequence[Named]) -> str:
    """The stimuli of designs side by side: what they have in common once, what differs of each.

    Where they are made alike, numbers that differ stand beside each other, ``"Tone 50/100 Hz"``,
    in the order of their names; else each is told by itself.
    """
    told = [stimulus_text(design) for _, design in named]
    if len(named) == 1:
        return told[0]
    names = [name for name, _ in named]
    words = [BREAKS.split(text) for text in told]
    if len({len(row) for row in words}) == 1:
        together = " ".join(_beside(column) for column in zip(*words, strict=True))
        return f"{_listed(names)}: {together}"
    return ". ".join(f"{name}: {text}" for name, text in zip(names, told, strict=True))


def common_title(titles: Sequence[str]) -> str:
    """What titles have in common, of their parts between middle dots; empty where it is nothing."""
    parts = [title.split(" · ") for title in titles]
    alike: list[str] = []
    for column in zip(*parts, strict=False):
        if len(set(column)) > 1:
            break
        alike.append(column[0])
    return " · ".join(alike)


def _listed(names: Sequence[str]) -> str:
    """``"Edited, Snapshots 1, 2"``: what the last names begin with is said once."""
    first = names[-1].partition(" ")[0]
    numbers = [name.removeprefix(f"{first} ") for name in names if name.startswith(f"{first} ")]
    before = names[: len(names) - len(numbers)]
    if len(numbers) < 2 or any(name.startswith(f"{first} ") for name in before):
        return ", ".join(names)
    return ", ".join((*before, f"{first}s {', '.join(numbers)}"))


def _beside(words: Sequence[str]) -> str:
    """``"50/100 Hz,"`` of ``"50 Hz,"`` and ``"100 Hz,"``."""
    if len(set(words)) == 1:
        return words[0]
    behind = {_behind(word) for word in words}
    if len(behind) > 1:
        return "/".join(words)
    [last] = behind
    return "/".join(word.removesuffix(last) for word in words) + last


def _behind(word: str) -> str:
    match = _BEHIND.search(word)
    return match[0] if match else ""


def _input_words(track: Input, design: Design) -> str:
    clips = [clip for clip in track.clips if not clip.muted]
    said = [_clip_words(clip) for clip in clips[:_MOST_CLIPS]]
    if len(clips) > _MOST_CLIPS:
        said.append(counted(len(clips) - _MOST_CLIPS, "more clip"))
    curve = f", with a gain curve {_points(track.gain_curve)}" if track.gain_curve else ""
    strength = amplitude_text(design, track)
    return f"Place {track.location}, {strength}{curve}: {', '.join(said) or 'no clips'}"


def _clip_words(clip: Clip) -> str:
    parts = full_label(clip.waveform), duration_text(clip.duration_s)
    onset = f"at {clip.onset_s * 1e3:g} ms" if clip.onset_s else ""
    gain = f"gain {clip.gain:g}" if clip.gain != 1.0 else ""
    effects = _effects_words(clip)
    through = f"through {', '.join(effects)}" if effects else ""
    return " ".join(part for part in (", ".join(parts), onset, gain, through) if part)


def _effects_words(clip: Clip) -> list[str]:
    """What a clip goes through, each in words, in their order."""
    said, lasts_s = [], clip.waveform.duration_s
    for effect in clip.effects:
        if effect.on and _changes(effect):
            said.append(_effect_words(effect, lasts_s))
        lasts_s = effect.length(lasts_s) if effect.on else lasts_s
    return said


def _effect_words(effect: Effect, lasts_s: float) -> str:
    """``"fade"``, ``"an envelope of 12 points"``, ``"stretch ×2"`` of what lasts so long."""
    if isinstance(effect, Envelope):
        return f"an envelope {_points(effect.points)}"
    if isinstance(effect, Stretch):
        kept = " that keeps frequencies" if effect.pitch == "stays" else ""
        return f"stretch ×{effect.factor_of(lasts_s):.3g}{kept}"
    return effect.title.lower()


def _changes(effect: Effect) -> bool:
    return not (isinstance(effect, Envelope) and effect.points == UNCHANGED)


def _points(curve: Sequence[object]) -> str:
    return f"of {counted(len(curve), 'point')}"


# What stands below a picture: the stimulus that it belongs to, and what it is not good for.

# Height of its letters, as a part of the smaller side of the picture, and their limits, px.
_PART, _SMALLEST_PX, _LARGEST_PX = 1 / 45, 8, 40
# It takes this part of the height, or its letters are smaller; as small as can be read it may take
# the larger part, and where that is too little, they are smaller still.
_PART_OF_HEIGHT, _MOST_OF_HEIGHT, _LEAST_PX = 0.16, 0.3, 5


def caption_of(
    design: Design,
    *,
    compared: Sequence[Named] = (),
    limbs: Sequence[str] = (),
    notes: Sequence[str] = (),
) -> str:
    """The stimulus in words, and the limb: what is heard, where, how strong.

    Parameters
    ----------
    design
        What is played.
    compared
        Designs that are shown side by side, with what they are called there; none: ``design`` is
        shown alone.
    limbs
        Names of limbs on which something is shown beside the design's own.
    notes
        Sentences on these limbs, and on what it is not good for; see
        `skinsource.perception.validity`.
    """
    named = compared or [("", design)]
    designs = [named_design for _, named_design in named]
    title = common_title([scenes.title_of(each) if each.title else "" for each in designs])
    first = f"{sentence(title)} " if title else ""
    scalings = dict.fromkeys(word_of(SCALINGS, each.scaling).title.lower() for each in designs)
    titles = [limb_word(limb_name).title for limb_name in dict.fromkeys((*(d.limb for d in designs), *limbs))]
    limb = f"Limb{'s' if len(titles) > 1 else ''}: {', '.join(titles)}"
    through = dict.fromkeys(each.actuated.words for each in designs if each.actuated is not None)
    driven = f"; predicted through {', '.join(through)}" if through else ""
    said_last = "".join(f" {note}" for note in notes)
    scaling = ", ".join(scalings)
    return minus(f"{first}{stimuli_text(named)}. {limb}; scaling: {scaling}{driven}.{said_last}")


def lines_of(words: str, metrics: QFontMetricsF, room_px: float) -> list[str]:
    """Break ``words`` into lines that have room; a number and its unit stay together."""
    lines: list[str] = []
    for part in BREAKS.split(words):
        longer = f"{lines[-1]} {part}" if lines else part
        if lines and metrics.horizontalAdvance(longer) <= room_px:
            lines[-1] = longer
        else:
            lines.append(part)
    return lines


def with_caption(draw: Draw, words: str) -> Draw:
    """Return what draws a picture with ``words`` below; without any, all of it is the picture."""
    return partial(_draw, draw, words) if words else draw


def caption_px(words: str, width: int, height: int) -> int:
    """How much higher a page is than a picture of this size, so that ``words`` have room below."""
    if not words:
        return 0
    font, more = QFont(), 0
    for _ in range(4):
        # Letters and edges grow with the page, a little less each time.
        edge = _edge_px(width, height + more)
        font.setPixelSize(_letters_px(width, height + more))
        lines = lines_of(words, QFontMetricsF(font), width - 2 * edge)
        more = ceil(_height(lines, font) + 1.5 * edge)
    return more


def _draw(
    draw: Callable[..., None],
    words: str,
    painter: QPainter,
    width: int,
    height: int,
    theme: Theme = LIGHT,
) -> None:
    lines, font, left, edge = _laid_out(words, painter.font(), width, height)
    painter.fillRect(QRectF(0, 0, width, height), QColor(theme.base))
    painter.save()
    draw(painter, width, left, theme=theme)
    painter.restore()
    painter.setFont(font)
    painter.setPen(QColor(theme.dim))
    # Line by line: on a page of more dots lines of a text would stand a little further apart.
    metrics = QFontMetricsF(font)
    first = left + edge / 2 + metrics.ascent()
    for row, line in enumerate(lines):
        painter.drawText(QPointF(edge, first + row * metrics.lineSpacing()), line)


def height_above(words: str, font: QFont, width: int, height: int) -> int:
    """What `with_caption` leaves of the height for the picture itself."""
    return _laid_out(words, font, width, height)[2] if words else height


def _laid_out(
    words: str, font: QFont, width: int, height: int
) -> tuple[list[str], QFont, int, float]:
    """Lines and letters of the caption, where it begins, and its edge; px."""
    font = QFont(font)
    edge = _edge_px(width, height)
    room_px = width - 2 * edge
    font.setPixelSize(_letters_px(width, height))
    lines = lines_of(words, QFontMetricsF(font), room_px)
    for part, least_px in ((_PART_OF_HEIGHT, _SMALLEST_PX), (_MOST_OF_HEIGHT, _LEAST_PX)):
        while _height(lines, font) > part * height and font.pixelSize() > least_px:
            font.setPixelSize(font.pixelSize() - 1)
            lines = lines_of(words, QFontMetricsF(font), room_px)
    while _height(lines, font) > _MOST_OF_HEIGHT * height and len(words) > 1:
        words = f"{words[: int(0.9 * len(words)) - 1].rstrip('…')}…"
        lines = lines_of(words, QFontMetricsF(font), room_px)
    left = max(int(height - _height(lines, font) - 1.5 * edge), 1)
    return lines, font, left, edge


def _edge_px(width: float, height: float) -> float:
    return 0.02 * min(width, height)


def _letters_px(width: float, height: float) -> int:
    return min(max(round(min(width, height) * _PART), _SMALLEST_PX), _LARGEST_PX)


def _height(lines: Sequence[str], font: QFont) -> float:
    return len(lines) * QFontMetricsF(font).lineSpacing()


# How large a picture is, and in which colours.

LAYOUT = ChoiceSpec(
    label="For",
    options=((OWN, "A size of its own"), *((layout.name, layout.title) for layout in LAYOUTS)),
    hint="Width and height for a column of a paper, a slide, or a poster",
)
_SIDE: dict[str, Any] = {
    "unit": "px",
    "minimum": 100,
    "maximum": 20000,
    "step": 100.0,
    "whole": True,
}
_HINT = "Of pixels; in SVG and PDF 96 of them are an inch"
WIDTH = NumberSpec(label="Width", hint=_HINT, **_SIDE)
HEIGHT = NumberSpec(label="Height", hint=_HINT, **_SIDE)
DPI = NumberSpec(
    label="Resolution",
    unit="dpi",
    minimum=24,
    maximum=2400,
    step=10.0,
    whole=True,
    hint="Dots in an inch of a PNG; at 96 dpi it has as many pixels as width and height say. SVG "
    "and PDF are lines, and have none",
)
COLOURS = ChoiceSpec(
    label="Colours",
    options=tuple((name, theme_label(name)) for name in THEMES),
    hint="Light for paper and most slides",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureOptions:
    """What is asked before a picture is written.

    Attributes
    ----------
    layout
        Name of a layout, or `OWN`.
    width_px, height_px
        Its size.
    dpi
        Dots in an inch of a PNG.
    colours
        Name of a theme.
    """

    layout: str = fields.choice(OWN, LAYOUT)
    width_px: int = fields.number(1200, WIDTH)
    height_px: int = fields.number(1800, HEIGHT)
    dpi: int = fields.number(PER_INCH, DPI)
    colours: str = fields.choice(LIGHT.name, COLOURS)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def theme(self) -> Theme:
        """The colours."""
        return THEMES[self.colours]

    @property
    def unused(self) -> frozenset[str]:
        """Names of the fields that say nothing beside the values of the others."""
        return frozenset()

    @property
    def pixels_words(self) -> str:
        """How many pixels it has where it is made of pixels."""
        across, down = (round(side_px * self.dpi / PER_INCH) for side_px in (self.width_px, self.height_px))
        return f"In pixels: {across} × {down}"


@dataclass(frozen=True, slots=True)
class Remark:
    """What is to be known of a picture before it is written.

    Attributes
    ----------
    words
        Sentences.
    warns, refuses
        Whether it will not be as it is wanted; whether it cannot be written at all.
    """

    words: str
    warns: bool = False
    refuses: bool = False


#: Asked for what is to be known of a picture with these options.
RemarkOf = Callable[[Any], Remark]


class PictureDialog(QDialog):
    """Lets the user change `PictureOptions`, or what more than these a picture takes.

    Parameters
    ----------
    options
        To begin with.
    title, kinds
        Of the window; what can be written, in words, unless that is among the options.
    most_px
        Pixels that the longer side may have: the resolution of a layout is lowered to it.
    remark
        Says what else is to be known before it is written.
    shape
        Width and height that the picture usually has; those of ``options`` unless given.
    below
        Says how much higher a page is that has words below the picture.

    Attributes
    ----------
    options
        As they are in the fields.
    pixels
        Says how many pixels the file has: width and height are those of an inch of a page.
    said
        What is to be known besides.
    """

    def __init__(
        self,
        options: PictureOptions,
        parent: QWidget | None = None,
        *,
        title: str = "Picture",
        kinds: str = "PNG, SVG or PDF",
        most_px: int | None = None,
        remark: RemarkOf | None = None,
        shape: tuple[int, int] | None = None,
        below: Below | None = None,
    ) -> None:
        super().__init__(parent)
        self.options, self._most_px, self._remark = options, most_px, remark
        self._usual, self._below = shape or (options.width_px, options.height_px), below
        self._cells: dict[str, FieldCell] = {}
        self.setWindowTitle(title)
        self._form = form = QFormLayout(self)
        for name, spec in _specs(options).items():
            self._cells[name] = self._cell(name, spec)
        self.pixels = QLabel()
        form.addRow(self.pixels)
        self.said = QLabel()
        self.said.setObjectName("picture_remark")
        self.said.setWordWrap(True)
        form.addRow(self.said)
        whether = f", and whether as {kinds}" if kinds else ""
        form.addRow(QLabel(f"The next step asks where to{whether}."))
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self._save = buttons.addButton("Save as…", QDialogButtonBox.ButtonRole.AcceptRole)
        self._save.setDefault(True)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        form.addRow(buttons)
        self._tell()

    def _cell(self, name: str, spec: Spec) -> FieldCell:
        cell = FieldCell(name, spec, self)
        cell.set_value(getattr(self.options, name))
        cell.edited.connect(self._take)
        cell.field.installEventFilter(self)
        self._form.addRow(cell.label, cell)
        return cell

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # In the studio's panels Enter begins to type; a dialog is done with it.
        if (
            isinstance(event, QKeyEvent)
            and event.type() == QEvent.Type.KeyPress
            and event.key() in FINISHERS
            and isinstance(watched, NumberField)
        ):
            if (not watched.editing or watched.commit()) and self._save.isEnabled():
                self.accept()
            return True
        return super().eventFilter(watched, event)

    def event(self, event: QEvent) -> bool:
        done = super().event(event)
        if event.type() == QEvent.Type.LayoutRequest:
            # A remark under a field may take several lines.
            needed = self._form.totalHeightForWidth(self.width())
            self.resize(self.width(), max(self.height(), needed))
        return done

    def _take(self, name: str, value: object, _gesture: int | None) -> None:
        spec = specs_of(self.options)[name]
        if isinstance(value, float) and isinstance(spec, NumberSpec) and spec.whole:
            value = int(value)
        changes: dict[str, Any] = {name: value}
        layout = layout_of(str(value)) if name == "layout" else None
        if layout is not None:
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
        self._tell()

    def _tell(self) -> None:
        """Say what follows from the options, and show the fields that say something with them."""
        for name, cell in self._cells.items():
            self._form.setRowVisible(cell, name not in self.options.unused)
        self.pixels.setText(self.options.pixels_words)
        remark = Remark("") if self._remark is None else self._remark(self.options)
        tones = {(True, False): "warning", (False, True): "error"}
        set_tone(self.said, tones.get((remark.warns, remark.refuses), ""))
        self.said.setText(remark.words)
        self._form.setRowVisible(self.said, bool(remark.words))
        self._save.setEnabled(not remark.refuses)


def _specs(options: PictureOptions) -> dict[str, Spec]:
    """Of all fields; what a picture shows stands above how large it is."""
    usual, every = specs_of(PictureOptions), specs_of(options)
    return {name: spec for name, spec in every.items() if name not in usual} | usual


def ask_picture_options(
    parent: QWidget, options: PictureOptions, **about: Any
) -> PictureOptions | None:
    """Let the user change ``options``; None if there is to be no picture.

    ``about`` is what `PictureDialog` takes besides.
    """
    dialog = PictureDialog(options, parent, **about)
    accepted = dialog.exec() == QDialog.DialogCode.Accepted
    dialog.deleteLater()
    return dialog.options if accepted else None


# Whether the letters of a picture can be read in print.

#: Journals take no smaller ones.
SMALLEST_PT = 5.0
_LETTERS_POINTS = 72.0
# A width that is said is a multiple of it.
_ROUND_PX = 10


def letters_remark(picture: WholePicture) -> RemarkOf | None:
    """What says how small letters become in print; None where they keep their size."""
    letters_px, usual = picture.letters_px, picture.size_px
    if letters_px is None or usual is None:
        return None
    return partial(_remark, letters_px, usual, partial(caption_px, picture.caption))


def _remark(
    letters_px: Letters, usual: tuple[int, int], below: Below, options: PictureOptions
) -> Remark:
    size_pt = _letters_points(letters_px, options.width_px, options.height_px)
    if size_pt >= SMALLEST_PT:
        return Remark("")
    needed_px = ceil(options.width_px * SMALLEST_PT / size_pt / _ROUND_PX) * _ROUND_PX
    large = [
        layout.title
        for layout in LAYOUTS
        if _letters_points(letters_px, *layout.size_px(usual, below)) >= SMALLEST_PT
    ]
    sizes = [f"a width of {needed_px} px", *large]
    choose = f"{', '.join(sizes[:-1])} or {sizes[-1]}" if large else sizes[0]
    return Remark(
        f"The smallest letters are {size_pt:.1f} pt high; to be read in print they need "
        f"{SMALLEST_PT:g} pt. Choose {choose}, hide some panels and make the window smaller, or "
        "export the panel in use.",
        warns=True,
    )


def _letters_points(letters_px: Letters, width: int, height: int) -> float:
    return letters_px(width, height) * _LETTERS_POINTS / PER_INCH
