"""A picture as wide as there is room for, or words where there is none."""

from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPixmap
from PySide6.QtWidgets import QScrollArea, QSizePolicy, QWidget


class PictureView(QScrollArea):
    """Shows a picture across its width, never enlarged; what is higher can be scrolled."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._canvas = _Canvas()
        self.setWidget(self._canvas)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)

    @property
    def words(self) -> str:
        """What is said instead of a picture."""
        return self._canvas.words

    def show_picture(self, picture: QPixmap) -> None:
        """Show ``picture``."""
        self._canvas.take(picture, "")

    def say(self, words: str) -> None:
        """Show ``words`` and no picture."""
        self._canvas.take(QPixmap(), words)
        self.setAccessibleDescription(words)


class _Canvas(QWidget):
    """Paints the picture; as high as it becomes."""

    def __init__(self) -> None:
        super().__init__()
        policy = QSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        self._picture, self.words = QPixmap(), ""

    def take(self, picture: QPixmap, words: str) -> None:
        self._picture, self.words = picture, words
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QSize:
        return self._picture.size()

    def heightForWidth(self, width: int) -> int:
        return self._size_in(width).height()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        if self._picture.isNull():
            room = self.rect().adjusted(16, 16, -16, -16)
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.setPen(self.palette().placeholderText().color())
            painter.drawText(room, flags, self.words)
        else:
            place = QRect(0, 0, *self._size_in(self.width()).toTuple())
            place.moveCenter(self.rect().center())
            painter.drawPixmap(place, self._scaled(place.size()))
        painter.end()

    def _size_in(self, width: int) -> QSize:
        size = self._picture.size()
        if size.width() <= width:
            return size
        return QSize(width, round(size.height() * width / size.width()))

    def _scaled(self, size: QSize) -> QPixmap:
        return self._picture.scaled(
            size * self.devicePixelRatioF(),
            Qt.AspectRatioMode.IgnoreAspectRatio,
            Qt.TransformationMode.SmoothTransformation,
        )
