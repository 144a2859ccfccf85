"""Recorded responses from files of others."""

import os
from collections.abc import Sequence
from contextlib import ExitStack
from itertools import permutations
from math import prod
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.arrays import Floats
from skinsource.counting import counted
from skinsource.errors import InvalidInputError, RecordingError
from skinsource.files import named
from skinsource.job import Stop, never
from skinsource.recordings import limits
from skinsource.recordings.found import Found, Series
from skinsource.recordings.reading_process import ReadingProcess
from skinsource.recordings.stamps import pace_of
from skinsource.resampling import resample

# Rates that differ by less are the same.
_SAME_HZ = 1e-3
# Time, outputs and axes of an array of three dimensions, the usual order first.
_ORDERS = ("toa", *(order for order in map("".join, permutations("toa")) if order != "toa"))


def open_recorded(
    path: str | os.PathLike[str],
    n_outputs: int,
    n_axes: int,
    sample_rate_hz: float,
    *,
    rate_hz: float | None = None,
    process: ReadingProcess | None = None,
    stop: Stop = never,
) -> Floats:
    """Return the responses of a CSV, NPZ, MATLAB or HDF5 file, (n_outputs, n_axes, n_times).

    They are an array of times, outputs and axes, in whichever order; or columns: output 1 along
    each axis, then output 2, and so on, beside a column of times or without one.  Of an array of
    times and channels, in either order, those are the channels of which there are as many as
    outputs and axes.  Those at another rate are resampled.  The file is read in a process of its
    own.

    Parameters
    ----------
    path
        The file.
    n_outputs, n_axes
        What it has to hold; with a single column for each output ``n_axes`` is 1.
    sample_rate_hz
        Rate of what is returned.
    rate_hz
        Rate of the file, where it says none itself; ``sample_rate_hz`` unless given.
    process
        Reads it; one of its own unless given.
    stop
        Asked now and then whether to give up.

    Raises
    ------
    RecordingError
        It holds another number of signals, numbers that are not finite, or a rate that cannot be
        resampled.
    StorageError
        It cannot be read.
    Stopped
        ``stop`` said so.
    """
    file = Path(path)
    with ExitStack() as stack:
        reader = process or stack.enter_context(ReadingProcess())
        field, stated_hz = _read(reader, file, n_outputs, n_axes, stop)
    if not np.isfinite(field).all():
        raise _refusal(file, "it holds values that are no finite numbers, expected m/s²")
    return _at_rate(file, field, stated_hz or rate_hz or sample_rate_hz, sample_rate_hz)


def _read(
    reader: ReadingProcess, file: Path, n_outputs: int, n_axes: int, stop: Stop
) -> tuple[Floats, float | None]:
    """The responses, and their rate as far as the file says it."""
    offered = reader.ask(file, {"do": "arrays"}, stop=stop)
    for array in offered["arrays"]:
        order = _order_of([int(n) for n in array["shape"]], n_outputs, n_axes)
        if order:
            rate_hz = array["rate_hz"] or offered["rate_hz"]
            field = _from_array(reader, file, array, order, stop)
            return field, None if rate_hz is None else float(rate_hz)
    shapes = ", ".join(" × ".join(map(str, one["shape"])) for one in offered["arrays"][:5])
    try:
        found = reader.look(file, stop=stop)
    except RecordingError:
        if not shapes:
            raise
        raise _refusal(
            file,
            f"its arrays are {shapes}, expected times × {counted(n_outputs, 'output')} × "
            f"{counted(n_axes, 'axis', 'axes')}",
        ) from None
    return _from_columns(reader, file, found, (n_outputs, n_axes), stop)


def _order_of(shape: Sequence[int], n_outputs: int, n_axes: int) -> str:
    """Which dimension is time, outputs and axes; empty where none fits."""
    for order in _ORDERS:
        if shape[order.index("o")] == n_outputs and shape[order.index("a")] == n_axes:
            return order
    return ""


