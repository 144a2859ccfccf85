"""Values and sentences in messages.

Quoted values come from files, servers and scripts: they may be a megabyte of text, and hold
commands for a terminal.  A message shows their beginning, in characters that can be printed.
"""

import csv
import io
import reprlib
from collections.abc import Iterable, Sequence

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
