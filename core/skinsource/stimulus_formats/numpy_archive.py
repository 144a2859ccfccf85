"""NPZ: for NumPy."""

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from skinsource.export.npz_archive import NpzArchive
from skinsource.export.output_file import steadily_written
from skinsource.stimulus_formats.about import about
from skinsource.stimulus_formats.stimulus_format import Facts, Outgoing, StimulusFormat


def write_npz(outgoing: Outgoing, path: Path) -> Facts:
    """Write ``drive`` (n_times, n_channels), ``sample_rate_hz``, ``places`` and ``about``."""
    stimulus = outgoing.stimulus
    with steadily_written(path) as file, NpzArchive(file) as archive:
        archive.put("drive", np.ascontiguousarray(stimulus.samples.T))
        archive.put("sample_rate_hz", np.array(stimulus.sample_rate_hz))
        archive.put("full_scale", np.array(outgoing.full_scale))
        archive.put("places", np.array([one.place or 0 for one in stimulus.channels]))
        archive.put("about", np.array(json.dumps(about(outgoing), ensure_ascii=False)))
    return {"samples": "float64"}


def _bytes_of(n_channels: int, n_times: int, _: Mapping[str, str]) -> int:
    return 2048 + 8 * n_channels * n_times


NPZ = StimulusFormat(
    name="npz",
    title="NumPy archive",
    suffix=".npz",
    hint="For Python: the drive, its rate, its places and what it is",
    write=write_npz,
    bytes_of=_bytes_of,
    rate_hz=None,
    to_device=False,
)
