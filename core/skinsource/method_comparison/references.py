"""Exact values at chosen samples of each scene: kept in a file, for the processes that compare."""

import zlib
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from skinsource.arrays import Floats, Integers
from skinsource.errors import FileFormatError
from skinsource.files.assets import data_folder
from skinsource.quoting import printable, quoted

FILE_NAME = "bench-references.npz"
#: Samples of a window of 100 ms.
WINDOW_SAMPLES = 130

# What reading a file raises that is missing, cut short or changed.
_DAMAGE = (OSError, EOFError, KeyError, ValueError, BadZipFile, zlib.error)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Reference:
    """The response of a scene at chosen samples, exact to many more digits than float64 holds.

    Attributes
    ----------
    channels : (n_channels,)
        Output and axis as n_axes (output - 1) + axis.
    starts : (n_windows,)
        First sample of each window of 100 ms.
    samples : (n_channels, n_windows, n_samples)
        Which samples; the largest of each window is among them.
    peaks : (n_channels, n_windows)
        Largest magnitude of all samples of the window, m/s².
    high, low : (n_channels, n_windows, n_samples)
        The values: nearest float64, and what is left over, m/s².
    bound
        How far a value may be off, over the channel's peak.
    """

    channels: Integers
    starts: Integers
    samples: Integers
    peaks: Floats
    high: Floats
    low: Floats
    bound: float = 2.0**-77


def load_reference(key: str, path: Path | None = None) -> Reference:
    """Read the reference called ``key``, by default of those that come with the program.

    Raises
    ------
    FileFormatError
        The file is missing or damaged, or holds no such reference.
    """
    path = data_folder() / FILE_NAME if path is None else path
    try:
        with path.open("rb") as file, np.load(file, allow_pickle=False) as stored:
            read = partial(_read, stored, key)
            starts = read("starts").astype(np.int64)
            return Reference(
                channels=read("channels").astype(np.int64),
                starts=starts,
                samples=starts[None, :, None] + read("offsets"),
                peaks=read("peaks"),
                high=read("high"),
                low=read("low").astype(np.float64),
            )
    except _DAMAGE as error:
        raise FileFormatError(
            f"{path}: the reference {quoted(key)} cannot be read ({printable(error)}). "
            "Install SkinSource studio again."
        ) from error


def _read(stored: np.lib.npyio.NpzFile, key: str, name: str) -> NDArray[Any]:
    return np.asarray(stored[f"{key}/{name}"])
