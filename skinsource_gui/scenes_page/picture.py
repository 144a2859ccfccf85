"""The picture of a scene, as large as there is room."""

from PySide6.QtCore import QRectF, QSize, QSizeF, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QPixmap
from PySide6.QtWidgets import QWidget

from skinsource_gui.theme import current_theme

_MARGIN_PX = 8.0
_LEAST_PX = (360, 220)


class ScenePicture(QWidget):
    """Shows a picture on its own white ground, in the middle of its room."""

    def __init__(self) -> None:
        super().__init__()
        self._picture = QPixmap()
        self.setObjectName("scene_picture")
        self.setMinimumSize(*_LEAST_PX)

    def sizeHint(self) -> QSize:
        # As large as there is room, but nothing is scrolled for it.
        return QSize(*_LEAST_PX)

    def show_picture(self, picture: QPixmap, words: str) -> None:
        """Show another picture; ``words`` are read to who cannot see it."""
        self._picture = picture
        self.setAccessibleName(words)
        self.update()

    def area(self) -> QRectF:
        """Where the picture is drawn; empty where there is none."""
        if self._picture.isNull():
            return QRectF()
        room = QRectF(self.rect()).adjusted(_MARGIN_PX, _MARGIN_PX, -_MARGIN_PX, -_MARGIN_PX)
        size = QSizeF(self._picture.size()).scaled(room.size(), Qt.AspectRatioMode.KeepAspectRatio)
        area = QRectF(room.topLeft(), size)
        area.moveCenter(room.center())
        return area

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        ground = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        painter.setPen(QPen(QColor(current_theme().border), 1))
        painter.setBrush(QColor("white"))
        painter.drawRect(ground)
        area = self.area()
        if not area.isEmpty():
            painter.drawPixmap(area, self._picture, QRectF(self._picture.rect()))
        painter.end()
