"""The hand that inputs are placed on, turned palm up and ready to be painted."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import (
    QColor,
    QLinearGradient,
    QPainter,
    QPainterPath,
    QPen,
    QPixmap,
    QPolygonF,
    QTransform,
)

from skinsource.limbs.hand import HandShape
from skinsource.limbs.locations import DIGITS
from skinsource_gui.theme import Theme

#: How much of the arm is drawn below the wrist, and where it begins to fade, in outline px.
_ARM_PX = 52.0
_FADE_PX = 12.0
# Widths, px, and opacity of the soft shade along the edge.
_SHADES = ((26.0, 0.05), (17.0, 0.06), (10.0, 0.07), (5.0, 0.08))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HandDrawing:
    """A palm in outline pixels, x right, y down; 400 of them make a hand.

    Attributes
    ----------
    outline, creases
        What is filled and what is drawn on it.
    bounds
        The hand and a bit of the arm.
    sites : (n_sites, 2)
        Input places; of 1 to 5 of the published limbs the very end of the digit.
    pushes : (n_sites, 2)
        Unit vectors along which in-axis contacts push; zero for perpendicular ones.
    limb
        Whose places they are, for their names.
    side
        Which hand this is, in words.
    spacing : (n_sites,)
        How far off the nearest other site is, where markers shrink so as not to cover each other;
        infinite where there is room for all.
    contacts
        Whether it is known how contacts push.
    fade
        Where the picture begins and ends to fade, y; None: it does not.
    """

    outline: QPainterPath
    creases: QPainterPath
    bounds: QRectF
    sites: NDArray[np.float64]
    pushes: NDArray[np.float64]
    spacing: NDArray[np.float64]
    limb: str = ""
    side: str = "Right hand,\npalm side"
    contacts: bool = True
    fade: tuple[float, float] | None = (_FADE_PX, _ARM_PX)


def palmar_drawing(shape: HandShape) -> HandDrawing:
    """Turn a hand seen from its back around its long axis."""

    def palmar(points: NDArray[np.float64]) -> NDArray[np.float64]:
        # Seen from the palm, left and right change places; on screen y points down.
        return shape.wrist - points

    outline, creases = QPainterPath(), QPainterPath()
    outline.addPolygon(polygon(palmar(shape.outline)))
    outline.closeSubpath()
    for line in shape.creases:
        creases.addPolygon(polygon(palmar(line)))
    sites, pushes = palmar(shape.input_positions), np.zeros((len(shape.input_positions), 2))
    for digit, axis in zip(range(len(DIGITS)), shape.digit_axes, strict=True):
        sites[digit] = palmar(axis[-1])
        inwards = palmar(axis[-2]) - sites[digit]
        pushes[digit] = inwards / np.linalg.norm(inwards)
    shown = palmar(shape.outline)
    shown = shown[shown[:, 1] < _ARM_PX]
    left, top = shown.min(axis=0)
    return HandDrawing(
        outline=outline,
        creases=creases,
        bounds=QRectF(QPointF(left, top), QPointF(float(shown[:, 0].max()), _ARM_PX)),
        sites=sites,
        pushes=pushes,
        spacing=np.full(len(sites), np.inf),
    )


def hand_pixmap(
    drawing: HandDrawing, transform: QTransform, size: QSize, ratio: float, theme: Theme
) -> QPixmap:
    """The hand alone, without its sites, on a clear ground.

    Parameters
    ----------
    transform
        From the drawing's outline pixels to the widget's pixels.
    size, ratio
        Of the widget, and device pixels per widget pixel.
    """
    pixmap = QPixmap(size * ratio)
    pixmap.setDevicePixelRatio(ratio)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    outline, line = transform.map(drawing.outline), QColor(theme.skin_line)
    painter.fillPath(outline, QColor(theme.skin))
    painter.save()
    painter.setClipPath(outline)
    scale = transform.m11()
    for width, opacity in _SHADES:
        painter.strokePath(outline, _pen(line, opacity, width * scale))
    painter.restore()
    painter.strokePath(transform.map(drawing.creases), _pen(line, 0.5, max(1.0, 1.7 * scale)))
    painter.strokePath(outline, _pen(line, 1.0, max(1.25, 2.0 * scale)))
    if drawing.fade is not None:
        wrist, end = (transform.map(QPointF(0.0, y)).y() for y in drawing.fade)
        fade = QLinearGradient(0.0, wrist, 0.0, end)
        fade.setColorAt(0.0, Qt.GlobalColor.black)
        fade.setColorAt(1.0, Qt.GlobalColor.transparent)
        painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_DestinationIn)
        painter.fillRect(QRectF(QPointF(0.0, 0.0), size.toSizeF()), fade)
    painter.end()
    return pixmap


#: The same for the screen: a window that opens in a size there was before does not draw it anew.
kept_hand_pixmap = lru_cache(maxsize=2)(hand_pixmap)


def polygon(points: NDArray[np.float64]) -> QPolygonF:
    """Points as Qt has them."""
    return QPolygonF([QPointF(x, y) for x, y in points])


def _pen(colour: QColor, opacity: float, width: float) -> QPen:
    faint = QColor(colour)
    faint.setAlphaF(opacity)
    cap, join = Qt.PenCapStyle.RoundCap, Qt.PenJoinStyle.RoundJoin
    return QPen(faint, width, Qt.PenStyle.SolidLine, cap, join)
