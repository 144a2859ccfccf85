"""HDF5: the drive, what the skin answers, and what both are."""

import io
import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

import numpy as np
import scipy

from skinsource.base import files
from skinsource.base.errors import InvalidInputError
from skinsource.base.job import silent, stop_if
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.engine.quantities import new_graph, sources
from skinsource.export.exported_design import ExportedDesign, steadily_written
from skinsource.export.formats.format import Facts, Outgoing, StimulusFormat, about, channel_names
from skinsource.export.tables import NpzArchive
from skinsource.limbs.limb import Limb
from skinsource.version import __version__

#: Of a response that joins the file: four minutes.
_MOST_RESPONSE_BYTES = 512 * 2**20


def write_hdf5(outgoing: Outgoing, path: Path) -> Facts:
    """Write ``drive`` (n_times, n_channels) and ``response`` (outputs, axes, times)."""
    stimulus = outgoing.stimulus
    held = io.BytesIO()
    # In memory: where the disk is full, HDF5 ends the process.
    with files.File(held, "w", track_order=True) as file:
        drive = file.create_dataset("drive", data=stimulus.samples.T, track_times=False)
        drive.attrs["sample_rate_hz"] = stimulus.sample_rate_hz
        drive.attrs["unit"] = stimulus.unit
        drive.attrs["full_scale"] = outgoing.full_scale
        drive.attrs["places"] = [channel.place or 0 for channel in stimulus.channels]
        drive.attrs["channels"] = channel_names(stimulus)
        for name, value in about(outgoing).items():
            if isinstance(value, str | float | int):
                file.attrs[name] = value
        response = _add_response(outgoing, file)
    path.write_bytes(held.getbuffer())
    return {"samples": "float64", "response": response}


def _add_response(outgoing: Outgoing, file: Any) -> str:
    """Add what is predicted; say so, or why not."""
    exported = ExportedDesign(outgoing.design, View(), silent, outgoing.stop)
    shape = exported.limb.n_outputs, exported.limb.n_axes, exported.n_times
    n_bytes = math.prod(shape) * 8
    if n_bytes > _MOST_RESPONSE_BYTES:
        return f"left out: it would take {n_bytes / 1e9:.1f} GB"
    response = file.create_dataset("response", shape, "f8", track_times=False)
    done = 0
    for block in exported.field_blocks():
        stop_if(outgoing.stop)
        response[..., done : done + block.shape[-1]] = block
        done += block.shape[-1]
        outgoing.progress(done, shape[-1], "Writing")
    response.attrs["sample_rate_hz"] = exported.sample_rate_hz
    response.attrs["unit"] = "m/s²"
    response.attrs["axes"] = exported.limb.axes
    response.attrs["pre_trigger_delay_s"] = exported.limb.pre_trigger_delay_s
    response.attrs["first_sample_s"] = float(exported.value("response_time_s")[0])
    response.attrs["synthetic"] = exported.limb.synthetic
    return "whole design from time 0 on, before fades and cuts"


def _response_bytes(design: Design) -> int:
    known = new_graph().evaluate({"limb_data", "response_samples"}, sources(design, View()))
    limb: Limb = known["limb_data"]
    n_bytes = limb.n_outputs * limb.n_axes * int(known["response_samples"]) * 8
    return n_bytes if n_bytes <= _MOST_RESPONSE_BYTES else 0


def _bytes_of(n_channels: int, n_times: int, _: Mapping[str, str]) -> int:
    return 8192 + 8 * n_channels * n_times


HDF5 = StimulusFormat(
    name="hdf5",
    title="HDF5",
    suffix=".h5",
    hint="The drive, the predicted response of the skin, and what both are",
    write=write_hdf5,
    bytes_of=_bytes_of,
    response_bytes=_response_bytes,
    rate_hz=None,
    to_device=False,
)


# MAT-files of version 5: for MATLAB and Octave.

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
    places = np.array([[float(channel.place or 0) for channel in stimulus.channels]])
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


def _matlab_bytes_of(n_channels: int, n_times: int, _: Mapping[str, str]) -> int:
    return 4096 + 8 * n_channels * n_times


MAT = StimulusFormat(
    name="mat",
    title="MATLAB, version 5",
    suffix=".mat",
    hint="For MATLAB and Octave: drive (n_times, n_channels), rate and places",
    write=write_mat,
    bytes_of=_matlab_bytes_of,
    rate_hz=None,
    to_device=False,
)


# NPZ: for NumPy.


def write_npz(outgoing: Outgoing, path: Path) -> Facts:
    """Write ``drive`` (n_times, n_channels), ``sample_rate_hz``, ``places`` and ``about``."""
    stimulus = outgoing.stimulus
    with steadily_written(path) as file, NpzArchive(file) as archive:
        archive.put("drive", np.ascontiguousarray(stimulus.samples.T))
        archive.put("sample_rate_hz", np.array(stimulus.sample_rate_hz))
        archive.put("full_scale", np.array(outgoing.full_scale))
        archive.put("places", np.array([channel.place or 0 for channel in stimulus.channels]))
        archive.put("about", np.array(json.dumps(about(outgoing), ensure_ascii=False)))
    return {"samples": "float64"}


def _numpy_archive_bytes_of(n_channels: int, n_times: int, _: Mapping[str, str]) -> int:
    return 2048 + 8 * n_channels * n_times


NPZ = StimulusFormat(
    name="npz",
    title="NumPy archive",
    suffix=".npz",
    hint="For Python: the drive, its rate, its places and what it is",
    write=write_npz,
    bytes_of=_numpy_archive_bytes_of,
    rate_hz=None,
    to_device=False,
)
