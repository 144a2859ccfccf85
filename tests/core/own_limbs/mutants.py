"""Damaged files of limbs by the thousand, and what may come of reading one.

A mutant of the layout in which labs hand limbs over is one clear error, or a limb whose numbers are
those that HDF5 itself reads from the mutant.
"""

from pathlib import Path

import h5py
import numpy as np

from skinsource.limbs import limb_import as importing_module
from skinsource.limbs.limb_import import LimbSource, PreparedLimb, prepare_limb
from skinsource.readers.reading_process import ReadingProcess
from tests.core.recordings.mutants import Tally, mutants, try_each

_LONGEST = 600


def whole_file(path: Path, responses: np.ndarray | None = None, **attributes) -> Path:
    """A limb in the layout of docs/limbs.md, by h5py alone: two places and four outputs, if any."""
    rng = np.random.default_rng(1)
    responses = rng.standard_normal((2, 4, 2, 8)) if responses is None else responses
    n_inputs, n_outputs = responses.shape[:2]
    with h5py.File(path, "w") as file:
        file.attrs.update(format="skinsource limb", format_version=1, name="ours", axes="xz")
        file.attrs.update(sample_rate_hz=4000.0, hand_length_mm=180.0, band_hz=(30.0, 1200.0))
        file.attrs.update(attributes)
        file["responses"] = responses
        file["map/outline"] = [[0.0, 0.0], [60.0, 0.0], [60.0, 100.0], [0.0, 100.0]]
        file["map/inputs"] = rng.uniform(0, 50, (n_inputs, 2))
        file["map/outputs"] = rng.uniform(0, 50, (n_outputs, 2))
        file["names/inputs"] = [f"site {k}" for k in range(1, n_inputs + 1)]
    return path


def read_layout(path: Path, process: ReadingProcess) -> tuple[PreparedLimb, np.ndarray]:
    """Read a limb of a file in the layout, and all of its responses."""
    prepared = prepare_limb(LimbSource(responses=path), process)
    blocks = importing_module._responses(path, prepared, process, lambda: False)
    return prepared, np.array(list(blocks)).reshape(prepared.limb.shape)


def try_layout(
    whole: Path, count: int, random_seed: int, folder: Path, process: ReadingProcess
) -> Tally:
    """Import ``count`` mutants of a file in the layout."""
    path = folder / "mutant.h5"

    def misread_in() -> str:
        prepared, read = read_layout(path, process)
        with h5py.File(path) as file:
            there = np.asarray(file["responses"][()], np.float64)
            axes = file.attrs["axes"]
        if prepared.limb.axes != str(axes):
            return f"along {prepared.limb.axes}"
        same = np.array_equal(read, there, equal_nan=True)
        return "" if same else "other responses than HDF5 reads"

    damaged = mutants(whole.read_bytes(), count, (random_seed, 0))
    return try_each("layout", damaged, path, misread_in, _is_clear)


def _is_clear(message: str) -> bool:
    named = "mutant" in message and "Traceback" not in message
    return named and "\n" not in message and len(message) < _LONGEST
