"""Recordings from foreign files: what a file holds, what is taken of it, and what comes of that.

>>> from skinsource import recordings
>>> list(recordings.UNITS)
['full scale', 'm/s²', 'g', 'mm/s', 'µm', 'N', 'V']
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from skinsource.base.arguments import one_of, positive_number, real_number
from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError, RecordingError
from skinsource.base.files import named
from skinsource.base.job import Progress, Stop, never, silent
from skinsource.base.published import SAMPLE_RATE_HZ
from skinsource.base.quoting import quoted, sentence
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


# What is taken of a foreign file, and what becomes of it.

#: What becomes of the size: the largest number becomes 1, or all stays as it is.
Scale = Literal["peak", "keep"]
#: What becomes of numbers that are not there: nothing is taken, or they count as 0.
Missing = Literal["refuse", "zero"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportChoice:
    """One signal of a file, what it means, and which part of it is wanted.

    Attributes
    ----------
    series
        Key of the signal.
    rate_hz
        Samples a second; None: as the time stamps say.
    time
        Key of the time stamps; None: there are none, or they do not count.
    time_unit_s
        What one of them is in seconds.
    unit
        One of `skinsource.readers.units.UNITS`.
    scale
        ``"peak"``: a drive of peak 1; ``"keep"``: the size it has, accelerations in m/s².  See
        `usual_scale`.
    remove_offset
        Whether the mean of the part is taken off.
    start_s, duration_s
        The part, from the first sample of the file on; at most 600 s.
    missing
        What becomes of numbers that are not there.
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
    """What is likely to be wanted of a unit: a physical one keeps its size, full scale has none."""
    return "keep" if UNITS[unit].becomes else "peak"


def suggested(found: Found, series: Series | None = None) -> ImportChoice:
    """What is likely to be wanted: the first signal of a file, as far as the file describes it."""
    signal = series or found.signals()[0]
    stated = found.rate_of(signal)
    timestamps = found.time_of(signal)
    unit = signal.unit or "full scale"
    return ImportChoice(
        series=signal.key,
        rate_hz=stated if timestamps is None else None,
        time=timestamps.key if timestamps else None,
        time_unit_s=timestamps.time_unit_s if timestamps else 1.0,
        unit=unit,
        scale=usual_scale(unit),
    )


# From the raw numbers of a file to what a waveform plays: pure functions of both.

_MOST_NAME = 200
# Shares of the energy that are smaller are what edges ring.
_NOTED_LOSS = 0.01
# Of the largest deviation from it.
_NOTED_OFFSET = 1e-3
_BLOCK = 2**18


@dataclass(frozen=True, slots=True, kw_only=True)
class Taken:
    """What came of a part of a file.

    Attributes
    ----------
    samples
        At the rate that was asked for, with their unit.
    name
        Of the file, and of the signal where it has several.
    from_hz
        The rate of the file.
    notes
        What was done to it, in sentences.
    """

    samples: Samples
    name: str
    from_hz: float
    notes: tuple[str, ...] = ()

    @property
    def waveform(self) -> Recording:
        """What a clip plays of it."""
        return Recording(self.samples, self.name[:_MOST_NAME], self.from_hz)


