"""Looks at foreign files and takes parts of them, in a process of its own."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from skinsource.errors import InvalidInputError, RecordingError
from skinsource.files import named
from skinsource.job import Progress, Stop, never, silent
from skinsource.limb import SAMPLE_RATE_HZ
from skinsource.quoting import sentence
from skinsource.recordings.choice import ImportChoice, suggested
from skinsource.recordings.found import Found, Series
from skinsource.recordings.reading_process import ReadingProcess
from skinsource.recordings.taking import Taken, taken


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
        What is taken; without one the first signal, as the file describes it.
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
    series = found.one(wanted.series)
    if series is None:
        raise RecordingError(
            f"{named(Path(file.name))}: it has no signal {wanted.series!r:.80}, expected one of "
            f"{', '.join(one.key for one in found.series[:8])!s:.200}. Choose one of them."
        )
    try:
        return _part(file, found, series, wanted, to_hz, process, progress, stop)
    except InvalidInputError as error:
        raise RecordingError(f"{named(Path(file.name))}: {sentence(str(error))}") from error


def _part(
    path: Path,
    found: Found,
    series: Series,
    choice: ImportChoice,
    to_hz: float,
    process: ReadingProcess,
    progress: Progress,
    stop: Stop,
) -> Taken:
    several = len(found.signals()) > 1
    name = f"{path.name}, {series.name}" if several else path.name
    if choice.time is None:
        rate_hz = choice.rate_hz or found.rate_of(series)
        if rate_hz is None:
            raise InvalidInputError("the file does not say its sample rate; type it in")
        start = round(choice.start_s * rate_hz)
        end = min(start + max(round(choice.duration_s * rate_hz), 1), series.n_samples)
        _check_part(start, end, series.n_samples / rate_hz)
        values = process.read(path, [series.key], start, end, progress=progress, stop=stop)[0]
        return taken(values, replace(choice, rate_hz=rate_hz), to_hz, name=name)
    stamps = process.read(path, [choice.time], 0, series.n_samples, progress=progress, stop=stop)
    # 64-bit also where the file has fewer digits: their differences are what counts.
    since_s = (stamps[0].astype(np.float64) - stamps[0][0]) * choice.time_unit_s
    start = int(np.searchsorted(since_s, choice.start_s - 1e-12))
    end = int(np.searchsorted(since_s, choice.start_s + choice.duration_s - 1e-12))
    _check_part(start, end, float(since_s[-1]))
    values = process.read(path, [series.key], start, end, progress=progress, stop=stop)[0]
    return taken(values, choice, to_hz, name=name, stamps_s=since_s[start:end])


def _check_part(start: int, end: int, lasts_s: float) -> None:
    if end <= start:
        raise InvalidInputError(
            f"the part begins after the end, which is at {lasts_s:.6g} s; choose an earlier one"
        )
