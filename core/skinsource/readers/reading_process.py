"""Recordings are read by a process of their own, so that no file can crash this one."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.base.conventions import Floats
from skinsource.base.errors import RecordingError
from skinsource.base.files import path_text
from skinsource.base.job import Progress, Stop, never, silent
from skinsource.base.run_limited import LimitedProcess, run_limited
from skinsource.readers import limits
from skinsource.readers.reader import Block, Found, from_tree

_EXPECTED = "WAV, FLAC, AIFF, OGG, a table of numbers, NPY, NPZ, MATLAB or HDF5"
_ADVICE = "The file may be damaged; record or export it again."


class ReadingProcess(LimitedProcess):
    """A process that reads recordings; see `skinsource.base.run_limited`."""

    def look(self, path: Path, *, stop: Stop = never) -> Found:
        """Return what a file holds.

        Raises
        ------
        RecordingError
            The file holds nothing usable, or reading it crashed or took too long.
        StorageError
            The file cannot be read.
        Stopped
            ``stop`` returned True.
        """
        (tree,) = self._run("look_tree", path, stop=stop)
        return from_tree(tree)

    def read(
        self,
        path: Path,
        keys: Sequence[str],
        start: int,
        end: int,
        *,
        progress: Progress = silent,
        stop: Stop = never,
    ) -> Block:
        """Return samples ``start`` to ``end`` of some series, (n_series, n).

        Raises what `look` does.
        """
        n = end - start
        if n < 0 or n * len(keys) * 8 > limits.MOST_BYTES:
            raise RecordingError(
                f"{path_text(Path(path.name))}: {n} samples are too many, expected at most "
                f"{limits.MOST_BYTES // 8}. Take a shorter part."
            )
        most = n * len(keys) * 8
        asked = {"keys": list(keys), "start": start, "end": end}
        parts = self._run("blocks", path, most_bytes=most, stop=stop, **asked)
        samples: Block = np.empty((len(keys), 0), np.float32)
        done = 0
        for part in parts:
            width = part.shape[1]
            if width and not done:
                samples = np.empty((len(keys), n), part.dtype)
            samples[:, done : done + width] = part
            done += width
            progress(done, n, f"Reading {path.name}")
        if done != n:
            raise RecordingError(
                f"{path_text(Path(path.name))}: {done} samples were found, expected {n}. {_ADVICE}"
            )
        return samples

    def overview(
        self, path: Path, key: str, n_samples: int, columns: int, *, stop: Stop = never
    ) -> Floats:
        """Return the smallest and largest value of each of ``columns`` stretches, (2, columns).

        Stretches without a number are NaN.  Raises what `look` does.
        """
        # It comes again with each block, which tells that the process is at work.
        asked = {"key": key, "n_samples": n_samples, "columns": columns}
        *_, extremes = self._run("overview", path, stop=stop, **asked)
        return np.asarray(extremes)

    def _run(self, function: str, path: Path, **options: Any) -> Iterator[Any]:
        function = f"skinsource.readers.readers:{function}"
        return run_limited(function, path, expected=_EXPECTED, process=self, **options)
