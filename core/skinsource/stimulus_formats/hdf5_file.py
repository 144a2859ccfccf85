"""HDF5: the drive, what the skin answers, and what both are."""

import io
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from skinsource.design import Design
from skinsource.export.exported_design import ExportedDesign
from skinsource.files import hdf5
from skinsource.job import silent, stop_if
from skinsource.limb import Limb
from skinsource.quantities import new_graph, sources
from skinsource.stimulus_formats.about import about
from skinsource.stimulus_formats.column_names import channel_names
from skinsource.stimulus_formats.stimulus_format import Facts, Outgoing, StimulusFormat
from skinsource.view import View

#: Of a response that joins the file: four minutes.
_MOST_RESPONSE_BYTES = 512 * 2**20


def write_hdf5(outgoing: Outgoing, path: Path) -> Facts:
    """Write ``drive`` (n_times, n_channels) and ``response`` (outputs, axes, times)."""
    stimulus = outgoing.stimulus
    held = io.BytesIO()
    # In memory: where the disk is full, HDF5 ends the process.
    with hdf5.File(held, "w", track_order=True) as file:
        drive = file.create_dataset("drive", data=stimulus.samples.T, track_times=False)
        drive.attrs["sample_rate_hz"] = stimulus.sample_rate_hz
        drive.attrs["unit"] = stimulus.unit
        drive.attrs["full_scale"] = outgoing.full_scale
        drive.attrs["places"] = [one.place or 0 for one in stimulus.channels]
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
    found = file.create_dataset("response", shape, "f8", track_times=False)
    done = 0
    for block in exported.field_blocks():
        stop_if(outgoing.stop)
        found[..., done : done + block.shape[-1]] = block
        done += block.shape[-1]
        outgoing.progress(done, shape[-1], "Writing")
    found.attrs["sample_rate_hz"] = exported.sample_rate_hz
    found.attrs["unit"] = "m/s²"
    found.attrs["axes"] = exported.limb.axes
    found.attrs["pre_trigger_delay_s"] = exported.limb.pre_trigger_delay_s
    found.attrs["first_sample_s"] = float(exported.value("response_time_s")[0])
    found.attrs["synthetic"] = exported.limb.synthetic
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
