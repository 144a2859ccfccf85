"""Damaged files of limbs by the thousand, and what may come of reading one.

A mutant of the layout in which labs hand limbs over is one clear error, or a limb whose numbers are
those that HDF5 itself reads from the mutant.
"""

from pathlib import Path

import h5py
import numpy as np

from skinsource.base.errors import SkinSourceError
from skinsource.limbs import limb_import as importing_module
from skinsource.limbs.limb_import import LimbSource, PreparedLimb, prepare_limb
from skinsource.readers.reading_process import ReadingProcess
from tests.core.recordings.mutants import Tally, mutant

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
    """Import ``count`` mutants of a file in the layout; whatever else is raised is raised."""
    rng = np.random.default_rng([random_seed, 0])
    seed, path, tally = whole.read_bytes(), folder / "mutant.h5", Tally()
    for number in range(count):
        path.write_bytes(mutant(seed, rng))
        try:
            prepared, read = read_layout(path, process)
        except SkinSourceError as error:
            _refused(tally, number, error)
            continue
        tally.outcomes["read"] += 1
        with h5py.File(path) as file:
            there = np.asarray(file["responses"][()], np.float64)
            axes = file.attrs["axes"]
        if not np.array_equal(read, there, equal_nan=True):
            tally.wrong.append(f"layout {number}: other responses than HDF5 reads")
        if prepared.limb.axes != str(axes):
            tally.wrong.append(f"layout {number}: along {prepared.limb.axes}")
    return tally


def _refused(tally: Tally, number: int, error: SkinSourceError) -> None:
    message = str(error)
    tally.note_refused(message)
    if (
        "mutant" not in message
        or "\n" in message
        or len(message) >= _LONGEST
        or "Traceback" in message
    ):
        tally.wrong.append(f"{number}: unclear: {message}")
