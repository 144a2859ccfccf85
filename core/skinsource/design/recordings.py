"""Import recordings from foreign files.

`look` reads what a file holds, an `ImportChoice` says which part of which signal is imported and
what its numbers mean, and `take` returns the part as a waveform plays it.  Files are read in a
process of their own; `taken` converts the raw numbers and is a pure function.

>>> from skinsource import recordings
>>> list(recordings.UNITS)
['full scale', 'm/s²', 'g', 'mm/s', 'µm', 'N', 'V']
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from skinsource.base.arguments import checking, one_of, positive_number, real_number
from skinsource.base.conventions import SAMPLE_RATE_HZ, Floats
from skinsource.base.errors import InvalidInputError, RecordingError, quoted, sentence
from skinsource.base.files import path_text
from skinsource.base.job import Progress, Stop, never, silent
from skinsource.design.waveforms.samples import Recording
from skinsource.readers import limits
from skinsource.readers.reader import Block, Found, Series, dft321
from skinsource.readers.reading_process import ReadingProcess
from skinsource.readers.timestamps import at_steady_rate, sample_clock
from skinsource.readers.units import UNITS, differentiated
from skinsource.signals.resampling import by_ratio
from skinsource.specs.samples import Samples

__all__ = [
    "UNITS",
    "Found",
    "ImportChoice",
    "Series",
    "Taken",
    "look",
    "suggested",
    "take",
    "taken",
]


#: Whether the largest number becomes 1 (``"peak"``) or all keep their size (``"keep"``).
Scale = Literal["peak", "keep"]
#: Whether missing numbers are an error (``"refuse"``) or count as 0 (``"zero"``).
Missing = Literal["refuse", "zero"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportChoice:
    """One signal of a file, what its numbers mean, and which part of it is imported.

    Attributes
    ----------
    series
        Key of the signal.
    rate_hz
        Samples a second; None: the rate follows from the time stamps.
    time
        Key of the time stamps; None: there are none, or they are ignored.
    time_unit_s
        Unit of the time stamps in seconds.
    unit
        One of `skinsource.readers.units.UNITS`.
    scale
        ``"peak"``: a drive of peak 1; ``"keep"``: the numbers keep their size, accelerations in
        m/s².  See `usual_scale`.
    remove_offset
        Whether the mean of the part is subtracted.
    start_s, duration_s
        The part, counted from the first sample of the file; at most 600 s.
    missing
        ``"refuse"``: missing numbers are an error; ``"zero"``: they count as 0.
    others
        Keys of the two other axes of the same movement: the three become one signal, see
        `skinsource.readers.reader.dft321`; none: the signal alone.
    """

    series: str
    rate_hz: float | None = None
    time: str | None = None
    time_unit_s: float = 1.0
    unit: str = "full scale"
    scale: Scale = "peak"
    remove_offset: bool = True
    start_s: float = 0.0
    duration_s: float = limits.MOST_PART_S
    missing: Missing = "refuse"
    others: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.rate_hz is not None:
            least, most = limits.LEAST_RATE_HZ, limits.MOST_RATE_HZ
            expected = f"a rate from {least:g} to {most:g} Hz"
            real_number("rate_hz", self.rate_hz, expected, least=least, most=most)
        positive_number("time_unit_s", self.time_unit_s)
        one_of("unit", self.unit, tuple(UNITS))
        one_of("scale", self.scale, get_args(Scale))
        one_of("missing", self.missing, get_args(Missing))
        real_number("start_s", self.start_s, "a time of 0 or more", least=0.0, most=1e9)
        positive_number("duration_s", self.duration_s)
        most = limits.MOST_PART_S
        real_number("duration_s", self.duration_s, f"a time of up to {most:g} s", most=most)
        three = {self.series, *self.others}
        if self.others and (len(self.others) != 2 or len(three) != 3):
            raise InvalidInputError(
                f"others are {quoted(self.others)}, expected the keys of the two other axes; name "
                "two different ones, or none"
            )


def usual_scale(unit: str) -> Scale:
    """Return the usual scale: ``"keep"`` for a physical unit, ``"peak"`` for full scale."""
    return "keep" if UNITS[unit].becomes else "peak"


@checking
def suggested(found: Found, series: Series | None = None) -> ImportChoice:
    """Return the usual choice: the first signal of a file, described as the file describes it.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "tap.csv"
    ...     lines = (f"{k / 1000},{k % 2}" for k in range(100))
    ...     _ = path.write_text(chr(10).join(["time (s),acceleration (g)", *lines]))
    ...     print(ss.recordings.suggested(ss.recordings.look(path)).unit)
    g
    """
    signal = series or found.signals()[0]
    timestamps = found.time_of(signal)
    unit = signal.unit or "full scale"
    return ImportChoice(
        series=signal.key,
        rate_hz=found.rate_of(signal) if timestamps is None else None,
        time=timestamps.key if timestamps else None,
        time_unit_s=timestamps.time_unit_s if timestamps else 1.0,
        unit=unit,
        scale=usual_scale(unit),
    )


_LONGEST_NAME = 200
# A smaller lost share of the energy can be mere ringing at the edges.
_LEAST_NOTED_LOSS = 0.01
# Share of the largest deviation from the offset.
_LEAST_NOTED_OFFSET = 1e-3
_BLOCK = 2**18


@dataclass(frozen=True, slots=True, kw_only=True)
class Taken:
    """An imported part of a file.

    Attributes
    ----------
    samples
        Samples at the chosen rate, with their unit.
    name
        Name of the file, and of the signal where the file has several.
    from_hz
        Sample rate of the file.
    notes
        Sentences about what was changed.
    """

    samples: Samples
    name: str
    from_hz: float
    notes: tuple[str, ...] = ()

    @property
    def waveform(self) -> Recording:
        """Return the waveform for a clip."""
        return Recording(self.samples, self.name[:_LONGEST_NAME], self.from_hz)


def at_common_peak(parts: Sequence[Taken]) -> tuple[Taken, ...]:
    """Return parts that keep their sizes, scaled together to a largest peak of 1.

    Raises
    ------
    InvalidInputError
        All of them are silent.
    """
    peak = max(part.samples.peak for part in parts)
    if not peak > 0.0:
        raise InvalidInputError("the parts are silent, without a peak to scale; choose others")
    return tuple(
        replace(part, samples=replace(part.samples, values=part.samples.values / peak, unit=""))
        for part in parts
    )


@checking
def taken(
    values: NDArray[Any],
    choice: ImportChoice,
    to_hz: float,
    *,
    name: str = "",
    stamps_s: Floats | None = None,
) -> Taken:
    """Convert the raw numbers of a part as ``choice`` says.

    In this order: missing numbers are refused or become 0; samples at unsteady times are resampled
    to a steady rate; the mean is subtracted; the rate is changed by
    `skinsource.signals.resampling.resample`; velocities and displacements become accelerations by
    their derivatives from 25 Hz on; the peak becomes 1.  A step that ``choice`` does not include
    changes no bit.

    Parameters
    ----------
    values : (n,) or (3, n)
        Numbers as the file holds them; n >= 1.  Three axes become one signal by
        `skinsource.readers.reader.dft321`.
    choice
        What the numbers mean; start and duration are ignored, because ``values`` are the part.
    to_hz
        The rate of the result.
    name
        Name of the result.
    stamps_s : (n,)
        Time of each number in s; None where the rate gives it.

    Raises
    ------
    InvalidInputError
        The part is empty, numbers are missing, the rate is not known, or time stamps do not
        increase.
    """
    if values.ndim not in (1, 2) or not values.size:
        raise InvalidInputError("there is no sample in this part; choose another one")
    notes: list[str] = []
    if values.ndim == 1:
        signal, rate = _with_steady_rate(values, choice, stamps_s, notes)
    else:
        signal, rate = _one_signal(values, choice, stamps_s, notes)
    offset = _offset(signal, choice, notes)
    ratio = Fraction(to_hz).limit_denominator(10_000) / rate
    resampled = by_ratio(signal, ratio, min(float(rate), to_hz), offset=offset)
    before = _energy(signal, offset)
    if ratio < 1 and before > 0.0:
        lost = 1.0 - float(np.vdot(resampled, resampled)) / float(ratio) / before
        if lost >= _LEAST_NOTED_LOSS:
            share = f"{100.0 * lost:.0f} % of its energy"
            notes.append(f"{share} was above {to_hz / 2:g} Hz and was removed.")
    resampled, unit = _in_drive_units(resampled, choice, to_hz, notes)
    return Taken(
        samples=Samples(values=resampled, sample_rate_hz=to_hz, unit=unit),
        name=name,
        from_hz=float(rate),
        notes=tuple(notes),
    )


def _one_signal(
    axes: NDArray[Any], choice: ImportChoice, stamps_s: Floats | None, notes: list[str]
) -> tuple[Floats, Fraction]:
    """Join three axes, without their offsets where those are removed; return signal and rate."""
    signals: list[Floats] = []
    rate, axis_notes = Fraction(1), list[str]()
    for axis in axes:
        signal, rate = _with_steady_rate(axis, choice, stamps_s, axis_notes)
        signals.append(np.asarray(signal, np.float64) - _offset(signal, choice, axis_notes))
    notes += dict.fromkeys(axis_notes)
    notes.append(
        "Three axes became one with the energy of all at each frequency (DFT321, Landin et al. "
        "2010)."
    )
    return dft321(np.stack(signals)), rate


def _with_steady_rate(
    values: NDArray[Any], choice: ImportChoice, stamps_s: Floats | None, notes: list[str]
) -> tuple[NDArray[Any], Fraction]:
    """Return numbers without gaps in equal steps of time, and their rate."""
    signal = _without_gaps(values, choice, notes)
    if stamps_s is None:
        if choice.rate_hz is None:
            raise InvalidInputError("the file does not state its sample rate; enter it")
        return signal, Fraction(choice.rate_hz).limit_denominator(10_000)
    clock = sample_clock(stamps_s)
    if clock.steady:
        return signal, clock.rate_hz
    notes.append(clock.note)
    return at_steady_rate(np.asarray(signal, np.float64), stamps_s, clock.rate_hz), clock.rate_hz


def _without_gaps(values: NDArray[Any], choice: ImportChoice, notes: list[str]) -> NDArray[Any]:
    finite = np.isfinite(values)
    n_missing = values.size - int(np.count_nonzero(finite))
    if not n_missing:
        return values
    first = int(np.argmin(finite)) + 1
    if choice.missing == "refuse":
        raise InvalidInputError(
            f"{n_missing} of {values.size} numbers are missing or not finite, the first is number "
            f"{first} of this part; let them count as 0, or choose another part"
        )
    notes.append(f"{n_missing} missing numbers count as 0, the first is number {first}.")
    return np.where(finite, values, values.dtype.type(0))


def _offset(signal: NDArray[Any], choice: ImportChoice, notes: list[str]) -> float:
    """Return what is subtracted from each number; a copy of them all would take much memory."""
    if not choice.remove_offset:
        return 0.0
    mean = float(np.mean(signal, dtype=np.float64))
    most = max(float(signal.max()) - mean, mean - float(signal.min()))
    if abs(mean) > _LEAST_NOTED_OFFSET * most:
        unit = "" if choice.unit == "full scale" else f" {choice.unit}"
        text = f"{mean:.4g}{unit}".replace("-", "−")
        notes.append(f"An offset of {text} was removed.")
    return mean


def _energy(signal: NDArray[Any], offset: float) -> float:
    """Return the sum of squares without a copy of all numbers."""
    parts = (signal[k : k + _BLOCK].astype(np.float64) for k in range(0, signal.size, _BLOCK))
    return float(sum(np.sum((part - offset) ** 2) for part in parts))


def _in_drive_units(
    signal: Floats, choice: ImportChoice, rate_hz: float, notes: list[str]
) -> tuple[Floats, str]:
    unit = UNITS[choice.unit]
    if unit.derivatives:
        signal = differentiated(signal, rate_hz, unit.derivatives)
        how = "its derivative" if unit.derivatives == 1 else "its second derivative"
        notes.append(f"The acceleration is {how}, from 25 Hz on.")
    # A factor of 1 changes no bit.
    signal = signal * unit.factor
    if choice.scale == "keep":
        return signal, unit.becomes
    peak = float(np.abs(signal).max())
    if not peak > 0.0:
        raise InvalidInputError("the part is silent, without a peak to scale; choose another")
    return signal / peak, ""


# Rounding of a typed time.
_ROUNDING_S = 1e-12
_LANDMARKS = 601


@checking
def look(path: Path | str) -> Found:
    """Return what a file holds: WAV, FLAC, AIFF, OGG, CSV, NPY, NPZ, MATLAB or HDF5.

    A process of its own reads the file, because a damaged file can crash a reader.

    Raises
    ------
    RecordingError
        The file holds nothing that can be used, or reading it crashed or took too long.
    StorageError
        The file cannot be read.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "tap.csv"
    ...     lines = (f"{k / 1000},{k % 2}" for k in range(100))
    ...     _ = path.write_text(chr(10).join(["time (s),acceleration (g)", *lines]))
    ...     print(len(ss.recordings.look(path).series))
    2
    """
    with ReadingProcess() as process:
        return process.look(Path(path))


@checking
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
        What is imported; without it the first signal as the file describes it, which keeps its
        size in a physical unit and else gets a peak of 1.
    to_hz
        The rate of the result, in Hz.
    progress, stop
        See `skinsource.base.job`.
    process
        The process that reads; without it a new one.

    Raises
    ------
    RecordingError, StorageError
        As for `look`; or the chosen signal is not in the file or cannot be used.
    Stopped
        ``stop`` asked for it.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "tap.csv"
    ...     lines = (f"{k / 1000},{k % 2}" for k in range(100))
    ...     _ = path.write_text(chr(10).join(["time (s),acceleration (g)", *lines]))
    ...     print(ss.recordings.take(path).samples.values.size)
    130
    """
    file = Path(path)
    if process is None:
        with ReadingProcess() as own_process:
            return take(file, choice, to_hz, progress=progress, stop=stop, process=own_process)
    contents = process.look(file, stop=stop)
    choice = choice or suggested(contents)
    raw = read_part(file, contents, choice, process=process, progress=progress, stop=stop)
    return raw.converted(choice, to_hz)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RawPart:
    """A part of a file as the file holds it; another unit or scale needs no new reading.

    Attributes
    ----------
    path, name
        The file; the name of the signal.
    values, stamps_s
        Numbers, (n,), those of three axes (3, n), and the time of each; None where the rate gives
        it.
    rate_hz
        The rate, where the file or the choice gives it.
    lasts_s
        Length of the whole signal.
    landmarks_s
        Times of up to 601 samples, evenly chosen among all, the last one included; None where the
        rate gives them.
    """

    path: Path
    name: str
    values: NDArray[Any]
    timestamps_s: Floats | None
    rate_hz: float | None
    lasts_s: float
    landmarks_s: Floats | None

    @property
    def n_missing(self) -> int:
        """Count the numbers that are missing or not finite."""
        return self.values.size - int(np.count_nonzero(np.isfinite(self.values)))

    def converted(self, choice: ImportChoice, to_hz: float) -> Taken:
        """Convert the numbers as ``choice`` says; raises `RecordingError`."""
        try:
            choice = replace(choice, rate_hz=self.rate_hz)
            return taken(self.values, choice, to_hz, name=self.name, stamps_s=self.timestamps_s)
        except InvalidInputError as error:
            raise _recording_error(self.path, error) from error