def taken(
    values: NDArray[Any],
    choice: ImportChoice,
    to_hz: float,
    *,
    name: str = "",
    stamps_s: Floats | None = None,
) -> Taken:
    """Return what ``choice`` makes of the raw numbers of the part.

    In this order: missing numbers are refused or become 0; time stamps that are not steady are
    made so; the mean is taken off; the rate is changed by `skinsource.signals.resampling.resample`;
    the unit becomes that of a drive, velocities and displacements by their derivatives from 25 Hz
    on; the peak becomes 1.  Whatever is not asked for changes no bit.

    Parameters
    ----------
    values : (n,) or (3, n)
        As the file holds them; n >= 1.  Three axes become one signal by `three_axes.dft321`.
    choice
        What they are; start and duration are not looked at: this is the part.
    to_hz
        The rate of the result.
    name
        What it is called.
    stamps_s : (n,)
        When each was, in s; None where the rate says so.

    Raises
    ------
    InvalidInputError
        Nothing is left, numbers are missing, the rate is not known, or stamps do not increase.
    """
    if values.ndim not in (1, 2) or not values.size:
        raise InvalidInputError("there is no sample in this part; choose another one")
    notes: list[str] = []
    if values.ndim == 1:
        signal, rate = _at_one_rate(_complete(values, choice, notes), choice, stamps_s, notes)
    else:
        signal, rate = _of_axes(values, choice, stamps_s, notes)
    offset = _offset_of(signal, choice, notes)
    ratio = Fraction(to_hz).limit_denominator(10_000) / rate
    resampled = by_ratio(signal, ratio, min(float(rate), to_hz), offset=offset)
    _note_loss(_energy(signal, offset), resampled, ratio, to_hz, notes)
    resampled, unit = _in_drive_units(resampled, choice, to_hz, notes)
    return Taken(
        samples=Samples(values=resampled, sample_rate_hz=to_hz, unit=unit),
        name=name,
        from_hz=float(rate),
        notes=tuple(notes),
    )


def _of_axes(
    axes: NDArray[Any], choice: ImportChoice, stamps_s: Floats | None, notes: list[str]
) -> tuple[Floats, Fraction]:
    """One signal of three axes, and its rate; the offset of each goes before, if it is unwanted."""
    signals: list[Floats] = []
    rate, axis_notes = Fraction(1), list[str]()
    for axis in axes:
        signal, rate = _at_one_rate(
            _complete(axis, choice, axis_notes), choice, stamps_s, axis_notes
        )
        signals.append(np.asarray(signal, np.float64) - _offset_of(signal, choice, axis_notes))
    notes += dict.fromkeys(axis_notes)
    notes.append(
        "Three axes became one with the energy of all at each frequency (DFT321, Landin et al. "
        "2010)."
    )
    return dft321(np.stack(signals)), rate


def _at_one_rate(
    signal: NDArray[Any], choice: ImportChoice, stamps_s: Floats | None, notes: list[str]
) -> tuple[NDArray[Any], Fraction]:
    if stamps_s is None:
        if choice.rate_hz is None:
            raise InvalidInputError("the file does not say its sample rate; type it in")
        return signal, Fraction(choice.rate_hz).limit_denominator(10_000)
    pace = sample_clock(stamps_s)
    if pace.steady:
        return signal, pace.rate_hz
    notes.append(pace.note)
    return at_steady_rate(np.asarray(signal, np.float64), stamps_s, pace.rate_hz), pace.rate_hz


def _complete(values: NDArray[Any], choice: ImportChoice, notes: list[str]) -> NDArray[Any]:
    finite = np.isfinite(values)
    absent = values.size - int(np.count_nonzero(finite))
    if not absent:
        return values
    first = int(np.argmin(finite)) + 1
    if choice.missing == "refuse":
        raise InvalidInputError(
            f"{absent} of {values.size} numbers are missing or not finite, the first is number "
            f"{first} of this part; let them count as 0, or choose another part"
        )
    notes.append(f"{absent} missing numbers count as 0, the first is number {first}.")
    return np.where(finite, values, values.dtype.type(0))


def _offset_of(signal: NDArray[Any], choice: ImportChoice, notes: list[str]) -> float:
    """What is to be taken off each number; a copy of them all would take much memory."""
    if not choice.remove_offset:
        return 0.0
    mean = float(np.mean(signal, dtype=np.float64))
    most = max(float(signal.max()) - mean, mean - float(signal.min()))
    if abs(mean) > _NOTED_OFFSET * most:
        text = f"{mean:.4g}{_with_unit(choice)}".replace("-", "−")
        notes.append(f"An offset of {text} was taken off.")
    return mean


