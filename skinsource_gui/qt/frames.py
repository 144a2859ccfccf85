"""Frames of drawings on the screen, focus frames, cached pictures, and places of a drop."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QPointF, QRect, QRectF, QSize, Qt

from skinsource.base.conventions import Floats
from skinsource_gui.qt.theme import Theme, current_theme, is_on_paper

# The nearest point of an outline is at most so far from the middle, in smaller sides of the room.
_REACH = 0.2


@dataclass(frozen=True, slots=True, kw_only=True)
class Frame:
    """Maps a drawing to screen pixels.

    Attributes
    ----------
    scale
        Screen pixels per unit of the drawing.
    left, top
        Screen place of the origin of the drawing.
    up
        Whether y of the drawing points up; on the screen it points down.
    """

    scale: float
    left: float
    top: float
    up: bool = False

    def transform(self) -> QtGui.QTransform:
        """Return the map as a transformation of Qt."""
        return QtGui.QTransform(self.scale, 0, 0, self._y_scale, self.left, self.top)

    def to_screen(self, places: Floats) -> Floats:
        """Return the screen places, (n, 2), of places of the drawing, (n, 2)."""
        return places * (self.scale, self._y_scale) + (self.left, self.top)

    def to_drawing(self, point: QPointF) -> tuple[float, float]:
        """Return the place of the drawing at a screen point."""
        return (point.x() - self.left) / self.scale, (point.y() - self.top) / self._y_scale

    def zoomed(self, factor: float, about: QPointF) -> "Frame":
        """Return the frame magnified around a screen point, which stays in place."""
        return replace(
            self,
            scale=self.scale * factor,
            left=about.x() + (self.left - about.x()) * factor,
            top=about.y() + (self.top - about.y()) * factor,
        )

    def moved(self, dx: float, dy: float) -> "Frame":
        """Return the frame shifted by screen pixels."""
        return replace(self, left=self.left + dx, top=self.top + dy)

    def shifted_into_sight(self, outline: Floats, room: QRectF) -> "Frame":
        """Return the frame shifted as little as possible to show the outline or its inside.

        Parameters
        ----------
        outline : (n, 2)
            Polygon, in units of the drawing.
        room
            Area on the screen.
        """
        middle = QPointF(*self.to_drawing(room.center()))
        if polygon(outline).containsPoint(middle, Qt.FillRule.OddEvenFill):
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
    """Return the frame in which ``bounds`` fills ``room``, centred."""
    scale = max(min(room.width() / bounds.width(), room.height() / bounds.height()), 1e-3)
    return Frame(
        scale=scale,
        left=room.center().x() - scale * bounds.center().x(),
        top=room.center().y() + (scale if up else -scale) * bounds.center().y(),
        up=up,
    )


def polygon(points: Floats) -> QtGui.QPolygonF:
    """Return points, (n, 2), as a polygon of Qt."""
    return QtGui.QPolygonF([QPointF(x, y) for x, y in points])


def closed_path(points: Floats) -> QtGui.QPainterPath:
    """Return the outline through points, (n, 2)."""
    path = QtGui.QPainterPath()
    path.addPolygon(polygon(points))
    path.closeSubpath()
    return path


def paint_focus_frame(painter: QtGui.QPainter, area: QRectF, theme: Theme) -> None:
    """Draw the focus frame just inside ``area``; on paper there is none."""
    if is_on_paper():
        return
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 1))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawRect(area.adjusted(0.5, 0.5, -0.5, -0.5))


def paint_problem(painter: QtGui.QPainter, area: QRect) -> None:
    """Frame a field whose text cannot be read."""
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().error), 2))
    painter.drawRoundedRect(QRectF(area).adjusted(1, 1, -1, -1), 4, 4)


def paint_card(painter: QtGui.QPainter, room: QRectF, text: str, theme: Theme) -> None:
    """Write a text on raised ground, readable over anything."""
    painter.setBrush(QtGui.QColor(theme.raised))
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.border), 1))
    painter.drawRect(room)
    painter.setPen(QtGui.QColor(theme.text))
    painter.drawText(room, Qt.AlignmentFlag.AlignCenter, text)


def drop_line(parent: QtWidgets.QWidget, name: str) -> QtWidgets.QFrame:
    """Return a line that shows where something would be dropped; hidden at first."""
    line = QtWidgets.QFrame(parent)
    line.setObjectName(name)
    line.setBackgroundRole(QtGui.QPalette.ColorRole.Highlight)
    line.setAutoFillBackground(True)
    line.hide()
    return line


class Same:
    """Key of an object by its identity, for `CachedPicture`; it keeps the object alive."""

    __slots__ = ("_value",)

    def __init__(self, value: object) -> None:
        self._value = value

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Same) and self._value is other._value

    def __hash__(self) -> int:
        return id(self._value)


class CachedPicture:
    """Caches a picture of what is slow to paint, until it depends on something else.

    On paper nothing is cached: lines stay lines.
    """

    def __init__(self) -> None:
        self._key: tuple[object, ...] = ()
        self._image, self._at = QtGui.QImage(), QPointF()

    def paint(
        self,
        painter: QtGui.QPainter,
        room: QRectF,
        depends_on: tuple[object, ...],
        paint_anew: Callable[[QtGui.QPainter], None],
        ground: QtGui.QColor | None = None,
    ) -> None:
        """Paint into ``room`` what ``paint_anew`` paints there.

        Parameters
        ----------
        painter
            Its font and hints are those of the picture.
        room
            Area of the picture.
        depends_on
            Everything that the picture shows, besides room, font and resolution.
        paint_anew
            Called only when the cached picture is out of date.
        ground
            Background colour; None: the picture is transparent.
        """
        if is_on_paper():
            if ground is not None:
                painter.fillRect(room, ground)
            painter.save()
            paint_anew(painter)
            painter.restore()
            return
        ratio, font = painter.device().devicePixelRatioF(), painter.font()
        key = (*depends_on, room, ratio, font, ground)
        if key != self._key:
            self._key, self._at, self._image = key, QPointF(), QtGui.QImage()
            size = (room.size() * ratio).toSize()
            # A room that is nearly scrolled out of sight may have no pixels; Qt cannot paint then.
            if not size.isEmpty():
                self._image = _blank(size, ground)
                self._image.setDevicePixelRatio(ratio)
                on_image = QtGui.QPainter(self._image)
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
        """Remove transparent margins: they would cost as much as the rest."""
        painted = _painted(self._image)
        self._at = QPointF(painted.x() / ratio, painted.y() / ratio)
        self._image = self._image.copy(painted) if painted.isValid() else QtGui.QImage()


def _painted(image: QtGui.QImage) -> QRect:
    """Return the smallest area with all opaque pixels; not valid where there is none."""
    pixels = np.frombuffer(image.constBits(), np.uint32).reshape(image.height(), -1)
    rows, columns = np.flatnonzero(pixels.any(axis=1)), np.flatnonzero(pixels.any(axis=0))
    if not rows.size:
        return QRect()
    left, top = int(columns[0]), int(rows[0])
    return QRect(left, top, int(columns[-1]) - left + 1, int(rows[-1]) - top + 1)


def _blank(size: QSize, ground: QtGui.QColor | None) -> QtGui.QImage:
    opaque = ground is not None
    shape = (
        QtGui.QImage.Format.Format_RGB32
        if opaque
        else QtGui.QImage.Format.Format_ARGB32_Premultiplied
    )
    image = QtGui.QImage(size, shape)
    image.fill(ground if opaque else Qt.GlobalColor.transparent)
    return image


@dataclass(frozen=True, slots=True, kw_only=True)
class DropPlace:
    """Where something is dropped: on a location of inputs, or on a track and its time.

    Without either, nothing that needs a place is taken there.

    Attributes
    ----------
    location
        Location of a new input.
    input_id
        Id of the track that gets a clip; it has priority over ``location``.
    onset_s
        Onset of the clip; None: no time was chosen.
    """

    location: int | None = None
    input_id: int | None = None
    onset_s: float | None = None
