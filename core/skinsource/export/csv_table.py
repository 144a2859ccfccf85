"""Tables as CSV: comment lines, one header line, then numbers that read back exactly."""

from collections.abc import Sequence
from itertools import zip_longest
from typing import BinaryIO

from skinsource.arrays import Floats
from skinsource.job import Stop, stop_if

# So many are written in a few milliseconds.
_CELLS_AT_ONCE = 8192


class CsvTable:
    """Writes a table, some rows at a time.

    Parameters
    ----------
    file
        Where to; it stays open.
    about
        Comment lines.
    header
        Names of the columns.
    stop
        Asked now and then; once true, `Stopped` is raised.
    """

    def __init__(
        self, file: BinaryIO, about: Sequence[str], header: Sequence[str], stop: Stop
    ) -> None:
        self._file, self._stop = file, stop
        self._write([*(f"# {line}" for line in about), ",".join(header)])

    def add(self, rows: Floats, texts: Sequence[Sequence[str]] = ()) -> None:
        """Write ``rows``, (n_rows, n_columns), each followed by its ``texts``, if there are any."""
        step = max(_CELLS_AT_ONCE // max(rows.shape[1], 1), 1)
        for first in range(0, len(rows), step):
            stop_if(self._stop)
            piece = rows[first : first + step].tolist()
            words = [list(map(_quoted, row)) for row in texts[first : first + step]]
            self._write(
                [
                    ",".join([*map(_exact, row), *more])
                    for row, more in zip_longest(piece, words, fillvalue=())
                ]
            )

    def _write(self, lines: list[str]) -> None:
        self._file.write(("\n".join(lines) + "\n").encode())


def _quoted(text: str) -> str:
    return '"' + text.replace('"', '""') + '"'


def _exact(value: float) -> str:
    # The shortest digits that read back as the same number.
    return str(int(value)) if value.is_integer() and abs(value) < 2**53 else repr(value)