def read_for(choice: ImportChoice) -> tuple[object, ...]:
    """Return the fields of a choice on which the reading depends."""
    rate = (choice.time, choice.time_unit_s) if choice.time else (choice.rate_hz,)
    return (choice.series, choice.others, choice.start_s, choice.duration_s, *rate)


def read_part(
    path: Path,
    contents: Found,
    choice: ImportChoice,
    *,
    process: ReadingProcess,
    progress: Progress = silent,
    stop: Stop = never,
) -> RawPart:
    """Read the chosen part of a file; raises what `take` raises."""
    keys_of_axes = (choice.series, *choice.others)
    axes = [contents.one(key) for key in keys_of_axes]
    if None in axes:
        absent = keys_of_axes[axes.index(None)]
        keys = ", ".join(series.key for series in contents.series[:8])
        raise RecordingError(
            f"{path_text(Path(path.name))}: it has no signal {quoted(absent)}, expected one of "
            f"{keys:.200}. Choose one of them."
        )
    read = partial(process.read, path, progress=progress, stop=stop)
    try:
        return _read(path, contents, [axis for axis in axes if axis is not None], choice, read)
    except InvalidInputError as error:
        raise _recording_error(path, error) from error


def _read(
    path: Path,
    contents: Found,
    axes: Sequence[Series],
    choice: ImportChoice,
    read: Callable[..., Block],
) -> RawPart:
    series, keys = axes[0], [axis.key for axis in axes]
    if len({(axis.n_samples, axis.unit) for axis in axes}) > 1:
        raise InvalidInputError(
            "the axes are not equally long or not in one unit; choose others, or one alone"
        )
    timestamps_s = landmarks_s = None
    if choice.time is None:
        rate_hz = choice.rate_hz or contents.rate_of(series)
        if rate_hz is None:
            raise InvalidInputError("the file does not state its sample rate; enter it")
        start = round(choice.start_s * rate_hz)
        end = min(start + max(round(choice.duration_s * rate_hz), 1), series.n_samples)
        lasts_s = series.n_samples / rate_hz
        _check_part(start, end, lasts_s)
    else:
        rate_hz = None
        timestamps = read([choice.time], 0, series.n_samples)[0]
        # 64-bit, since their differences matter, whatever precision the file has.
        since_s = (timestamps.astype(np.float64) - float(timestamps[0])) * choice.time_unit_s
        ends_s = (choice.start_s - _ROUNDING_S, choice.start_s + choice.duration_s - _ROUNDING_S)
        start, end = np.searchsorted(since_s, ends_s).tolist()
        _check_part(start, end, float(since_s[-1]))
        timestamps_s = since_s[start:end]
        n = since_s.size
        landmarks_s = since_s[np.linspace(0, n - 1, min(n, _LANDMARKS)).astype(np.int64)]
        # The last sample lasts for a step too.
        lasts_s = float(since_s[-1]) * n / max(n - 1, 1)
    values = read(keys, start, end)
    names = ", ".join(axis.name for axis in axes)
    return RawPart(
        path=path,
        name=f"{path.name}, {names}" if len(contents.signals()) > 1 else path.name,
        values=values if len(values) > 1 else values[0],
        timestamps_s=timestamps_s,
        rate_hz=rate_hz,
        lasts_s=lasts_s,
        landmarks_s=landmarks_s,
    )


def _recording_error(path: Path, error: InvalidInputError) -> RecordingError:
    return RecordingError(f"{path_text(Path(path.name))}: {sentence(str(error))}")


def _check_part(start: int, end: int, lasts_s: float) -> None:
    if end <= start:
        raise InvalidInputError(
            f"the part begins after the end of the file, at {lasts_s:.6g} s; choose an earlier one"
        )
