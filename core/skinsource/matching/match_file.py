"""Tables of matches: CSV, one row for each, never doubled."""

import csv
import io
from collections.abc import Iterable
from dataclasses import astuple, fields
from pathlib import Path

from skinsource.arguments import one_of, real_number, whole_number
from skinsource.counting import counted
from skinsource.errors import FileFormatError, InvalidInputError
from skinsource.files import is_there, named, read_bytes, write_bytes
from skinsource.keeping.lock import Lock
from skinsource.limb import MOST_PLACES
from skinsource.matching.match import Match
from skinsource.matching.procedure import (
    DIRECTIONS,
    HIGHEST_DB,
    LOWEST_DB,
    MOST_AMPLITUDE,
    check_person,
)
from skinsource.quoting import printable, quoted, sentence

_MOST_BYTES = 64 * 2**20
_COLUMNS = tuple(one.name for one in fields(Match))
_MOST = 2**63 - 1


def read_matches(path: Path) -> tuple[Match, ...]:
    """Read a table of matches.

    Raises
    ------
    StorageError
        It cannot be read.
    FileFormatError
        It is no such table, holds a match twice, or matches with different references.
    """
    try:
        text = read_bytes(path, most=_MOST_BYTES).decode()
        rows = list(csv.reader(io.StringIO(text, newline=""), strict=True))
    except (ValueError, csv.Error) as error:
        raise FileFormatError(f"{named(path)}: is no CSV text ({printable(error)}).") from error
    if not rows or tuple(rows[0]) != _COLUMNS:
        raise FileFormatError(
            f"{named(path)}: is no table of matches: its first line is "
            f"{quoted(','.join(rows[0]) if rows else '')}, expected {','.join(_COLUMNS)}. Choose "
            "another file."
        )
    found: list[Match] = []
    known: dict[object, int] = {}
    for line, row in enumerate(rows[1:], start=2):
        try:
            one = _match(row)
            before = known.setdefault(one.key, line)
            if before != line:
                raise InvalidInputError(f"the same match stands in line {before} already")
            if one.reference != (found or [one])[0].reference:
                raise InvalidInputError("its reference is not that of line 2")
        except InvalidInputError as error:
            raise FileFormatError(
                f"{named(path)}, line {line}: {sentence(str(error))} Correct or remove it."
            ) from error
        found.append(one)
    return tuple(found)


def add_match(path: Path, new: Match) -> tuple[Match, ...]:
    """Add a row to a table, which is made where there is none; returns all of them.

    The file is replaced as a whole: whatever happens, it holds all rows before, or one more.
    Processes that add at the same time wait for each other.

    Raises
    ------
    InvalidInputError
        The match is there already, or the table has another reference.
    FileFormatError, StorageError
        The file is no table of matches; it cannot be read or written.
    """
    with Lock(path).hold():
        before = read_matches(path) if is_there(path) else ()
        if any(one.key == new.key for one in before):
            raise InvalidInputError(
                f"{named(path)} has the {new.direction} match of {new.frequency_hz:g} Hz at place "
                f"{new.place} by {new.person} already. Nothing was changed."
            )
        check_reference(path, before, new.reference)
        matches = (*before, new)
        write_bytes(path, _text(matches).encode())
    return matches


def check_reference(
    path: Path, matches: Iterable[Match], reference: tuple[float, int, float]
) -> None:
    """Refuse a table whose reference is another one than ``reference``."""
    for one in matches:
        if one.reference != reference:
            frequency_hz, place, amplitude = one.reference
            raise InvalidInputError(
                f"{named(path)} holds matches with another reference: {frequency_hz:g} Hz at place "
                f"{place}, a drive of {amplitude:g}. Choose another file, or that reference."
            )


def _match(row: list[str]) -> Match:
    if len(row) != len(_COLUMNS):
        raise InvalidInputError(f"it has {counted(len(row), 'value')}, expected {len(_COLUMNS)}")
    cell = dict(zip(_COLUMNS, row, strict=True))
    return Match(
        person=check_person(cell["person"]),
        frequency_hz=real_number("frequency_hz", _number(cell, "frequency_hz"), least=1e-3),
        place=whole_number("place", _whole(cell, "place"), 1, MOST_PLACES),
        direction=one_of("direction", cell["direction"], DIRECTIONS),
        start_db=real_number("start_db", _number(cell, "start_db")),
        matched_db=real_number(
            "matched_db", _number(cell, "matched_db"), least=LOWEST_DB, most=HIGHEST_DB
        ),
        reference_hz=real_number("reference_hz", _number(cell, "reference_hz"), least=1e-3),
        reference_place=whole_number(
            "reference_place", _whole(cell, "reference_place"), 1, MOST_PLACES
        ),
        amplitude=real_number(
            "amplitude", _number(cell, "amplitude"), least=1e-6, most=MOST_AMPLITUDE
        ),
        trial=whole_number("trial", _whole(cell, "trial"), 1, _MOST),
        seed=whole_number("seed", _whole(cell, "seed"), 0, _MOST),
    )


def _number(cell: dict[str, str], name: str) -> float:
    try:
        return float(cell[name])
    except ValueError:
        raise InvalidInputError(f"{name} is {quoted(cell[name])}, expected a number") from None


def _whole(cell: dict[str, str], name: str) -> int:
    text = cell[name]
    if not (text.isdecimal() and len(text) < 20):
        raise InvalidInputError(f"{name} is {quoted(text)}, expected a whole number")
    return int(text)


def _text(matches: Iterable[Match]) -> str:
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_COLUMNS)
    writer.writerows(astuple(one) for one in matches)
    return text.getvalue()
