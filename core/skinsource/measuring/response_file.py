"""Measured responses from files of others."""

import os
from pathlib import Path

import numpy as np

from skinsource.actuators import MeasuredResponse
from skinsource.arguments import positive_number
from skinsource.arrays import Complexes, Floats
from skinsource.errors import InvalidInputError, RecordingError
from skinsource.files import named
from skinsource.measuring.sweep_response import response_from_sweep
from skinsource.quoting import quoted, sentence
from skinsource.recordings.found import Found
from skinsource.recordings.reading_process import ReadingProcess

_FREQUENCY = ("frequency", "freq", "f", "hz")
_GAIN, _GAIN_DB = ("gain", "magnitude", "mag", "amplitude", "response"), ("db", "gain_db", "level")
_RADIANS, _DEGREES = ("phase_rad",), ("phase_deg", "phase")
# So many names say what a table is.
_MOST_NAMES = 5
_REAL, _IMAGINARY = ("real", "re"), ("imag", "imaginary", "im")


def open_response(
    path: str | os.PathLike[str],
    *,
    volts_at_full_scale: float = 1.0,
    m_per_s2_at_full_scale: float = 1.0,
) -> MeasuredResponse:
    """The measured response that a file holds.

    A table (CSV, or another format that `skinsource.recordings` reads) has a column of frequencies
    (``frequency_hz``), and ``gain`` in m/s² per V, or ``gain_db`` re 1 m/s² per V, with
    ``phase_rad`` or ``phase_deg`` if it was measured; or ``real`` and ``imag``.  A sound file has
    the voltage of a sweep in its first channel, and what the accelerometer said in its second.

    Parameters
    ----------
    volts_at_full_scale, m_per_s2_at_full_scale
        What a sample of 1 is in the two channels of a sound file.

    Raises
    ------
    RecordingError
        The file holds nothing of that kind.
    StorageError
        It cannot be read.
    """
    file = Path(path)
    scales = (
        positive_number("volts_at_full_scale", volts_at_full_scale),
        positive_number("m_per_s2_at_full_scale", m_per_s2_at_full_scale),
    )
    with ReadingProcess() as process:
        found = process.look(file)
        rate_hz = found.rate_hz
        keys = [one.key for one in found.series]
        n_samples = min(one.n_samples for one in found.series)
        values = process.read(file, keys, 0, n_samples).astype(np.float64)
    try:
        table = _columns(found, values)
        if _FREQUENCY[0] in table:
            return _of_table(table)
        if rate_hz is None or len(values) < 2:
            raise InvalidInputError(
                f"it holds {_names(found)}; expected a table with columns frequency_hz and gain, "
                "or sound with a voltage and an acceleration"
            )
        return response_from_sweep(values[0] * scales[0], values[1] * scales[1], rate_hz)
    except InvalidInputError as error:
        raise RecordingError(f"{named(Path(file.name))}: {sentence(str(error))}") from error


def _names(found: Found) -> str:
    """What a file holds, in words, and only the first of many."""
    names = [quoted(one.name) for one in found.series]
    more = len(names) - _MOST_NAMES
    return ", ".join(names[:_MOST_NAMES]) + (f" and {more} more" if more > 0 else "")


def _columns(found: Found, values: Floats) -> dict[str, Floats]:
    """Columns by the first of the names that mean the same."""
    known = (_FREQUENCY, _GAIN, _GAIN_DB, _RADIANS, _DEGREES, _REAL, _IMAGINARY)
    table: dict[str, Floats] = {}
    for series, column in zip(found.series, values, strict=True):
        name = series.name.strip().lower().removesuffix("_hz").removesuffix(" (hz)")
        for names in known:
            if name in names:
                table.setdefault(names[0], column)
    return table


def _of_table(table: dict[str, Floats]) -> MeasuredResponse:
    frequency_hz = table[_FREQUENCY[0]]
    response: Complexes
    if _REAL[0] in table and _IMAGINARY[0] in table:
        response = table[_REAL[0]] + 1j * table[_IMAGINARY[0]]
    else:
        if _GAIN[0] in table:
            gain = table[_GAIN[0]]
        elif _GAIN_DB[0] in table:
            gain = 10.0 ** (table[_GAIN_DB[0]] / 20.0)
        else:
            raise InvalidInputError(
                "it has frequencies and no gain, expected a column gain, gain_db, or real and imag"
            )
        phase = table.get(_RADIANS[0])
        if phase is None:
            phase = np.radians(table.get(_DEGREES[0], np.zeros(gain.size)))
        response = gain.astype(np.complex128) * np.exp(1j * phase)
    return MeasuredResponse.of(frequency_hz, response)
