"""Signals of files that hold named arrays: NPY, NPZ, MAT and HDF5."""

import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.quoting import printable, quoted
from skinsource.recordings import limits
from skinsource.recordings.found import Found, Series
from skinsource.recordings.reader import Block, refusal, unknown_series
from skinsource.recordings.units import time_unit_s, unit_named

_RATE_NAMES = re.compile(
    r"(fs|sr|rate|srate|samplerate|samplingrate|samplefrequency|samplingfrequency|frequency)(hz)?"
)
_KINDS = "iuf"


@dataclass(frozen=True, slots=True, kw_only=True)
class Member:
    """An array of a file.

    Attributes
    ----------
    name
        Where in the file it is: "tap/acceleration".
    array
        Has ``shape`` and ``dtype``, and gives parts of itself; nothing is read before that.
    unit
        What the file says about its unit.
    rate_hz
        What the file says about its rate.
    """

    name: str
    array: Any
    unit: str = ""
    rate_hz: float | None = None


@dataclass(slots=True)
class Members:
    """The arrays of an open file, and what is to be said about the others."""

    members: list[Member] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def leave_out(self, name: str, reason: str) -> None:
        """Say why an array is not offered."""
        note = f"Left out: {quoted(name)}, {reason}."
        if note not in self.notes and len(self.notes) < 20:
            self.notes.append(note)


#: Opens a file: what it gives is valid as long as the file is open.
Open = Callable[[Path], AbstractContextManager[Members]]


def look(path: Path, file_format: str, opened: Open) -> Found:
    """Return the signals among the arrays of a file."""
    with opened(path) as members:
        offered = list(_offered(members))
        rate = stated_rate(members)
        if not offered:
            left_out = " ".join(members.notes) or "It holds no array of numbers."
            raise refusal(
                path,
                f"nothing in it can be played: {left_out.rstrip('.')}",
                "a list of real numbers",
                "Choose another file, or save the signal as a plain array.",
            )
        series = tuple(one for one, *_ in offered)
        if len(series) > limits.MOST_SERIES:
            members.notes.append(f"Left out: all after the first {limits.MOST_SERIES} signals.")
        return Found(
            format=file_format,
            series=series[: limits.MOST_SERIES],
            rate_hz=rate[1] if rate else None,
            rate_from=quoted(rate[0]) if rate else "",
            notes=tuple(members.notes),
        )


def blocks(path: Path, keys: Sequence[str], start: int, stop: int, opened: Open) -> Iterator[Block]:
    """Give samples of some signals among the arrays of a file."""
    with opened(path) as members:
        places = {one.key: (one, member, axis) for one, member, axis in _offered(members)}
        chosen = []
        for key in keys:
            if key not in places:
                raise unknown_series(path, key)
            chosen.append(places[key])
        stop = min([stop, *(one.n_samples for one, *_ in chosen)])
        for at in range(start, stop, limits.BLOCK):
            end = min(at + limits.BLOCK, stop)
            parts = [_part(one, member, axis, at, end) for one, member, axis in chosen]
            yield np.stack(parts)


def _part(one: Series, member: Member, axis: int, start: int, end: int) -> np.ndarray:
    place: list[Any] = [0] * len(member.array.shape)
    place[axis] = slice(start, end)
    if len(place) == 2:
        place[1 - axis] = _column(one.key)
    found = np.asarray(member.array[tuple(place)])
    return found.astype(np.float64, copy=False)


def _column(key: str) -> int:
    return int(key.rpartition("[")[2].rstrip("]")) if key.endswith("]") else 0


def _offered(members: Members) -> Iterator[tuple[Series, Member, int]]:
    """Each signal with its array and the axis along which time runs."""
    for member in members.members:
        shape, kind = tuple(int(n) for n in member.array.shape), np.dtype(member.array.dtype)
        if kind.kind not in _KINDS or kind.itemsize > 8:
            members.leave_out(member.name, f"it holds {printable(kind)}, not real numbers")
            continue
        if max(shape, default=0) < 2:
            continue  # a number, such as a rate
        if len(shape) > 2 or min(shape) == 0:
            words = "×".join(map(str, shape))
            members.leave_out(member.name, f"it is an array of {words}, not a list of signals")
            continue
        axis = int(np.argmax(shape))
        columns = shape[1 - axis] if len(shape) == 2 else 1
        if columns > limits.MOST_COLUMNS:
            members.leave_out(
                member.name,
                f"it has {columns} columns, expected at most {limits.MOST_COLUMNS}",
            )
            continue
        for column in range(columns):
            yield _series(member, shape, axis, column, columns), member, axis


def _series(member: Member, shape: tuple[int, ...], axis: int, column: int, of: int) -> Series:
    base = member.name.rpartition("/")[2]
    time_s = time_unit_s(base, member.unit) if of == 1 else None
    return Series(
        key=member.name if of == 1 else f"{member.name}[{column}]",
        name=printable(member.name if of == 1 else f"{member.name}, column {column + 1}"),
        n_samples=shape[axis],
        dtype=str(np.dtype(member.array.dtype)),
        shape=shape,
        unit=unit_named(member.unit),
        rate_hz=member.rate_hz,
        is_time=time_s is not None,
        time_unit_s=time_s or 1.0,
    )


def stated_rate(members: Members) -> tuple[str, float] | None:
    """The number in a file that is called like a rate."""
    for member in members.members:
        shape = tuple(member.array.shape)
        if int(np.prod(shape)) != 1 or np.dtype(member.array.dtype).kind not in _KINDS:
            continue
        rate_hz = rate_in(member.name.rpartition("/")[2], np.asarray(member.array[()]).ravel()[0])
        if rate_hz is not None:
            return member.name, rate_hz
    return None


def rate_in(name: str, value: object) -> float | None:
    """The rate that something called ``name`` states; None if it is called otherwise."""
    plain = re.sub(r"[^a-z]", "", name.lower())
    if not _RATE_NAMES.fullmatch(plain):
        return None
    try:
        rate_hz = float(np.asarray(value, np.float64).ravel()[0])
    except (TypeError, ValueError, IndexError, OverflowError):
        return None
    return rate_hz if limits.LEAST_RATE_HZ <= rate_hz <= limits.MOST_RATE_HZ else None
