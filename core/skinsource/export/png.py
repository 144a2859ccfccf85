"""Pictures as PNG files, written with what Python has."""

import struct
import zlib
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
# Bits per channel; red, green, blue; then the only compression and filtering there are, no lacing.
_HEADER = struct.Struct(">IIBBBBB")
_DEPTH, _RGB = 8, 2


def write_png(file: BinaryIO, pixels: NDArray[np.uint8], texts: dict[str, str]) -> None:
    """Write a picture.

    Parameters
    ----------
    pixels : (rows, columns, 3)
        Red, green and blue; the first row is the highest.
    texts
        What the picture says of itself, by keyword.
    """
    rows, columns, _ = pixels.shape
    # Each row begins with how it is filtered: not at all.
    lines = np.zeros((rows, 1 + 3 * columns), np.uint8)
    lines[:, 1:] = pixels.reshape(rows, -1)
    file.write(_SIGNATURE)
    _write_chunk(file, b"IHDR", _HEADER.pack(columns, rows, _DEPTH, _RGB, 0, 0, 0))
    for keyword, text in texts.items():
        # Keyword, no compression, no language, text.
        _write_chunk(file, b"iTXt", keyword.encode("latin-1") + b"\0\0\0\0\0" + text.encode())
    _write_chunk(file, b"IDAT", zlib.compress(lines.tobytes(), 9))
    _write_chunk(file, b"IEND", b"")


def _write_chunk(file: BinaryIO, kind: bytes, content: bytes) -> None:
    file.write(struct.pack(">I", len(content)))
    file.write(kind + content)
    file.write(struct.pack(">I", zlib.crc32(kind + content)))
