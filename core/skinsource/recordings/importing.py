"""Looks at foreign files and takes parts of them, in a process of its own."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError, RecordingError
from skinsource.files import named
from skinsource.job import Progress, Stop, never, silent
from skinsource.limb import SAMPLE_RATE_HZ
from skinsource.quoting import quoted, sentence
from skinsource.recordings.choice import ImportChoice, suggested
from skinsource.recordings.found import Found, Series
from skinsource.recordings.reader import Block
from skinsource.recordings.reading_process import ReadingProcess
from skinsource.recordings.taking import Taken, taken

# Rounding of a time that somebody typed.
_LITTLE_S = 1e-12
_LANDMARKS = 601


def look(path: Path | str) -> Found:
    """Return what a file holds: WAV, FLAC, AIFF, OGG, CSV, NPY, NPZ, MATLAB or HDF5.

    It is read in a process of its own, which a damaged file may take down.

    Raises
    ------
    RecordingError
        It holds nothing that can be used, or reading it crashed or took too long.
    StorageError
        It cannot be read.
    """
    with ReadingProcess() as process:
        return process.look(Path(path))


def take(
    path: Path | str,
    choice: ImportChoice | None = None,
    to_hz: float = SAMPLE_RATE_HZ,
    *,
    progress: Progress = silent,
    stop: Stop = never,
    process: ReadingProcess | None = None,
) -> Taken:
    """Return a part of a signal of a file, at another rate.

    Parameters
    ----------
    path
        The file.
    choice
        What is taken; without one the first signal, as the file describes it: in a physical unit
        it keeps its size, else its peak becomes 1.
    to_hz
        The rate of the result, in Hz.
    progress, stop
        See `skinsource.job`.
    process
        What reads; without one a new process.

    Raises
    ------
    RecordingError, StorageError
        As `look`, and where what is chosen is not in the file or cannot be used.
    Stopped
        ``stop`` said so.
    """
    file = Path(path)
    if process is None:
        with ReadingProcess() as own:
            return take(file, choice, to_hz, progress=progress, stop=stop, process=own)
    found = process.look(file, stop=stop)
    wanted = choice or suggested(found)
    raw = read_part(file, found, wanted, process=process, progress=progress, stop=stop)
    return raw.taken(wanted, to_hz)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RawPart:
    """A part of a file as the file has it: what need not be read again for another unit or scale.

    Attributes
    ----------
    path, name
        The file; what the signal is called.
    values, stamps_s
        Numbers, (n,), those of three axes (3, n), and when each was; None where the rate says so.
    rate_hz
        The rate, where the file or the choice says it.
    lasts_s
        Length of the whole signal.
    landmarks_s
        When each of up to 601 of all samples was, evenly chosen among them, the last one too; None
        where the rate says so.
    read_for
        What of the choice decided what was read.
    """

    path: Path
    name: str
    values: NDArray[Any]
    stamps_s: Floats | None
    rate_hz: float | None
    lasts_s: float
    landmarks_s: Floats | None
    read_for: tuple[object, ...]

    @property
    def n_missing(self) -> int:
        """Numbers that are not there, or not finite."""
        return self.values.size - int(np.count_nonzero(np.isfinite(self.values)))

    def taken(self, choice: ImportChoice, to_hz: float) -> Taken:
        """What ``choice`` makes of it; raises `RecordingError`."""
        try:
            wanted = replace(choice, rate_hz=self.rate_hz)
            return taken(self.values, wanted, to_hz, name=self.name, stamps_s=self.stamps_s)
        except InvalidInputError as error:
            raise _about(self.path, error) from error


def read_for(choice: ImportChoice) -> tuple[object, ...]:
    """What of a choice decides what is read."""
    stamps = (choice.time, choice.time_unit_s) if choice.time else (choice.rate_hz,)
    return (choice.series, choice.others, choice.start_s, choice.duration_s, *stamps)


def read_part(
    path: Path,
    found: Found,
    choice: ImportChoice,
    *,
    process: ReadingProcess,
    progress: Progress = silent,
    stop: Stop = never,
) -> RawPart:
    """Read the part of a file that ``choice`` means; raises what `take` raises."""
    axes = [found.one(key) for key in (choice.series, *choice.others)]
    if None in axes:
        absent = (choice.series, *choice.others)[axes.index(None)]
        keys = ", ".join(one.key for one in found.series[:8])
        raise RecordingError(
            f"{named(Path(path.name))}: it has no signal {quoted(absent)}, expected one of "
            f"{keys:.200}. Choose one of them."
        )
    read = partial(process.read, path, progress=progress, stop=stop)
    try:
        return _read(path, found, [one for one in axes if one is not None], choice, read)
    except InvalidInputError as error:
        raise _about(path, error) from error


def _read(
    path: Path,
    found: Found,
    axes: Sequence[Series],
    choice: ImportChoice,
    read: Callable[..., Block],
) -> RawPart:
    series, keys = axes[0], [one.key for one in axes]
    if len({(one.n_samples, one.unit) for one in axes}) > 1:
        raise InvalidInputError(
            "the axes are not equally long or not in one unit; choose others, or one alone"
        )
    names = ", ".join(one.name for one in axes)
    part: dict[str, Any] = {
        "path": path,
        "name": f"{path.name}, {names}" if len(found.signals()) > 1 else path.name,
        "read_for": read_for(choice),
    }
    if choice.time is None:
        rate_hz = choice.rate_hz or found.rate_of(series)
        if rate_hz is None:
            raise InvalidInputError("the file does not say its sample rate; type it in")
        start = round(choice.start_s * rate_hz)
        end = min(start + max(round(choice.duration_s * rate_hz), 1), series.n_samples)
        lasts_s = series.n_samples / rate_hz
        _check_part(start, end, lasts_s)
        values = _alone(read(keys, start, end))
        return RawPart(
            values=values,
            stamps_s=None,
            rate_hz=rate_hz,
            lasts_s=lasts_s,
            landmarks_s=None,
            **part,
        )
    stamps = read([choice.time], 0, series.n_samples)[0]
    # 64-bit also where the file has fewer digits: their differences are what counts.
    since_s = (stamps.astype(np.float64) - float(stamps[0])) * choice.time_unit_s
    start, end = np.searchsorted(
        since_s, (choice.start_s - _LITTLE_S, choice.start_s + choice.duration_s - _LITTLE_S)
    ).tolist()
    _check_part(start, end, float(since_s[-1]))
    values = _alone(read(keys, start, end))
    n = since_s.size
    chosen = np.linspace(0, n - 1, min(n, _LANDMARKS)).astype(np.int64)
    return RawPart(
        values=values,
        stamps_s=since_s[start:end],
        rate_hz=None,
        # The last sample too lasts for a step.
        lasts_s=float(since_s[-1]) * n / max(n - 1, 1),
        landmarks_s=since_s[chosen],
        **part,
    )


def _alone(block: Block) -> Block:
    return block if len(block) > 1 else block[0]


def _about(path: Path, error: InvalidInputError) -> RecordingError:
    return RecordingError(f"{named(Path(path.name))}: {sentence(str(error))}")


def _check_part(start: int, end: int, lasts_s: float) -> None:
    if end <= start:
        raise InvalidInputError(
            f"the part begins after the end, which is at {lasts_s:.6g} s; choose an earlier one"
        )
