"""The skin map as a picture for a page or a slide."""

from dataclasses import dataclass, replace

from PySide6 import QtGui
from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt

from skinsource.design.design import Design
from skinsource.design.labels import limb_label
from skinsource.limbs.limb import LimbMap
from skinsource.limbs.own_limbs import facts_of
from skinsource.signals.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource_gui.panels.skin.content import MapContent
from skinsource_gui.panels.skin.layout import ALL, VisiblePart, map_layout
from skinsource_gui.panels.skin.map import paint_map_texts
from skinsource_gui.panels.skin.painting import MapPainter, small_font
from skinsource_gui.panels.skin.scale import scale_of
from skinsource_gui.panels.skin.settings import PEOPLE, SENSATION, MapQuantity
from skinsource_gui.plots.outputs import is_placed
from skinsource_gui.plots.small_map import paint_scale_row, scale_row_px
from skinsource_gui.qt.theme import Theme, on_paper, scaled, tabular

#: What strokes over a map mean.
HATCHED = f"hatched: less than {LEAST_ABOVE_NOISE_DB:g} dB above the noise"
# Lines of text in the height of the picture, also of one that is wide; the limits of a line, px.
_LINES, _WIDE_LINES = 48, 32
_SMALLEST_FONT_PX, _LARGEST_FONT_PX = 9, 64
# Share of the height for each part of a heading; where it needs more, its font shrinks.
_HEADING_LINE = 0.06
# Size of the details, as a share of the font of the title.
_DETAILS = 0.8
_WRAPPED = Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop | Qt.TextFlag.TextWordWrap


@dataclass(frozen=True, slots=True, kw_only=True)
class Heading:
    """Title, details and note above a map."""

    title: str
    details: str
    note: str = ""


def heading_of(design: Design, quantity: MapQuantity, note: str = "") -> Heading:
    """Return the heading of a picture of the map."""
    drawn_on = "drawn on " if quantity.name == PEOPLE else ""
    parts = [f"{drawn_on}{limb_label(design.limb).title}", quantity.signal]
    band_hz = facts_of(design.limb).band_hz
    if quantity.name == SENSATION and band_hz is not None:
        parts.append(f"{band_hz[0]:g} to {band_hz[1]:g} Hz")
    return Heading(title=quantity.heading, details=" · ".join(parts), note=note)


def paint_picture(
    painter: QtGui.QPainter,
    size: QSizeF,
    content: MapContent,
    heading: Heading,
    theme: Theme,
    family: str,
    visible: VisiblePart = ALL,
) -> None:
    """Draw the map with heading, colour bar and, where due, the synthetic mark.

    Parameters
    ----------
    painter
        Of an image, a page or a drawing.
    size
        Of the picture, px.
    content, heading
        What the map shows, and how it is called.
    theme, family
        Colours, and the family of the font.
    seen
        What part of the map; all of it unless given.
    """
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    page = QRectF(0, 0, size.width(), size.height())
    painter.fillRect(page, QtGui.QColor(theme.base))
    font = QtGui.QFont(family)
    # The map is narrow: in a wide picture, as on a slide, text has more room.
    lines = _LINES if page.width() <= page.height() else _WIDE_LINES
    pixels = min(page.height() / lines, page.width() / _LINES * 1.6)
    font.setPixelSize(round(min(max(pixels, _SMALLEST_FONT_PX), _LARGEST_FONT_PX)))
    font = tabular(font)
    line = QtGui.QFontMetricsF(font).height()
    inner = page.adjusted(line, 0.6 * line, -line, -line)
    if _shows_hatches(content, inner, QtGui.QFontMetricsF(small_font(font)), visible):
        heading = replace(heading, details=f"{heading.details} · {HATCHED}")
    inner.setTop(_paint_heading(painter, inner, heading, font, theme) + 0.4 * line)
    painter.setFont(small_font(font))
    scale_px = scale_row_px(painter.fontMetrics().height())
    room = inner.adjusted(0, 0, 0, -scale_px - 0.5 * line)
    if content.limb_map is not None:
        _paint_map(painter, content, content.limb_map, room, theme, visible)
    painter.setFont(small_font(font))
    below = QRectF(inner.left(), inner.bottom() - scale_px, inner.width(), scale_px)
    paint_scale_row(painter, below, scale_of(content), theme)
    painter.setFont(font)
    paint_map_texts(painter, content, room, theme)


def _shows_hatches(
    content: MapContent, room: QRectF, metrics: QtGui.QFontMetricsF, visible: VisiblePart
) -> bool:
    """Return whether an output that is mostly noise is in sight."""
    if content.limb_map is None or not content.hatched:
        return False
    places = content.limb_map.output_positions
    points = visible.frame_in(content.limb_map, room, metrics).to_screen(places)
    placed = [number for number in content.hatched if is_placed(places, number)]
    return any(room.contains(QPointF(*points[number - 1])) for number in placed)


def heading_font(font: QtGui.QFont, text: str, area: QRectF) -> QtGui.QFont:
    """Return a copy of ``font``, shrunk until the wrapped ``text`` fits into ``area``."""
    copy = QtGui.QFont(font)
    while copy.pixelSize() > 1:
        needed = QtGui.QFontMetricsF(copy).boundingRect(QRectF(area), int(_WRAPPED), text)
        if needed.width() <= area.width() and needed.height() <= area.height():
            break
        copy.setPixelSize(copy.pixelSize() - 1)
    return copy


def _paint_heading(
    painter: QtGui.QPainter, inner: QRectF, heading: Heading, font: QtGui.QFont, theme: Theme
) -> float:
    """Draw title, details and note; return where they end."""
    title_font = QtGui.QFont(font)
    title_font.setBold(True)
    top = inner.top()
    for text, usual, colour in (
        (heading.title, title_font, theme.text),
        (heading.details, scaled(font, _DETAILS), theme.dim),
        (heading.note, scaled(font, _DETAILS), theme.warning),
    ):
        if not text:
            continue
        area = QRectF(inner.left(), top, inner.width(), _HEADING_LINE * inner.height())
        painter.setFont(heading_font(usual, text, area))
        painter.setPen(QtGui.QColor(colour))
        painter.drawText(area, int(_WRAPPED), text)
        metrics = QtGui.QFontMetricsF(painter.font())
        top += metrics.boundingRect(area, int(_WRAPPED), text).height() + 0.15 * metrics.height()
    return top


def _paint_map(
    painter: QtGui.QPainter,
    content: MapContent,
    limb_map: LimbMap,
    room: QRectF,
    theme: Theme,
    visible: VisiblePart,
) -> None:
    metrics = QtGui.QFontMetricsF(painter.font())
    frame = visible.frame_in(limb_map, room, metrics)
    layout = map_layout(limb_map, frame, room, metrics)
    painter.save()
    # Magnified, the map would lie on heading and scale.
    # (On a fraction of a pixel, clipped paths would leave a line.)
    painter.setClipRect(QRectF(room.toAlignedRect()), Qt.ClipOperation.IntersectClip)
    with on_paper():
        MapPainter(limb_map).paint(painter, content, layout, theme)
    painter.restore()
