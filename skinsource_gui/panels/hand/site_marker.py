"""Marks of input sites: circles push into the skin, triangles push along a digit."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPainterPath, QPen

from skinsource_gui.theme import Theme, tabular

# Corner radius and circumradius of the triangle, in radii of the circle: about the same area.
_TRIANGLE_RADII, _ROUNDING = 1.42, 0.3
# How far further inputs at a site peep out behind the first, in radii.
_STEP_RADII = 0.3
_MOST_BEHIND = 2
# Size of a site without a number, in radii; of one that is small anyway it is larger.
_DOT_RADII, _DOT_PX = 0.34, 3.5
# Of numbers: the smallest letters, and what each digit needs of the radius, in their height.
_LETTERS_PX, _DIGIT = 9.0, 0.33
#: Radius of the smallest site in use.
_IN_USE_PX = 8.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """Where a marker is painted.

    Attributes
    ----------
    site
        Number written into it.
    centre, radius_px
        Of the circle.
    push
        Direction of an in-axis contact, which makes a triangle; ``None``: a circle.
    """

    site: int
    centre: QPointF
    radius_px: float
    push: QPointF | None

    def path(self, extra_px: float = 0.0) -> QPainterPath:
        """Outline of the marker, grown by ``extra_px``."""
        if self.push is None:
            path = QPainterPath()
            radius = self.radius_px + extra_px
            path.addEllipse(self.centre, radius, radius)
            return path
        # Edges of a triangle move out by half of what its corners do.
        size = _TRIANGLE_RADII * self.radius_px + 2 * extra_px
        across = QPointF(-self.push.y(), self.push.x())
        base = self.centre - self.push * (size / 2)
        half = across * (size * 0.866)
        return _rounded([self.centre + self.push * size, base + half, base - half])


def least_radius_px(site: int) -> float:
    """The smallest radius of a site that is in use: its number fits in."""
    return max(_IN_USE_PX, _DIGIT * len(str(site)) * _LETTERS_PX)


def has_room(place: Place) -> bool:
    """Whether a number fits into a marker."""
    return place.radius_px >= max(_DIGIT * len(str(place.site)), 0.5) * _LETTERS_PX


def paint_empty(painter: QPainter, place: Place, theme: Theme, *, inviting: bool) -> None:
    """A quiet site; ``inviting`` while something is being moved over the hand."""
    fill = QColor(theme.base)
    fill.setAlphaF(0.85 if inviting else 0.55)
    line = QColor(theme.accent if inviting else theme.skin_line)
    pen = QPen(line, 1.25)
    if inviting:
        pen.setDashPattern([3.0, 3.0])
    painter.setPen(pen)
    painter.setBrush(fill)
    painter.drawPath(place.path())
    _paint_number(painter, place, QColor(theme.text), bold=False)


def paint_dot(painter: QPainter, place: Place, theme: Theme) -> None:
    """A quiet site without its number, where that would only hide the hand."""
    fill = QColor(theme.base)
    fill.setAlphaF(0.7)
    painter.setPen(QPen(QColor(theme.skin_line), 1.25))
    painter.setBrush(fill)
    radius = max(_DOT_RADII * place.radius_px, min(place.radius_px, _DOT_PX))
    painter.drawPath(replace(place, radius_px=radius).path())


def paint_hovered(painter: QPainter, place: Place, theme: Theme) -> None:
    """An empty site under the mouse, or one that takes what is dropped."""
    painter.setPen(QPen(QColor(theme.accent), 2.0))
    painter.setBrush(QColor(theme.base))
    painter.drawPath(place.path())
    _paint_number(painter, place, QColor(theme.text), bold=True)


def paint_occupied(
    painter: QPainter,
    place: Place,
    theme: Theme,
    colours: Sequence[QColor],
    *,
    silent: bool,
) -> None:
    """A site that holds inputs of these colours, the first one in front.

    A silent input is hollow: its colour is at the rim.  More than one are stacked and counted.
    """
    step = QPointF(1.0, -1.0) * place.radius_px * _STEP_RADII
    halo = QPen(QColor(theme.base), 1.5)
    behind = list(enumerate(colours))[1 : _MOST_BEHIND + 1]
    for depth, colour in reversed(behind):
        path = place.path().translated(step * depth)
        painter.setPen(halo)
        painter.setBrush(colour)
        painter.drawPath(path)
    front = colours[0]
    painter.setPen(QPen(front, 3.0) if silent else halo)
    painter.setBrush(_mixed(front, QColor(theme.base), 0.25) if silent else front)
    painter.drawPath(place.path(-1.0 if silent else 0.0))
    words = QColor(theme.text) if silent else readable_on(front)
    _paint_number(painter, place, words, bold=True)
    if len(colours) > 1:
        corner = place.centre + QPointF(1.0, 1.0) * place.radius_px * 0.95
        _paint_count(painter, corner, place.radius_px, len(colours), theme)


def paint_selection(painter: QPainter, place: Place, theme: Theme, *, last: bool = True) -> None:
    """The ring around a selected input, strong around the one that was selected last."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(QColor(theme.base), 6.0))
    painter.drawPath(place.path(3.0))
    painter.setPen(QPen(QColor(theme.accent), 2.5 if last else 1.2))
    painter.drawPath(place.path(3.5))


