"""A photograph, read in a process of its own: a picture may be damaged, or made to do harm."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PySide6 import QtGui
from PySide6.QtCore import QSize, Qt

from skinsource.base.errors import RecordingError
from skinsource.base.files import path_text
from skinsource.base.run_limited import LimitedProcess, run_limited

#: Formats that are read: others, such as drawings, can do more than hold pixels.
FORMATS = ("png", "jpeg", "bmp", "webp")
#: Longer sides are made shorter: places are no more exact on more pixels than this.
LONGEST_SIDE_PX = 6000
_ALLOCATION_MB = 512
_EXPECTED = "a photograph as PNG, JPEG, BMP or WebP. Save it again as one of these."


def read(path: Path, process: LimitedProcess) -> QtGui.QImage:
    """Return a photograph, upright.

    Raises
    ------
    RecordingError
        It is no picture, or reading it crashed or took too long.
    StorageError
        It cannot be read.
    """
    (pixels,) = run_limited(f"{__name__}:pixels_of", path, expected=_EXPECTED, process=process)
    rows, columns = pixels.shape
    # A copy, since the image outlives the array of its pixels.
    return QtGui.QImage(
        pixels.data, columns, rows, 4 * columns, QtGui.QImage.Format.Format_RGB32
    ).copy()


def pixels_of(path: Path) -> NDArray[np.uint32]:
    """Return the pixels of a photograph, 0xffrrggbb, (rows, columns)."""
    QtGui.QImageReader.setAllocationLimit(_ALLOCATION_MB)
    reader = QtGui.QImageReader(str(path))
    reader.setDecideFormatFromContent(True)
    reader.setAutoTransform(True)
    if not reader.canRead() or reader.format().toStdString() not in FORMATS:
        raise _refusal(path, "it cannot be read as a picture")
    size = reader.size()
    if max(size.width(), size.height()) > LONGEST_SIDE_PX:
        longest = QSize(LONGEST_SIDE_PX, LONGEST_SIDE_PX)
        reader.setScaledSize(size.scaled(longest, Qt.AspectRatioMode.KeepAspectRatio))
    image = reader.read().convertToFormat(QtGui.QImage.Format.Format_RGB32)
    if image.isNull():
        raise _refusal(path, f"it cannot be read as a picture ({reader.errorString()})")
    pixels = np.frombuffer(image.constBits(), np.uint32)
    return pixels.reshape(image.height(), image.width()).copy()


def _refusal(path: Path, reason: str) -> RecordingError:
    return RecordingError(f"{path_text(Path(path.name))}: {reason}, expected {_EXPECTED}")
