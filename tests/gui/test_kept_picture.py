import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QImage, QPainter

from skinsource_gui.qt.frames import CachedPicture

ROOM = QRectF(2, 3, 8, 6)


def sheet(ratio=1.0):
    image = QImage(12 * int(ratio), 12 * int(ratio), QImage.Format.Format_RGB32)
    image.setDevicePixelRatio(ratio)
    image.fill(QColor("white"))
    return image


class Dot:
    """Paints a square and counts how often."""

    def __init__(self, colour="red"):
        self.colour, self.times = colour, 0

    def paint(self, painter):
        self.times += 1
        painter.fillRect(QRectF(4, 4, 2, 2), QColor(self.colour))


def show(cached, dot, key=(), ground=None, ratio=1.0, room=ROOM):
    image = sheet(ratio)
    painter = QPainter(image)
    cached.paint(painter, room, key, dot.paint, ground)
    painter.end()
    return image


class Nothing(Dot):
    """Paints nothing."""

    def paint(self, painter):
        self.times += 1


@pytest.mark.parametrize("ratio", [1.0, 2.0])
@pytest.mark.parametrize("room", [ROOM, QRectF(0, 0, 12, 12), QRectF(4, 4, 2, 2)])
@pytest.mark.parametrize("kind", [Dot, Nothing])
def test_a_kept_picture_looks_as_if_it_were_painted_directly(qapp, kind, room, ratio):
    direct, cached = sheet(ratio), CachedPicture()
    painter = QPainter(direct)
    kind().paint(painter)
    painter.end()
    for _ in range(2):
        assert show(cached, kind(), room=room, ratio=ratio) == direct


def test_it_is_painted_once_until_what_it_depends_on_changes(qapp):
    cached, dot = CachedPicture(), Dot()
    for _ in range(3):
        show(cached, dot, ("light", 1.5))
    assert dot.times == 1
    show(cached, dot, ("dark", 1.5))
    assert dot.times == 2


@pytest.mark.parametrize("size", [(8, 0), (8, 0.2), (8, -3), (0, 6)])
@pytest.mark.parametrize("ground", [None, QColor("blue")])
def test_where_there_is_no_room_nothing_is_painted_and_next_time_all_of_it(qapp, size, ground):
    cached, dot = CachedPicture(), Dot()
    show(cached, dot)
    assert show(cached, dot, ground=ground, room=QRectF(4, 4, *size)) == sheet()
    assert dot.times == 1
    assert show(cached, dot) != sheet()
