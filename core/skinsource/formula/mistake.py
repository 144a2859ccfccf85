"""What a mistake in a formula looks like."""

import re

from skinsource.errors import FormulaError
from skinsource.quoting import escaped, printable

_BEFORE, _AFTER = 24, 16
_COLUMN = re.compile(r'", column ([0-9]{1,6}): ')


def mistake(text: str, column: int, found: str, expected: str) -> FormulaError:
    """Return the error for a place in a text: the text around it, what is there, what should be.

    >>> print(mistake("2t", 2, "t", "an operator"))
    formula "2t", column 2: found t, expected an operator
    """
    where = f'formula "{around(text, column)}", column {column}'
    return FormulaError(f"{where}: found {printable(found)}, expected {expected}", column)


def around(text: str, column: int) -> str:
    """The text, or what stands near a column of a long one."""
    start = max(column - 1 - _BEFORE, 0)
    end = column - 1 + _AFTER
    if start <= 1 and len(text) <= end + 1:
        return escaped(text)
    cut = escaped(text[start:end])
    return f"{'…' if start else ''}{cut}{'…' if end < len(text) else ''}"


def column_of(message: str) -> int | None:
    """The column that a message of `mistake` names; None where it names none.

    >>> column_of('formula "2t", column 2: found t, expected an operator')
    2
    """
    found = _COLUMN.search(message)
    return int(found.group(1)) if found else None
