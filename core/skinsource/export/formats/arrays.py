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
from skinsource.design.design import Design, View
from skinsource.engine.quantities import new_graph, sources
from skinsource.export.exported_design import ExportedDesign
from skinsource.export.formats.format import Choices, Facts, StimulusFile, StimulusFormat
from skinsource.export.tables import NpzArchive
from skinsource.limbs.limb import Limb
from skinsource.version import __version__

#: A larger response, of more than four minutes, is left out.
_MOST_RESPONSE_BYTES = 512 * 2**20


class _Arrays(StimulusFormat):
    """The samples as 64-bit floating point, and some bytes that say what they are."""

    rate_hz = None
    to_device = False
    about_bytes: int

    def n_bytes(self, n_channels: int, n_times: int, choices: Choices) -> int:
        """Return about how many bytes it takes."""
        return self.about_bytes + 8 * n_channels * n_times


class Hdf5(_Arrays):
    """``drive`` (n_times, n_channels) and ``response`` (outputs, axes, times)."""

    name = "hdf5"
    title = "HDF5"
    suffix = ".h5"
    hint = "The drive, the predicted response of the skin, and what both are"
    about_bytes = 8192

    def write(self, file: StimulusFile, path: Path) -> Facts:
        """Write the file."""
        stimulus = file.stimulus
        # In memory: where the disk is full, HDF5 ends the process.
        content = io.BytesIO()
        with files.File(content, "w", track_order=True) as output:
            drive = output.create_dataset("drive", data=stimulus.samples.T, track_times=False)
            drive.attrs["sample_rate_hz"] = stimulus.sample_rate_hz
            drive.attrs["unit"] = stimulus.unit
            drive.attrs["full_scale"] = file.full_scale
            drive.attrs["places"] = [channel.place or 0 for channel in stimulus.channels]
            drive.attrs["channels"] = file.channel_names
            for name, value in file.about.items():
                if isinstance(value, str | float | int):
                    output.attrs[name] = value
            response = _add_response(file, output)
        path.write_bytes(content.getbuffer())
        return {"samples": "float64", "response": response}

    def response_bytes(self, design: Design) -> int:
        """Return how many bytes the predicted response takes."""
        results = new_graph().evaluate({"limb_data", "response_samples"}, sources(design, View()))
        limb: Limb = results["limb_data"]
        n_bytes = limb.n_outputs * limb.n_axes * int(results["response_samples"]) * 8
        return n_bytes if n_bytes <= _MOST_RESPONSE_BYTES else 0


def _add_response(file: StimulusFile, output: Any) -> str:
    """Add the predicted response; return what it is, or why it is left out."""
    exported = ExportedDesign(file.design, View(), silent, file.stop)
    shape = exported.limb.n_outputs, exported.limb.n_axes, exported.n_times
    n_bytes = math.prod(shape) * 8
    if n_bytes > _MOST_RESPONSE_BYTES:
        return f"left out: it would take {n_bytes / 1e9:.1f} GB"
    response = output.create_dataset("response", shape, "f8", track_times=False)
    done = 0
    for block in exported.field_blocks():
        stop_if(file.stop)
        response[..., done : done + block.shape[-1]] = block
        done += block.shape[-1]
        file.progress(done, shape[-1], "Writing")
    response.attrs["sample_rate_hz"] = exported.sample_rate_hz
    response.attrs["unit"] = "m/s²"
    response.attrs["axes"] = exported.limb.axes
    response.attrs["pre_trigger_delay_s"] = exported.limb.pre_trigger_delay_s
    response.attrs["first_sample_s"] = float(exported.value("response_time_s")[0])
    response.attrs["synthetic"] = exported.limb.synthetic
    return "whole design from time 0 on, before fades and cuts"


#: Largest array in this version of MAT-files.
_MOST_BYTES = 2**31 - 2**10
_HEAD_BYTES = 116


class Mat(_Arrays):
    """``drive`` (n_times, n_channels), ``sample_rate_hz``, ``places`` and ``about``."""

    name = "mat"
    title = "MATLAB, version 5"
    suffix = ".mat"
    hint = "For MATLAB and Octave: drive (n_times, n_channels), rate and places"
    about_bytes = 4096

    def write(self, file: StimulusFile, path: Path) -> Facts:
        """Write the file."""
        stimulus = file.stimulus
        if stimulus.samples.nbytes > _MOST_BYTES:
            raise InvalidInputError(
                f"{stimulus.samples.nbytes / 1e9:.1f} GB do not fit into a MAT-file of version 5, "
                "expected at most 2 GB. Take a part of the time, or the format hdf5."
            )
        content = io.BytesIO()
        # MATLAB has no null.
        facts = {name: value for name, value in file.about.items() if value is not None}
        facts["channels"] = np.array(facts["channels"], object)
        places = np.array([[float(channel.place or 0) for channel in stimulus.channels]])
        facts["places"] = places
        drive = {
            "drive": stimulus.samples.T,
            "sample_rate_hz": stimulus.sample_rate_hz,
            "full_scale": file.full_scale,
            "places": places,
            "about": facts,
        }
        # It takes open files too.
        scipy.io.savemat(cast(str, content), drive, format="5", oned_as="row")
        # The date would make two files of one design differ.
        head = f"MATLAB 5.0 MAT-file, written by SkinSource studio {__version__}".encode()
        content.seek(0)
        content.write(head.ljust(_HEAD_BYTES))
        path.write_bytes(content.getbuffer())
        return {"samples": "float64"}


class Npz(_Arrays):
    """``drive`` (n_times, n_channels), ``sample_rate_hz``, ``places`` and ``about``."""

    name = "npz"
    title = "NumPy archive"
    suffix = ".npz"
    hint = "For Python: the drive, its rate, its places and what it is"
    about_bytes = 2048

    def write(self, file: StimulusFile, path: Path) -> Facts:
        """Write the file."""
        stimulus = file.stimulus
        with path.open("w+b") as output, NpzArchive(output) as archive:
            archive.put("drive", np.ascontiguousarray(stimulus.samples.T))
            archive.put("sample_rate_hz", np.array(stimulus.sample_rate_hz))
            archive.put("full_scale", np.array(file.full_scale))
            archive.put("places", np.array([channel.place or 0 for channel in stimulus.channels]))
            archive.put("about", np.array(json.dumps(file.about, ensure_ascii=False)))
        return {"samples": "float64"}
