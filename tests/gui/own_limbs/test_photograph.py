"""Photographs are read in a process of their own: exactly, in limits, and pictures alone."""

import struct
import zlib

import pytest
from PySide6.QtGui import QColor, QImage

from skinsource.base.errors import RecordingError
from skinsource.base.run_limited import LimitedProcess
from skinsource_gui.pages.limbs import photograph


@pytest.fixture(scope="module")
def process():
    with LimitedProcess() as process:
        yield process


def png_of(width, height):
    """A picture that says it is so large, and holds nothing."""

    def chunk(kind, content):
        whole = kind + content
        return struct.pack(">I", len(content)) + whole + struct.pack(">I", zlib.crc32(whole))

    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", b"") + chunk(b"IEND", b"")


def test_pixels_are_those_of_the_file_and_large_ones_are_made_smaller(tmp_path, process):
    drawn = QImage(301, 530, QImage.Format.Format_RGB32)
    for x in range(301):
        for y in range(0, 530, 7):
            drawn.setPixelColor(x, y, QColor(x % 256, y % 256, (x * y) % 256))
    drawn.save(str(tmp_path / "hand.png"))
    picture = photograph.read(tmp_path / "hand.png", process)
    assert picture == QImage(str(tmp_path / "hand.png")).convertToFormat(picture.format())
    wide = QImage(photograph.LONGEST_SIDE_PX + 400, 64, QImage.Format.Format_RGB32)
    wide.fill(QColor("red"))
    wide.save(str(tmp_path / "wide.jpg"))
    picture = photograph.read(tmp_path / "wide.jpg", process)
    assert picture.width() == photograph.LONGEST_SIDE_PX
    assert picture.pixelColor(9, 9).red() > 250


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("drawing.png", b"<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'/>"),
        ("bomb.png", png_of(200_000, 200_000)),
        ("cut.png", png_of(64, 64)),
        ("none.jpg", b""),
    ],
)
def test_what_is_no_photograph_is_refused_and_the_next_one_is_read(
    tmp_path, process, name, content
):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(RecordingError, match="no picture can be read") as caught:
        photograph.read(tmp_path / name, process)
    assert name in str(caught.value)
    QImage(8, 8, QImage.Format.Format_RGB32).save(str(tmp_path / "next.bmp"))
    assert photograph.read(tmp_path / "next.bmp", process).width() == 8
