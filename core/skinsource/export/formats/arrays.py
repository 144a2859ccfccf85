"""Formats of arrays: HDF5 with the predicted response, MAT-files of version 5, and NPZ."""

import io
import json
import math
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

#: A larger response, of more than four minutes, is left out.
_MOST_RESPONSE_BYTES = 512 * 2**20


def write_hdf5(outgoing: Outgoing, path: Path) -> Facts:
    """Write ``drive`` (n_times, n_channels) and ``response`` (outputs, axes, times)."""
    stimulus = outgoing.stimulus
    # In memory: where the disk is full, HDF5 ends the process.
    content = io.BytesIO()
    with files.File(content, "w", track_order=True) as file:
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
    path.write_bytes(content.getbuffer())
    return {"samples": "float64", "response": response}


def _add_response(outgoing: Outgoing, file: Any) -> str:
    """Add the predicted response; return what it is, or why it is left out."""
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
    results = new_graph().evaluate({"limb_data", "response_samples"}, sources(design, View()))
    limb: Limb = results["limb_data"]
    n_bytes = limb.n_outputs * limb.n_axes * int(results["response_samples"]) * 8
    return n_bytes if n_bytes <= _MOST_RESPONSE_BYTES else 0


HDF5 = StimulusFormat(
    name="hdf5",
    title="HDF5",
    suffix=".h5",
    hint="The drive, the predicted response of the skin, and what both are",
    write=write_hdf5,
    bytes_of=lambda n_channels, n_times, _: 8192 + 8 * n_channels * n_times,
    response_bytes=_response_bytes,
    rate_hz=None,
    to_device=False,
)


#: Largest array in this version of MAT-files.
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
    content = io.BytesIO()
    # MATLAB has no null.
    facts = {name: value for name, value in about(outgoing).items() if value is not None}
    facts["channels"] = np.array(facts["channels"], object)
    places = np.array([[float(channel.place or 0) for channel in stimulus.channels]])
    facts["places"] = places
    scipy.io.savemat(
        cast(str, content),  # it takes open files too
        {
            "drive": stimulus.samples.T,
            "sample_rate_hz": stimulus.sample_rate_hz,
            "full_scale": outgoing.full_scale,
            "places": places,
            "about": facts,
        },
        format="5",
        oned_as="row",
    )
    # The date would make two files of one design differ.
    head = f"MATLAB 5.0 MAT-file, written by SkinSource studio {__version__}".encode()
    content.seek(0)
    content.write(head.ljust(_HEAD_BYTES))
    path.write_bytes(content.getbuffer())
    return {"samples": "float64"}


MAT = StimulusFormat(
    name="mat",
    title="MATLAB, version 5",
    suffix=".mat",
    hint="For MATLAB and Octave: drive (n_times, n_channels), rate and places",
    write=write_mat,
    bytes_of=lambda n_channels, n_times, _: 4096 + 8 * n_channels * n_times,
    rate_hz=None,
    to_device=False,
)


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


NPZ = StimulusFormat(
    name="npz",
    title="NumPy archive",
    suffix=".npz",
    hint="For Python: the drive, its rate, its places and what it is",
    write=write_npz,
    bytes_of=lambda n_channels, n_times, _: 2048 + 8 * n_channels * n_times,
    rate_hz=None,
    to_device=False,
)
