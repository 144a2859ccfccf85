"""The file that an export is written to."""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from io import BufferedRandom, FileIO
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

from skinsource.files import replacing
from skinsource.job import Stop, stop_if

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

_BYTES_BETWEEN_SYNCS = 8 * 2**20


@contextmanager
def output_file(path: Path, stop: Stop) -> Iterator[BinaryIO]:
    """Give an open file that takes the place of ``path`` at the end, whole or not at all.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    Stopped
        ``stop`` said so at the end.
    """
    with replacing(path) as temporary, steadily_written(temporary) as file:
        try:
            yield file
            file.flush()
            os.fsync(file.fileno())
            stop_if(stop)
        except BaseException:
            # Gone at once: to give back a gigabyte, when the file is closed, can take a second.
            # Systems that delete no open file do so when it is closed.
            with suppress(OSError):
                temporary.unlink()
            raise


def steadily_written(path: Path) -> BinaryIO:
    """Open ``path`` for writing; what is written goes to the disk now and then."""
    return BufferedRandom(_SteadyFile(path, "w+b"))


class _SteadyFile(FileIO):
    """Sends what is written to the disk now and then.

    At the end little is left to send, so that the user can stop it at any time: nothing stops the
    flush of a gigabyte.
    """

    _unsynced = 0

    def write(self, data: "ReadableBuffer") -> int:
        written = super().write(data)
        self._unsynced += written
        if self._unsynced >= _BYTES_BETWEEN_SYNCS:
            os.fsync(self.fileno())
            self._unsynced = 0
        return written
