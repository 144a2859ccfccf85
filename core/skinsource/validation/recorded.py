"""Recorded responses from files of others."""

import os
from pathlib import Path

import numpy as np

from skinsource.arrays import Floats
from skinsource.errors import RecordingError
from skinsource.files import named
from skinsource.recordings.reading_process import ReadingProcess


def open_recorded(
    path: str | os.PathLike[str], n_outputs: int, n_axes: int, sample_rate_hz: float
) -> Floats:
    """Return the responses of a CSV, NPZ, MATLAB or HDF5 file, (n_outputs, n_axes, n_times).

    Its signals are columns: output 1 along each axis, then output 2, and so on; a column of times
    is left out.  The file is read in a process of its own.

    Parameters
    ----------
    path
        The file.
    n_outputs, n_axes
        What it has to hold; with a single column for each output ``n_axes`` is 1.
    sample_rate_hz
        Rate that it has to have, where it says one.

    Raises
    ------
    RecordingError
        It holds another number of signals, or another rate.
    StorageError
        It cannot be read.
    """
    file = Path(path)
    with ReadingProcess() as process:
        found = process.look(file)
        signals = [one for one in found.series if not one.is_time]
        expected = n_outputs * n_axes
        if len(signals) != expected or len({one.n_samples for one in signals}) != 1:
            raise RecordingError(
                f"{named(Path(file.name))}: {len(signals)} signals, expected {expected} of one "
                f"length: {n_outputs} outputs along {n_axes} axes, output by output. Save the "
                "responses as a table of times by outputs and axes."
            )
        if found.rate_hz is not None and abs(found.rate_hz - sample_rate_hz) > 1e-3:
            raise RecordingError(
                f"{named(Path(file.name))}: {found.rate_hz:g} Hz, expected the rate of the limb, "
                f"{sample_rate_hz:g} Hz. Resample it before."
            )
        keys = [one.key for one in signals]
        values = process.read(file, keys, 0, signals[0].n_samples).astype(np.float64)
    if not np.isfinite(values).all():
        raise RecordingError(
            f"{named(Path(file.name))}: it holds values that are no finite numbers, expected m/s²"
        )
    return values.reshape(n_outputs, n_axes, -1)