def _from_array(
    reader: ReadingProcess, file: Path, array: dict[str, Any], order: str, stop: Stop
) -> Floats:
    shape = [int(n) for n in array["shape"]]
    if prod(shape) * 8 > limits.MOST_BYTES:
        raise _refusal(
            file, f"{prod(shape)} samples are too many, expected at most {limits.MOST_BYTES // 8}"
        )
    # One axis after another, as the responses of a limb come: input by input.
    request = {"do": "responses", "array": array["name"], "order": order.replace("a", "i")}
    along_each = list(reader.stream(file, request, stop=stop))
    if len(along_each) != shape[order.index("a")]:
        raise _refusal(file, "it ends too early, expected all axes")
    return np.stack(along_each, axis=1)


def _from_columns(
    reader: ReadingProcess, file: Path, found: Found, size: tuple[int, int], stop: Stop
) -> tuple[Floats, float | None]:
    n_outputs, n_axes = size
    signals = [one for one in found.series if not one.is_time]
    expected = n_outputs * n_axes
    if _are_instants(signals, expected):
        return _from_instants(reader, file, found, (signals, size), stop)
    if len(signals) != expected or len({one.n_samples for one in signals}) != 1:
        one_axis = f", or choose one axis (x, y or z), which takes {counted(n_outputs, 'signal')}"
        advice = one_axis if n_axes > 1 else ""
        raise _refusal(
            file,
            f"{counted(len(signals), 'signal')}, expected {expected} of one length: "
            f"{counted(n_outputs, 'output')} along {counted(n_axes, 'axis', 'axes')}, output "
            f"by output. Save the responses as an array of times by outputs by axes{advice}",
        )
    keys, n_times = [one.key for one in signals], signals[0].n_samples
    values = reader.read(file, keys, 0, n_times, stop=stop).astype(np.float64)
    rate_hz = found.rate_of(signals[0])
    times = found.time_of(signals[0])
    if rate_hz is None and times is not None:
        rate_hz = _rate_of_times(reader, file, times, stop)
    return values.reshape(n_outputs, n_axes, -1), rate_hz


def _are_instants(signals: Sequence[Series], expected: int) -> bool:
    """Whether what was taken for signals are instants: there are fewer of them than channels."""
    shapes = {one.shape for one in signals}
    return len(signals) != expected and shapes in (
        {(len(signals), expected)},
        {(expected, len(signals))},
    )


def _from_instants(
    reader: ReadingProcess,
    file: Path,
    found: Found,
    what: tuple[Sequence[Series], tuple[int, int]],
    stop: Stop,
) -> tuple[Floats, float | None]:
    instants, (n_outputs, n_axes) = what
    keys = [one.key for one in instants]
    rows = reader.read(file, keys, 0, n_outputs * n_axes, stop=stop).astype(np.float64)
    rate_hz = found.rate_of(instants[0])
    stamps = (one for one in found.series if one.is_time and one.n_samples == len(instants))
    times = next(stamps, None)
    if rate_hz is None and times is not None:
        rate_hz = _rate_of_times(reader, file, times, stop)
    return rows.T.reshape(n_outputs, n_axes, -1), rate_hz


def _rate_of_times(reader: ReadingProcess, file: Path, times: Series, stop: Stop) -> float:
    stamps = reader.read(file, [times.key], 0, times.n_samples, stop=stop).astype(np.float64)[0]
    try:
        pace = pace_of(stamps * times.time_unit_s)
    except InvalidInputError as error:
        raise _refusal(file, str(error)) from error
    if not pace.steady:
        raise _refusal(
            file, "its time stamps are not steady, expected steps of one length. Resample it before"
        )
    return float(pace.rate_hz)


def _at_rate(file: Path, field: Floats, from_hz: float, to_hz: float) -> Floats:
    if abs(from_hz - to_hz) <= _SAME_HZ:
        return field
    rates = [round(from_hz), round(to_hz)]
    if max(abs(rates[0] - from_hz), abs(rates[1] - to_hz)) > _SAME_HZ:
        raise _refusal(
            file,
            f"{from_hz:g} Hz, expected a whole number of hertz, or the rate of the limb, "
            f"{to_hz:g} Hz. Resample it before",
        )
    return resample(field, *rates)


def _refusal(file: Path, reason: str) -> RecordingError:
    return RecordingError(f"{named(Path(file.name))}: {reason.rstrip('.')}.")
