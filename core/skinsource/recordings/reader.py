"""What reads one format of foreign files."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from skinsource.errors import RecordingError
from skinsource.files import named
from skinsource.recordings import limits
from skinsource.recordings.found import Found

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


def refusal(path: Path, found: str, expected: str, advice: str) -> RecordingError:
    """The error that names the file, what is wrong with it, what was expected, and what to do."""
    return RecordingError(f"{named(Path(path.name))}: {found}, expected {expected}. {advice}")


def check_rate(path: Path, rate_hz: float) -> float:
    """Return a rate that a file states; refuse one that no recording has."""
    if not limits.LEAST_RATE_HZ <= rate_hz <= limits.MOST_RATE_HZ:  # also refuses NaN
        raise refusal(
            path,
            f"its sample rate is {rate_hz:g} Hz",
            f"{limits.LEAST_RATE_HZ:g} to {limits.MOST_RATE_HZ:g} Hz",
            "The file is damaged; record or export it again.",
        )
    return float(rate_hz)


def unknown_series(path: Path, key: str) -> RecordingError:
    """The file has changed, or somebody else asks."""
    return refusal(
        path, f"it has no signal {key!r:.80}", "one that it offered", "Open the file again."
    )
