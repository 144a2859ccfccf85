"""Where a drawing lies on the screen."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from PySide6.QtCore import QPointF, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen, QPolygonF, QTransform

from skinsource.base.arrays import Floats
from skinsource_gui.qt.theme import Theme, is_on_paper

# So far from the middle of the room the nearest of an outline may be, in smaller sides of it.
_REACH = 0.2


@dataclass(frozen=True, slots=True, kw_only=True)
class Frame:
    """From a drawing to screen pixels.

    Attributes
    ----------
    scale
        Screen pixels in a unit of the drawing.
    left, top
        Screen place of the drawing's origin.
    up
        Whether y of the drawing points up; on the screen it points down.
    """

    scale: float
    left: float
    top: float
    up: bool = False

    def transform(self) -> QTransform:
        """The same as a transformation."""
        return QTransform(self.scale, 0, 0, self._y_scale, self.left, self.top)

    def to_screen(self, places: Floats) -> Floats:
        """Screen places, (n, 2), of places of the drawing, (n, 2)."""
        return places * (self.scale, self._y_scale) + (self.left, self.top)

    def to_drawing(self, point: QPointF) -> tuple[float, float]:
        """Place of the drawing at a screen point."""
        return (point.x() - self.left) / self.scale, (point.y() - self.top) / self._y_scale

    def zoomed(self, factor: float, about: QPointF) -> "Frame":
        """Frame magnified around a screen point that stays where it is."""
        return replace(
            self,
            scale=self.scale * factor,
            left=about.x() + (self.left - about.x()) * factor,
            top=about.y() + (self.top - about.y()) * factor,
        )

    def moved(self, dx: float, dy: float) -> "Frame":
        """Frame shifted by screen pixels."""
        return replace(self, left=self.left + dx, top=self.top + dy)

    def kept_in_sight(self, outline: Floats, room: QRectF) -> "Frame":
        """Frame shifted as little as it takes to see the outline, or its inside, in ``room``.

        Parameters
        ----------
        outline : (n, 2)
            Polygon, in the drawing's units.
        room
            On the screen.
        """
        middle = QPointF(*self.to_drawing(room.center()))
        polygon = QPolygonF([QPointF(x, y) for x, y in outline])
        if polygon.containsPoint(middle, Qt.FillRule.OddEvenFill):
            return self
        offsets = self.to_screen(outline) - (room.center().x(), room.center().y())
        distances = np.hypot(*offsets.T)
        nearest = int(np.argmin(distances))
        reach = _REACH * min(room.width(), room.height())
        if distances[nearest] <= reach:
            return self
        back = offsets[nearest] * (reach / distances[nearest] - 1.0)
        return self.moved(float(back[0]), float(back[1]))

    @property
    def _y_scale(self) -> float:
        return -self.scale if self.up else self.scale


def fitted(bounds: QRectF, room: QRectF, *, up: bool = False) -> Frame:
    """The frame in which ``bounds`` fills ``room``, centred."""
    scale = max(min(room.width() / bounds.width(), room.height() / bounds.height()), 1e-3)
    return Frame(
        scale=scale,
        left=room.center().x() - scale * bounds.center().x(),
        top=room.center().y() + (scale if up else -scale) * bounds.center().y(),
        up=up,
    )


# The frame around what has the keyboard.


def paint_focus_frame(painter: QPainter, area: QRectF, theme: Theme) -> None:
    """Draw the frame just inside ``area``; in a picture there is none."""
    if is_on_paper():
        return
    painter.setPen(QPen(QColor(theme.accent), 1))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawRect(area.adjusted(0.5, 0.5, -0.5, -0.5))


# A picture of what is slow to paint and rarely different.


class Same:
    """Stands for a thing in what a picture depends on: equal only to itself, however it compares.

    It keeps the thing, so that no other one takes its place in memory.
    """

    __slots__ = ("_thing",)

    def __init__(self, thing: object) -> None:
        self._thing = thing

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Same) and self._thing is other._thing

    def __hash__(self) -> int:
        return id(self._thing)


class PaintedAnew:
    """Paints each time; for pages and files, where lines stay lines."""

    def paint(
        self,
        painter: QPainter,
        room: QRectF,
        depends_on: tuple[object, ...],
        paint_anew: Callable[[QPainter], None],
    ) -> None:
        """Paint what ``paint_anew`` paints, as `KeptPicture.paint` does."""
        painter.save()
        paint_anew(painter)
        painter.restore()


class CachedPicture:
    """Remembers how something was painted, and paints it so again until it looks different."""

    def __init__(self) -> None:
        self._key: tuple[object, ...] = ()
        self._image, self._at = QImage(), QPointF()

    @property
    def kept_px(self) -> int:
        """How many pixels are painted each time."""
        return self._image.width() * self._image.height()

    def paint(
        self,
        painter: QPainter,
        room: QRectF,
        depends_on: tuple[object, ...],
        paint_anew: Callable[[QPainter], None],
        ground: QColor | None = None,
    ) -> None:
        """Paint into ``room`` what ``paint_anew`` paints there.

        Parameters
        ----------
        painter
            Its font and hints are those of the picture.
        room
            What the picture covers.
        depends_on
            Whatever it shows, besides room, font and resolution.
        paint_anew
            Called only when there is no such picture yet.
        ground
            Colour under it; ``None``: what was painted before stays visible.
        """
        if is_on_paper():
            if ground is not None:
                painter.fillRect(room, ground)
            PaintedAnew().paint(painter, room, depends_on, paint_anew)
            return
        ratio, font = painter.device().devicePixelRatioF(), painter.font()
        key = (*depends_on, room, ratio, font, ground)
        if key != self._key:
            self._key, self._at, self._image = key, QPointF(), QImage()
            size = (room.size() * ratio).toSize()
            # Of what is scrolled out of sight but for a line, nothing may be left; Qt cannot paint
            # on that.
            if not size.isEmpty():
                self._image = _blank(size, ground)
                self._image.setDevicePixelRatio(ratio)
                on_image = QPainter(self._image)
                on_image.setRenderHints(painter.renderHints())
                on_image.setFont(font)
                on_image.translate(-room.topLeft())
                paint_anew(on_image)
                on_image.end()
                if ground is None:
                    self._crop(ratio)
        if not self._image.isNull():
            painter.drawImage(room.topLeft() + self._at, self._image)

    def _crop(self, ratio: float) -> None:
        """Keep no more than what is painted: what is transparent costs as much as what is not."""
        painted = _painted(self._image)
        self._at = QPointF(painted.x() / ratio, painted.y() / ratio)
        self._image = self._image.copy(painted) if painted.isValid() else QImage()


def _painted(image: QImage) -> QRect:
    """The smallest part that holds all that is not transparent; not valid where there is none."""
    pixels = np.frombuffer(image.constBits(), np.uint32).reshape(image.height(), -1)
    rows, columns = np.flatnonzero(pixels.any(axis=1)), np.flatnonzero(pixels.any(axis=0))
    if not rows.size:
        return QRect()
    left, top = int(columns[0]), int(rows[0])
    return QRect(left, top, int(columns[-1]) - left + 1, int(rows[-1]) - top + 1)


def _blank(size: QSize, ground: QColor | None) -> QImage:
    opaque = ground is not None
    shape = QImage.Format.Format_RGB32 if opaque else QImage.Format.Format_ARGB32_Premultiplied
    image = QImage(size, shape)
    image.fill(ground if opaque else Qt.GlobalColor.transparent)
    return image


# Where something goes that is dropped on a panel.


@dataclass(frozen=True, slots=True, kw_only=True)
class DropPlace:
    """An input place, or a track that there is already, and a time on it.

    Attributes
    ----------
    location
        Place of a new input.
    input_id
        Of the track that takes a clip; it goes before ``location``.
    onset_s
        When that starts.
    """

    location: int | None = None
    input_id: int | None = None
    onset_s: float = 0.0
