"""A photograph, read in a process of its own: a picture may be damaged, or made to do harm.

``python -m skinsource_gui.pages.limbs.photograph`` is that process; it answers requests as
`skinsource.limbs.reading_child` does.  Pixels come in blocks, (rows, width), each a number
0xrrggbb, which float32 holds exactly.
"""

import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QImage, QImageReader

from skinsource.base.child_process import child_command, limit_memory, limit_time, own_output
from skinsource.base.errors import RecordingError
from skinsource.base.files import path_text
from skinsource.readers.reading_process import ReadingProcess

#: Formats that are read: others, such as drawings, can do more than hold pixels.
FORMATS = ("png", "jpeg", "bmp", "webp")
#: Longer sides are made shorter: places are no more exact on more pixels than this.
LONGEST_SIDE_PX = 6000
_MEMORY_BYTES, _ALLOCATION_MB, _CPU_S = 3 * 2**30, 512, 60
_ROWS = 256
_EXPECTED = "a photograph as PNG, JPEG, BMP or WebP. Save it again as one of these."


def reading_process() -> ReadingProcess:
    """Return what reads photographs; it starts when it is first needed."""
    return ReadingProcess(command=child_command(__name__), folder=Path(__file__).parents[3])


def read(path: Path, process: ReadingProcess) -> QImage:
    """Return a photograph, upright.

    Raises
    ------
    RecordingError
        It is no picture, or reading it crashed or took too long.
    StorageError
        It cannot be read.
    """
    blocks = [block.astype(np.uint32) for block in process.stream(path, {"do": "photograph"})]
    if not blocks:
        raise _refusal(path, "it holds no pixels")
    pixels = np.ascontiguousarray(np.vstack(blocks)) | np.uint32(0xFF000000)
    rows, columns = pixels.shape
    # A copy, since the image outlives the array of its pixels.
    return QImage(pixels.data, columns, rows, 4 * columns, QImage.Format.Format_RGB32).copy()


def main() -> None:
    """Answer requests until there are no more."""
    answers = own_output()
    limit_memory(_MEMORY_BYTES)
    _answer(answers, {"ready": True})
    for line in sys.stdin.buffer:
        limit_time(_CPU_S)
        path = Path(json.loads(line)["path"])
        try:
            for block in _blocks(path):
                _answer(answers, {"block": [*block.shape, "f4"]}, block)
            _answer(answers, {"end": True})
        except RecordingError as error:
            _answer(answers, {"error": str(error), "kind": "format"})
        except MemoryError:
            reason = f"it needs more than {_MEMORY_BYTES} bytes of memory"
            _answer(answers, {"error": str(_refusal(path, reason)), "kind": "format"})


def _blocks(path: Path) -> Iterator[NDArray[np.float32]]:
    QImageReader.setAllocationLimit(_ALLOCATION_MB)
    reader = QImageReader(str(path))
    reader.setDecideFormatFromContent(True)
    reader.setAutoTransform(True)
    if not reader.canRead() or reader.format().toStdString() not in FORMATS:
        raise _refusal(path, "no picture can be read of it")
    size = reader.size()
    if max(size.width(), size.height()) > LONGEST_SIDE_PX:
        longest = QSize(LONGEST_SIDE_PX, LONGEST_SIDE_PX)
        reader.setScaledSize(size.scaled(longest, Qt.AspectRatioMode.KeepAspectRatio))
    image = reader.read().convertToFormat(QImage.Format.Format_RGB32)
    if image.isNull():
        raise _refusal(path, f"no picture can be read of it ({reader.errorString()})")
    for top in range(0, image.height(), _ROWS):
        strip = image.copy(0, top, image.width(), min(_ROWS, image.height() - top))
        flat = np.frombuffer(strip.constBits(), np.uint32).reshape(strip.height(), -1)
        yield np.ascontiguousarray(flat[:, : strip.width()] & np.uint32(0xFFFFFF), np.float32)


def _refusal(path: Path, reason: str) -> RecordingError:
    return RecordingError(f"{path_text(Path(path.name))}: {reason}, expected {_EXPECTED}")


def _answer(answers: IO[bytes], what: dict[str, Any], content: Any = b"") -> None:
    answers.write(json.dumps(what).encode("ascii") + b"\n")
    answers.write(content)
    answers.flush()


if __name__ == "__main__":
    main()
