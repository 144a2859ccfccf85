"""All errors that a user can meet, and the values and sentences in their messages.

Each message says where it happened, what was found, what was expected, and what to do next.
Quoted values come from files, servers and scripts: they may be a megabyte of text, and hold
commands for a terminal.  A message shows their beginning, in characters that can be printed.

SkinSourceError
├── InvalidInputError      a value handed to the library is impossible (also a `ValueError`)
│   ├── UnknownLimbError   no limb has this name
│   └── FormulaError       a formula cannot be read, or its result is no number; knows the column
├── FileFormatError        a file does not hold what it should
│   ├── DatasetError       … a file of the measured dataset, or the store made from it
│   ├── RecordingError     … a file that a recording is taken from
│   └── DesignFileError    … a `.skinsource` file
├── DatasetMissingError    a measured limb is asked for, and none is installed
├── StorageError           reading or writing failed: full disk, no permission, no such folder
├── DownloadError          the network, or the server, did not deliver
├── PlaybackError          a device is missing or does not support what is played
│   └── NothingToPlayOnError   … there is no device, or the package for devices is not installed
├── TooInaccurateError     a result would be less accurate than requested; nothing is written
├── NotConfirmedError      a result clips, passes a limit or loses much, and nobody confirmed it
├── MissingExtraError      an optional package is needed and not installed
└── Stopped                the user stopped it
"""

import csv
import io
import reprlib
from collections.abc import Iterable, Sequence


class SkinSourceError(Exception):
    """Base of every error whose message is written for the user."""


class InvalidInputError(SkinSourceError, ValueError):
    """A value handed to the library cannot be used."""


class UnknownLimbError(InvalidInputError):
    """No limb has this name."""


class FormulaError(InvalidInputError):
    """A formula cannot be read, or what it gives cannot be played.

    Attributes
    ----------
    column
        Where in the text, from 1.
    """

    def __init__(self, message: str, column: int = 1) -> None:
        super().__init__(message)
        self.column = column


class FileFormatError(SkinSourceError):
    """A file does not hold what it should."""


class DatasetError(FileFormatError):
    """A file of the measured dataset, or the store made from it, is not what it should be."""


class RecordingError(FileFormatError):
    """A file that a recording is to be taken from does not hold one that can be used."""


class DesignFileError(FileFormatError):
    """A design file cannot be understood."""


class DatasetMissingError(SkinSourceError):
    """A measured limb is needed, and no measured dataset is installed."""


class StorageError(SkinSourceError):
    """The file system refused: full disk, read-only folder, no such folder."""


class DownloadError(SkinSourceError):
    """The network or the server failed to deliver a file."""


class PlaybackError(SkinSourceError):
    """A device is missing, or does not support what is played."""


class NothingToPlayOnError(PlaybackError):
    """There is no device, or the package for devices is not installed."""


class TooInaccurateError(SkinSourceError):
    """A result would be less accurate than requested; nothing was written."""


class NotConfirmedError(SkinSourceError):
    """A result clips, passes a limit or loses much, unconfirmed; nothing was written."""


class MissingExtraError(SkinSourceError):
    """An optional package is needed and is not installed."""


class Stopped(SkinSourceError):
    """The user stopped the work; nothing was left behind."""


#: Characters of a quotation; longer ones are cut.
MOST_CHARACTERS = 80

_SHORT = reprlib.Repr()
_SHORT.maxstring = _SHORT.maxother = _SHORT.maxlong = MOST_CHARACTERS
_SHORT.maxlevel = 3


def quoted(value: object) -> str:
    """Return ``value`` as Python writes it, at most 80 printable characters of it."""
    if isinstance(value, str | bytes | bytearray):
        # Of a long value only the beginning is converted.
        text = repr(value[: MOST_CHARACTERS + 1])
    else:
        try:
            text = _SHORT.repr(value)
        except (ValueError, RecursionError):  # integers of thousands of digits; deep nesting
            text = f"<{type(value).__name__}>"
    return printable(text)


def printable(thing: object) -> str:
    r"""Return a text, or the message of an error, in one line of at most 80 printable characters.

    Other characters are escaped as in Python, such as ``\x1b``; ``…`` marks a cut.
    """
    text = str(thing)
    beginning = text[: 4 * MOST_CHARACTERS]
    line = escaped(" ".join(beginning.split()))
    is_whole = len(line) <= MOST_CHARACTERS and len(text) == len(beginning)
    return line if is_whole else f"{line[: MOST_CHARACTERS - 1]}…"


def escaped(text: str) -> str:
    """Return ``text`` with characters that cannot be printed escaped as in Python."""
    return "".join(
        character if character.isprintable() else character.encode("unicode_escape").decode("ascii")
        for character in text
    )


def sentence(text: str) -> str:
    """Return ``text`` with exactly one full stop at its end."""
    return f"{text.rstrip().rstrip('.')}."


def lowered(text: str) -> str:
    """Return ``text`` for the middle of a sentence, with a small first letter."""
    return f"{text[:1].lower()}{text[1:]}"


def counted(count: int, noun: str, plural: str = "") -> str:
    """Return ``"1 clip"``, ``"3 clips"``.

    Parameters
    ----------
    count
        How many.
    noun
        Its singular; words before it stay as they are: ``"more clip"``.
    plural
        Its plural, where that is not the noun with an s.
    """
    return f"{count} {noun if count == 1 else plural or f'{noun}s'}"


def first_sentence(text: str) -> str:
    """Return the first sentence of ``text``, with its full stop.

    >>> first_sentence("The level is 0.5 dB. Choose another one.")
    'The level is 0.5 dB.'
    """
    return sentence(text.split(". ", 1)[0])


def cell_text(text: str) -> str:
    """Return a text for a cell of CSV; a spreadsheet would read some beginnings as formulas.

    >>> cell_text("=1+1")
    "'=1+1"
    """
    return f"'{text}" if text.startswith(("=", "+", "-", "@", "\t", "\r")) else text


def csv_text(columns: Sequence[str], rows: Iterable[Iterable[object]]) -> str:
    """Return a table as CSV, with a line of the names of its columns first."""
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(rows)
    return text.getvalue()