def _energy(signal: NDArray[Any], offset: float) -> float:
    """Sum of squares, without a copy of all numbers."""
    parts = (signal[k : k + _BLOCK].astype(np.float64) for k in range(0, signal.size, _BLOCK))
    return float(sum(np.sum((part - offset) ** 2) for part in parts))


def _note_loss(
    before: float, after: Floats, ratio: Fraction, to_hz: float, notes: list[str]
) -> None:
    """Say how much of the energy ``before`` lay above what the new rate can hold."""
    if ratio < 1 and before > 0.0:
        lost = 1.0 - float(np.vdot(after, after)) / float(ratio) / before
        if lost >= _NOTED_LOSS:
            share = f"{100.0 * lost:.0f} % of its energy"
            notes.append(f"{share} was above {to_hz / 2:g} Hz and is gone.")


def _in_drive_units(
    signal: Floats, choice: ImportChoice, rate_hz: float, notes: list[str]
) -> tuple[Floats, str]:
    unit = UNITS[choice.unit]
    if unit.derivatives:
        signal = differentiated(signal, rate_hz, unit.derivatives)
        how = "its derivative" if unit.derivatives == 1 else "its second derivative"
        notes.append(f"The acceleration is {how}, from 25 Hz on.")
    # A factor that is 1 changes no bit.
    signal = signal * unit.factor
    if choice.scale == "keep":
        return signal, unit.becomes
    peak = float(np.abs(signal).max())
    if not peak > 0.0:
        raise InvalidInputError("this part is silent and cannot be scaled to a peak of 1")
    return signal / peak, ""


def _with_unit(choice: ImportChoice) -> str:
    return "" if choice.unit == "full scale" else f" {choice.unit}"


# Looks at foreign files and takes parts of them, in a process of its own.

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
        See `skinsource.base.job`.
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
        with ReadingProcess() as own_process:
            return take(file, choice, to_hz, progress=progress, stop=stop, process=own_process)
    contents = process.look(file, stop=stop)
    choice_ = choice or suggested(contents)
    raw = read_part(file, contents, choice_, process=process, progress=progress, stop=stop)
    return raw.taken(choice_, to_hz)


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
            choice_ = replace(choice, rate_hz=self.rate_hz)
            return taken(self.values, choice_, to_hz, name=self.name, stamps_s=self.stamps_s)
        except InvalidInputError as error:
            raise _about(self.path, error) from error


def read_for(choice: ImportChoice) -> tuple[object, ...]:
    """What of a choice decides what is read."""
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
    """Read the part of a file that ``choice`` means; raises what `take` raises."""
    axes = [contents.one(key) for key in (choice.series, *choice.others)]
    if None in axes:
        absent = (choice.series, *choice.others)[axes.index(None)]
        keys = ", ".join(series.key for series in contents.series[:8])
        raise RecordingError(
            f"{named(Path(path.name))}: it has no signal {quoted(absent)}, expected one of "
            f"{keys:.200}. Choose one of them."
        )
    read = partial(process.read, path, progress=progress, stop=stop)
    try:
        return _read(path, contents, [axis for axis in axes if axis is not None], choice, read)
    except InvalidInputError as error:
        raise _about(path, error) from error


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
    names = ", ".join(axis.name for axis in axes)
    part: dict[str, Any] = {
        "path": path,
        "name": f"{path.name}, {names}" if len(contents.signals()) > 1 else path.name,
        "read_for": read_for(choice),
    }
    if choice.time is None:
        rate_hz = choice.rate_hz or contents.rate_of(series)
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
    timestamps = read([choice.time], 0, series.n_samples)[0]
    # 64-bit also where the file has fewer digits: their differences are what counts.
    since_s = (timestamps.astype(np.float64) - float(timestamps[0])) * choice.time_unit_s
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
