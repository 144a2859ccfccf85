"""A picture of what is slow to paint and rarely different."""

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QPointF, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QImage, QPainter

from skinsource_gui.widgets.paper import is_on_paper


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


class KeptPicture:
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
