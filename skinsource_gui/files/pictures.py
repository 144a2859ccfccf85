"""Pictures are written whole or not at all."""

from pathlib import Path

from PySide6.QtCore import QBuffer, QIODevice
from PySide6.QtGui import QImage, QPixmap

from skinsource.files import write_bytes


def save_picture(path: Path, picture: QImage | QPixmap) -> None:
    """Write ``picture`` to ``path`` as PNG.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    """
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    picture.save(buffer, "PNG")
    write_bytes(path, bytes(buffer.data().data()))
