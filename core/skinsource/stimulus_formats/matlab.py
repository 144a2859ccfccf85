"""MAT-files of version 5: for MATLAB and Octave."""

import io
from collections.abc import Mapping
from pathlib import Path
from typing import cast

import numpy as np
import scipy

from skinsource.errors import InvalidInputError
from skinsource.stimulus_formats.about import about
from skinsource.stimulus_formats.stimulus_format import Facts, Outgoing, StimulusFormat
from skinsource.version import __version__

#: Of one array, in this version of the files.
_MOST_BYTES = 2**31 - 2**10
_HEAD_BYTES = 116


def write_mat(outgoing: Outgoing, path: Path) -> Facts:
    """Write ``drive`` (n_times, n_channels), ``sample_rate_hz``, ``places`` and ``about``."""
    stimulus = outgoing.stimulus
    if stimulus.samples.nbytes > _MOST_BYTES:
        raise InvalidInputError(
            f"{stimulus.samples.nbytes / 1e9:.1f} GB do not fit into a MAT-file of version 5, "
            "expected at most 2 GB. Take a part of the time, or the format hdf5."
        )
    held = io.BytesIO()
    # MATLAB has no null.
    words = {name: value for name, value in about(outgoing).items() if value is not None}
    words["channels"] = np.array(words["channels"], object)
    places = np.array([[float(one.place or 0) for one in stimulus.channels]])
    words["places"] = places
    scipy.io.savemat(
        cast(str, held),  # it takes open files too
        {
            "drive": stimulus.samples.T,
            "sample_rate_hz": stimulus.sample_rate_hz,
            "full_scale": outgoing.full_scale,
            "places": places,
            "about": words,
        },
        format="5",
        oned_as="row",
    )
    # The date would make two files of one design differ.
    head = f"MATLAB 5.0 MAT-file, written by SkinSource studio {__version__}".encode()
    held.seek(0)
    held.write(head.ljust(_HEAD_BYTES))
    path.write_bytes(held.getbuffer())
    return {"samples": "float64"}


def _bytes_of(n_channels: int, n_times: int, _: Mapping[str, str]) -> int:
    return 4096 + 8 * n_channels * n_times


MAT = StimulusFormat(
    name="mat",
    title="MATLAB, version 5",
    suffix=".mat",
    hint="For MATLAB and Octave: drive (n_times, n_channels), rate and places",
    write=write_mat,
    bytes_of=_bytes_of,
    rate_hz=None,
    to_device=False,
)
