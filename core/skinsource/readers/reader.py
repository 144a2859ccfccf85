"""What a foreign file holds, as far as it says so itself."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError, RecordingError
from skinsource.base.files import named
from skinsource.readers import limits


@dataclass(frozen=True, slots=True, kw_only=True)
class Series:
    """One signal of a file: a channel, a column, a dataset or a column of one.

    Attributes
    ----------
    key
        How the reader finds it again; unique in its file.
    name
        What a user calls it: "channel 1", "acc_x", "tap/acceleration, column 2".
    n_samples
        How many numbers there are.
    dtype
        How the file keeps them, in numpy's words: "int16", "float64"; "text" in tables.
    shape
        That of the dataset it is part of.
    unit
        One of `skinsource.readers.units.UNITS`; empty where the file does not say.
    rate_hz
        Samples a second; None where the file does not say.
    is_time
        Whether its name is one of time.
    time_unit_s
        What one of it means in seconds, where it is time.
    """

    key: str
    name: str
    n_samples: int
    dtype: str
    shape: tuple[int, ...] = ()
    unit: str = ""
    rate_hz: float | None = None
    is_time: bool = False
    time_unit_s: float = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Found:
    """All that a file offers.

    Attributes
    ----------
    format
        Its format: "WAV".
    series
        Its signals, in its order; at least one.
    rate_hz
        Samples a second, where the file says it for all.
    rate_from
        Where it says so: "the header", "'fs'".
    notes
        What was left out or looks odd, in sentences.
    """

    format: str
    series: tuple[Series, ...]
    rate_hz: float | None = None
    rate_from: str = ""
    notes: tuple[str, ...] = ()

    def signals(self) -> tuple[Series, ...]:
        """What can be felt: all that is not time, or all if nothing else is there."""
        return tuple(series for series in self.series if not series.is_time) or self.series

    def one(self, key: str) -> Series | None:
        """The series of that key."""
        return next((series for series in self.series if series.key == key), None)

    def rate_of(self, series: Series) -> float | None:
        """Samples a second of a series; None where the file does not say."""
        return series.rate_hz or self.rate_hz

    def time_of(self, series: Series) -> Series | None:
        """The time stamps of a series: as many as it has samples, from the same group if any."""
        stamps = [
            candidate
            for candidate in self.series
            if candidate.is_time
            and candidate.n_samples == series.n_samples
            and candidate.key != series.key
        ]
        group = series.key.rpartition("/")[0]
        return next(
            (candidate for candidate in stamps if candidate.key.rpartition("/")[0] == group),
            stamps[0] if stamps else None,
        )


def to_tree(content: Found) -> dict[str, Any]:
    """Return ``found`` as JSON carries it."""
    return asdict(content)


def from_tree(tree: Mapping[str, Any]) -> Found:
    """Return what `to_tree` made; raise `TypeError` or `KeyError` on anything else."""
    series = tuple(
        Series(**{**fields, "shape": tuple(int(n) for n in fields["shape"])})
        for fields in tree["series"]
    )
    return Found(**{**tree, "series": series, "notes": tuple(map(str, _list(tree["notes"])))})


def _list(value: Iterable[object]) -> Iterable[object]:
    if isinstance(value, str):
        raise TypeError("expected a list")
    return value


# What reads one format of foreign files.

#: Samples one after another, (n_series, n), float32 where that holds all of the file's digits.
Block = NDArray[np.float64] | NDArray[np.float32]


@dataclass(frozen=True, slots=True, kw_only=True)
class Reader:
    """Reads files of one format.

    Attributes
    ----------
    name
        Of the format: "WAV".
    endings
        Of file names.
    recognises
        Whether the first bytes of a file, up to 4096 of them, are of this format.
    look
        Returns what a file holds; raises `RecordingError`, `StorageError`, or anything at all on
        damaged files.
    blocks
        Gives samples ``start`` to ``stop`` of the series of these keys, block by block; raises
        as ``look`` does.
    """

    name: str
    endings: tuple[str, ...]
    recognises: Callable[[bytes], bool]
    look: Callable[[Path], Found]
    blocks: Callable[[Path, Sequence[str], int, int], Iterator[Block]]


def reading_error(path: Path, actual: str, expected: str, advice: str) -> RecordingError:
    """The error that names the file, what is wrong with it, what was expected, and what to do."""
    return RecordingError(f"{named(Path(path.name))}: {actual}, expected {expected}. {advice}")


def check_rate(path: Path, rate_hz: float) -> float:
    """Return a rate that a file states; refuse one that no recording has."""
    if not limits.LEAST_RATE_HZ <= rate_hz <= limits.MOST_RATE_HZ:  # also refuses NaN
        raise reading_error(
            path,
            f"its sample rate is {rate_hz:g} Hz",
            f"{limits.LEAST_RATE_HZ:g} to {limits.MOST_RATE_HZ:g} Hz",
            "The file is damaged; record or export it again.",
        )
    return float(rate_hz)


def unknown_series_error(path: Path, key: str) -> RecordingError:
    """The file has changed, or somebody else asks."""
    return reading_error(
        path, f"it has no signal {key!r:.80}", "one that it offered", "Open the file again."
    )


# The least and the largest of each stretch of a long signal: enough for a picture of all of it.


class Overview:
    """Takes a signal block by block.

    Parameters
    ----------
    n_samples
        How long it is.
    columns
        Stretches of equal length; at most ``n_samples``.

    Attributes
    ----------
    extremes : (2, columns)
        Least and largest; NaN where nothing was seen.
    done
        Samples that were seen.
    """

    def __init__(self, n_samples: int, columns: int) -> None:
        columns = max(min(columns, n_samples), 1)
        self._starts = np.arange(columns, dtype=np.int64) * n_samples // columns
        self.extremes: Floats = np.full((2, columns), np.nan)
        self.done = 0

    def add(self, block: Block) -> None:
        """Take the next samples, (1, n)."""
        n = block.shape[1]
        if not n:
            return
        first = int(np.searchsorted(self._starts, self.done, side="right")) - 1
        last = int(np.searchsorted(self._starts, self.done + n))
        starts = np.maximum(self._starts[first:last] - self.done, 0)
        least, largest = self.extremes[:, first:last]
        # NaN loses against any number.
        least[:] = np.fmin(least, np.fmin.reduceat(block[0], starts))
        largest[:] = np.fmax(largest, np.fmax.reduceat(block[0], starts))
        self.done += n


# Three axes of one acceleration as one signal: which ones belong together, and DFT321.

N_AXES = 3
_AXIS = re.compile(r"^(.*?)([xyz])([^a-z]*)$", re.IGNORECASE)


def dft321(axes: Floats) -> Floats:
    """Return one signal with the energy of three at each frequency, (n,).

    Its spectrum has the magnitude sqrt(|X|² + |Y|² + |Z|²) and the phase of X + Y + Z: DFT321 of
    Landin, Romano, McMahan and Kuchenbecker, "Dimensional reduction of high-frequency
    accelerations for haptic rendering", EuroHaptics 2010.  The skin above some tens of hertz feels
    how strong a vibration is, and hardly in which direction.

    Parameters
    ----------
    axes : (3, n)
        The axes, in one unit; the transform is that of all n samples.

    Raises
    ------
    InvalidInputError
        They are not three rows of one or more finite numbers.
    """
    axes = np.asarray(axes, dtype=np.float64)
    if axes.ndim != 2 or axes.shape[0] != N_AXES or not axes.shape[1]:
        raise InvalidInputError(
            f"axes have the shape {axes.shape}, expected (3, n) with one sample or more; give three"
        )
    if not np.isfinite(axes).all():
        raise InvalidInputError("axes hold numbers that are not finite, expected none; leave out")
    spectra = scipy.fft.rfft(axes, axis=1)
    together = spectra.sum(axis=0)
    size = np.abs(together)
    # Where the axes cancel their sum has no phase: 0 is as good as any.
    turn = np.divide(together, size, out=np.ones_like(together), where=size > 0.0)
    magnitude = np.sqrt(np.sum(np.abs(spectra) ** 2, axis=0))
    return scipy.fft.irfft(magnitude * turn, axes.shape[1])


def other_axes(content: Found, series: Series) -> tuple[Series, ...]:
    """Return the two axes that belong to ``series``; empty where the file does not tell.

    They are as long, in the same unit and of the same group, and their names are those of x, y and
    z; without such names, a file that holds just three such signals holds three axes.
    """
    alike = [signal for signal in content.signals() if _likeness(signal) == _likeness(series)]
    name = _AXIS.match(series.name)
    if name is not None:
        around = (name[1], name[3])
        axes = [
            signal for signal in alike if (m := _AXIS.match(signal.name)) and (m[1], m[3]) == around
        ]
        letters = {_AXIS.match(axis.name)[2].lower() for axis in axes}  # type: ignore[index]
        if len(axes) == N_AXES and len(letters) == N_AXES:
            return tuple(axis for axis in axes if axis.key != series.key)
    if len(alike) == N_AXES:
        return tuple(signal for signal in alike if signal.key != series.key)
    return ()


def _likeness(series: Series) -> tuple[object, ...]:
    return series.n_samples, series.unit, series.rate_hz, series.key.rpartition("/")[0]