def paint_cursor(painter: QPainter, place: Place, theme: Theme) -> None:
    """The dashed ring of the keyboard's cursor."""
    radius = place.radius_px * (1.0 if place.push is None else 1.3) + 7.5
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(QColor(theme.base), 4.0))
    painter.drawEllipse(place.centre, radius, radius)
    pen = QPen(QColor(theme.accent), 2.0)
    pen.setDashPattern([3.0, 2.0])
    painter.setPen(pen)
    painter.drawEllipse(place.centre, radius, radius)


def readable_on(ground: QColor) -> QColor:
    """Black or white, whichever is read better on ``ground``."""
    choice = (QColor(Qt.GlobalColor.white), QColor(Qt.GlobalColor.black))
    return max(choice, key=lambda words: contrast(words, ground))


def contrast(one: QColor, other: QColor) -> float:
    """Contrast ratio of two colours, 1 to 21 (WCAG 2.1)."""
    darker, lighter = sorted((_luminance(one), _luminance(other)))
    return (lighter + 0.05) / (darker + 0.05)


def _luminance(colour: QColor) -> float:
    def linear(share: float) -> float:
        return share / 12.92 if share <= 0.03928 else ((share + 0.055) / 1.055) ** 2.4

    red, green, blue = (linear(s) for s in (colour.redF(), colour.greenF(), colour.blueF()))
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def _mixed(one: QColor, other: QColor, share: float) -> QColor:
    red, green, blue = (
        share * a + (1 - share) * b
        for a, b in (
            (one.redF(), other.redF()),
            (one.greenF(), other.greenF()),
            (one.blueF(), other.blueF()),
        )
    )
    return QColor.fromRgbF(red, green, blue)


def _rounded(corners: list[QPointF]) -> QPainterPath:
    path = QPainterPath()
    for number, corner in enumerate(corners):
        before = corners[number - 1]
        after = corners[(number + 1) % len(corners)]
        start = corner + (before - corner) * _ROUNDING
        if number == 0:
            path.moveTo(start)
        else:
            path.lineTo(start)
        path.quadTo(corner, corner + (after - corner) * _ROUNDING)
    path.closeSubpath()
    return path


def _paint_number(painter: QPainter, place: Place, colour: QColor, *, bold: bool) -> None:
    centre = place.centre
    if place.push is not None:
        # The triangle is wider at its base.
        centre = centre - place.push * (0.12 * place.radius_px)
    # As large as its place, unless it has many digits.
    most = 1.0 / (_DIGIT * len(str(place.site)))
    size = place.radius_px * min(1.05 if place.push is None else 1.0, most)
    _paint_text(painter, centre, str(place.site), size, colour, bold=bold)


def _paint_count(
    painter: QPainter, centre: QPointF, radius_px: float, count: int, theme: Theme
) -> None:
    size = max(9.0, 0.72 * radius_px)
    words = f"×{count}"
    width = QFontMetricsF(_number_font(painter, size, bold=True)).horizontalAdvance(words)
    # A large count makes a longer badge: digits out of sight would make it another number.
    half = QPointF(max(0.95 * size, width / 2 + 0.3 * size), 0.68 * size)
    area = QRectF(centre - half, centre + half)
    painter.setPen(QPen(QColor(theme.base), 1.0))
    painter.setBrush(QColor(theme.text))
    painter.drawRoundedRect(area, half.y(), half.y())
    _paint_text(painter, centre, words, size, QColor(theme.base), bold=True)


def _paint_text(
    painter: QPainter, centre: QPointF, text: str, size_px: float, colour: QColor, *, bold: bool
) -> None:
    font = _number_font(painter, size_px, bold=bold)
    metrics = QFontMetricsF(font)
    painter.setFont(font)
    painter.setPen(colour)
    # Digits have no descenders: their middle is half a capital above the baseline.
    left = centre.x() - metrics.horizontalAdvance(text) / 2
    painter.drawText(QPointF(left, centre.y() + metrics.capHeight() / 2), text)


def _number_font(painter: QPainter, size_px: float, *, bold: bool) -> QFont:
    font = tabular(painter.font())
    font.setPixelSize(max(round(_LETTERS_PX), round(size_px)))
    font.setWeight(QFont.Weight.Bold if bold else QFont.Weight.Medium)
    return font
