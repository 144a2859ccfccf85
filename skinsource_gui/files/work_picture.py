"""A small picture of the work, by which one knows it again."""

from collections.abc import Mapping
from typing import Any

from PySide6.QtCore import QBuffer, QByteArray, QRectF, QSize
from PySide6.QtGui import QColor, QImage, QPainter

from skinsource.design.design import Design
from skinsource_gui.theme import LIGHT
from skinsource_gui.widgets.map.small_map import SmallMap, SmallMaps, paint_small_map

#: Width and height, px.
SIZE = QSize(120, 180)
_EDGE_PX = 4


class WorkPicture:
    """Remembers what was predicted last, and draws it with the inputs of the present design."""

    def __init__(self) -> None:
        self._maps = SmallMaps()
        self._shown: SmallMap | None = None

    def show_results(self, results: Mapping[str, Any]) -> None:
        """Take over what the panels show now."""
        if "limb_map" in results:
            self._shown = self._maps.map_of(results)

    def image(self, design: Design) -> QImage:
        """What is known of ``design``; an empty image before anything was predicted."""
        if self._shown is None:
            return QImage()
        image = QImage(SIZE, QImage.Format.Format_RGB32)
        image.fill(QColor(LIGHT.base))
        painter = QPainter(image)
        area = QRectF(image.rect()).adjusted(_EDGE_PX, _EDGE_PX, -_EDGE_PX, -_EDGE_PX)
        paint_small_map(painter, area, self._shown, design, LIGHT)
        painter.end()
        return image


def png_of(image: QImage) -> bytes:
    """PNG of an image; empty for an empty one."""
    if image.isNull():
        return b""
    content = QByteArray()
    buffer = QBuffer(content)
    buffer.open(QBuffer.OpenModeFlag.WriteOnly)
    # The stubs of PySide ask for bytes, which it does not take.
    saved: Any = image
    saved.save(buffer, "PNG")
    return bytes(content.data())
