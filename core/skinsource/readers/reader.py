"""What a foreign file holds, what a reader of one format is, and what is done with its signals.

For long signals there is an overview of extremes; three axes of one acceleration become one signal
by DFT321.
"""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

from skinsource.base.conventions import Floats
from skinsource.base.errors import RecordingError
from skinsource.base.files import path_text
from skinsource.readers import limits


@dataclass(frozen=True, slots=True, kw_only=True)
class Series:
    """One signal of a file: a channel, a column, a dataset or a column of one.

    Attributes
    ----------
    key
        Identifies it for the reader; unique in its file.
    name
        Its name for the user: "channel 1", "acc_x", "tap/acceleration, column 2".
    n_samples
        Number of samples.
    dtype
        Type in the file, in numpy's words: "int16", "float64"; "text" in tables.
    shape
        Shape of the dataset it is part of.
    unit
        One of `skinsource.readers.units.UNITS`; empty where the file does not say.
    rate_hz
        Sample rate; None where the file does not say.
    is_time
        Whether its name says that it holds times.
    time_unit_s
        Unit of the times in seconds.
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
    """The signals that a file offers.

    Attributes
    ----------
    format
        Its format: "WAV".
    series
        At least one, in the order of the file.
    rate_hz
        Sample rate of all signals, where the file states one.
    rate_from
        Where it states it: "the header", "'fs'".
    notes
        Sentences on what was left out or looks odd.
    """

    format: str
    series: tuple[Series, ...]
    rate_hz: float | None = None
    rate_from: str = ""
    notes: tuple[str, ...] = ()

    def signals(self) -> tuple[Series, ...]:
        """Return the series that are not times; all if there are no others."""
        return tuple(series for series in self.series if not series.is_time) or self.series

    def one(self, key: str) -> Series | None:
        """Return the series of that key; None if there is none."""
        return next((series for series in self.series if series.key == key), None)

    def rate_of(self, series: Series) -> float | None:
        """Return the sample rate of a series in Hz; None where the file does not say."""
        return series.rate_hz or self.rate_hz

    def time_of(self, series: Series) -> Series | None:
        """Return the timestamps of a series: as long as it, from the same group if possible."""
        timestamps = [
            candidate
            for candidate in self.series
            if candidate.is_time
            and candidate.n_samples == series.n_samples
            and candidate.key != series.key
        ]
        group = series.key.rpartition("/")[0]
        return next(
            (candidate for candidate in timestamps if candidate.key.rpartition("/")[0] == group),
            timestamps[0] if timestamps else None,
        )


def from_tree(tree: Mapping[str, Any]) -> Found:
    """Return what was made a tree for JSON by ``asdict``."""
    series = tuple(
        Series(**{**fields, "shape": tuple(fields["shape"])}) for fields in tree["series"]
    )
    return Found(**{**tree, "series": series, "notes": tuple(tree["notes"])})


#: Consecutive samples, (n_series, n), float32 where that holds all of the file's digits.
Block = Floats | NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class Reader:
    """Reads files of one format.

    Attributes
    ----------
    name
        Name of the format: "WAV".
    endings
        Endings of file names.
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
    """Return the error that says what is wrong with a file, what was expected and what to do."""
    return RecordingError(f"{path_text(Path(path.name))}: {actual}, expected {expected}. {advice}")


def check_rate(path: Path, rate_hz: float) -> float:
    """Return a rate that a file states; raise an error if no recording has such a rate."""
    if not limits.LEAST_RATE_HZ <= rate_hz <= limits.MOST_RATE_HZ:  # also refuses NaN
        raise reading_error(
            path,
            f"its sample rate is {rate_hz:g} Hz",
            f"{limits.LEAST_RATE_HZ:g} to {limits.MOST_RATE_HZ:g} Hz",
            "The file is damaged; record or export it again.",
        )
    return float(rate_hz)


def unknown_series_error(path: Path, key: str) -> RecordingError:
    """Return the error for a key that the file did not offer; the file may have changed."""
    return reading_error(
        path, f"it has no signal {key!r:.80}", "one that it offered", "Open the file again."
    )


class Overview:
    """Smallest and largest value of each stretch of a long signal, which is added block by block.

    Parameters
    ----------
    n_samples
        Length of the signal.
    columns
        Number of stretches of equal length; at most ``n_samples``.

    Attributes
    ----------
    extremes : (2, columns)
        Smallest and largest value; NaN where no sample was added.
    done
        Number of samples that were added.
    """

    def __init__(self, n_samples: int, columns: int) -> None:
        columns = max(min(columns, n_samples), 1)
        self._starts = np.arange(columns, dtype=np.int64) * n_samples // columns
        self.extremes: Floats = np.full((2, columns), np.nan)
        self.done = 0

    def add(self, block: Block) -> None:
        """Add the next samples, (1, n)."""
        n = block.shape[1]
        if not n:
            return
        first = int(np.searchsorted(self._starts, self.done, side="right")) - 1
        last = int(np.searchsorted(self._starts, self.done + n))
        starts = np.maximum(self._starts[first:last] - self.done, 0)
        least, largest = self.extremes[:, first:last]
        # fmin and fmax prefer any number to NaN.
        least[:] = np.fmin(least, np.fmin.reduceat(block[0], starts))
        largest[:] = np.fmax(largest, np.fmax.reduceat(block[0], starts))
        self.done += n


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
    """
    spectra = scipy.fft.rfft(axes, axis=1)
    # Where the axes cancel, their sum has no phase, and 0 is as good as any.
    phasor = np.exp(1j * np.angle(spectra.sum(axis=0)))
    magnitude = np.sqrt(np.sum(np.abs(spectra) ** 2, axis=0))
    return scipy.fft.irfft(magnitude * phasor, axes.shape[1])


def other_axes(content: Found, series: Series) -> tuple[Series, ...]:
    """Return the two axes that belong to ``series``; empty where the file does not tell.

    They are as long, in the same unit and of the same group, and their names are those of x, y and
    z; without such names, a file that holds just three such signals holds three axes.
    """
    candidates = signals_beside(content, series)
    name = _AXIS.match(series.name)
    if name is not None:
        other_parts = (name[1], name[3])
        axes = [
            signal
            for signal in candidates
            if (m := _AXIS.match(signal.name)) and (m[1], m[3]) == other_parts
        ]
        letters = {_AXIS.match(axis.name)[2].lower() for axis in axes}  # type: ignore[index]
        if len(axes) == N_AXES and len(letters) == N_AXES:
            return tuple(axis for axis in axes if axis.key != series.key)
    if len(candidates) == N_AXES:
        return tuple(signal for signal in candidates if signal.key != series.key)
    return ()


def signals_beside(content: Found, series: Series) -> tuple[Series, ...]:
    """Return the signals as long as ``series``, in its unit and of its group, itself included."""
    return tuple(signal for signal in content.signals() if _group_of(signal) == _group_of(series))


def _group_of(series: Series) -> tuple[object, ...]:
    return series.n_samples, series.unit, series.rate_hz, series.key.rpartition("/")[0]
