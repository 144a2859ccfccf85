"""The whole predicted field, all outputs and axes, as an archive of arrays."""

import math
import shutil
from pathlib import Path

import numpy as np

from skinsource.counting import counted
from skinsource.design import Design
from skinsource.errors import StorageError
from skinsource.export.exported_design import ExportedDesign
from skinsource.export.figures import (
    about_design,
    about_error,
    about_levels,
    about_method,
    listed,
    refuse_if_worse,
)
from skinsource.export.npz_archive import NpzArchive
from skinsource.export.output_file import output_file
from skinsource.job import Progress, Stop, never, silent, stop_if
from skinsource.limb import ALL_AXES
from skinsource.view import View

# Headers, the text and the table of contents take less.
_BYTES_BESIDE_FIELD = 2**20


def export_field(
    path: Path,
    design: Design,
    view: View,
    *,
    progress: Progress = silent,
    stop: Stop = never,
    largest_error: float = math.inf,
) -> None:
    """Compute and write the acceleration of all outputs on all axes, block by block.

    ``numpy.load`` reads the file.  It holds ``acceleration_m_per_s2`` (n_outputs, n_axes, n_times;
    float64, time 0 first, the pre-trigger delay contained), ``sample_rate_hz``, and ``about``, a
    text.  Silence is exactly 0.

    Parameters and further errors are those of `export_traces`.

    Raises
    ------
    StorageError
        The disk has too little room, or what `export_traces` says.
    """
    exported = ExportedDesign(design, view, progress, stop)
    shape = exported.limb.n_outputs, exported.limb.n_axes, exported.n_times
    # What is checked is what was written, at some outputs.
    looked_at = view.outputs if exported.streamed is not None else ()
    checked = exported.holdable(looked_at or exported.all_outputs, ALL_AXES)
    rows = [output - 1 for output in checked]
    kept = np.empty((len(checked), *shape[1:]))
    with output_file(path, stop) as file:
        _refuse_without_room(path, math.prod(shape) * np.dtype(np.float64).itemsize)
        with NpzArchive(file) as archive:
            archive.put("sample_rate_hz", np.array(exported.sample_rate_hz))
            with archive.growing("acceleration_m_per_s2", shape) as array:
                for block in exported.field_blocks():
                    stop_if(stop)
                    kept[..., array.n_times : array.n_times + block.shape[-1]] = block[rows]
                    array.add(block)
            error = exported.error_of(kept, checked)
            refuse_if_worse(error, largest_error)
            what = (
                "the field"
                if checked == exported.all_outputs
                else f"the field at {listed(checked)}"
            )
            about = [*_about(exported), about_error(error, what)]
            archive.put("about", np.array("\n".join(about)))


def _about(exported: ExportedDesign) -> list[str]:
    return [
        *about_design(exported),
        f"acceleration_m_per_s2: {counted(exported.limb.n_outputs, 'output')}, "
        f"{counted(exported.limb.n_axes, 'axis', 'axes')} ({', '.join(exported.limb.axes)}), "
        f"{counted(exported.n_times, 'time')}, in m/s²",
        f"times: sample k at {_first(exported)}k / {exported.sample_rate_hz:g} s; pre-trigger "
        f"delay of {exported.limb.pre_trigger_delay_s * 1e3:g} ms: contained in the times",
        about_levels(exported),
        *about_method(exported),
    ]


def _first(exported: ExportedDesign) -> str:
    """What stands before k: responses through actuators may begin before time 0."""
    first_s = float(exported.value("response_time_s")[0]) if exported.design.actuated else 0.0
    return f"{first_s:.9g} s + " if first_s else ""


def _refuse_without_room(path: Path, n_bytes: int) -> None:
    free_bytes = shutil.disk_usage(path.resolve().parent).free
    if free_bytes < n_bytes + _BYTES_BESIDE_FIELD:
        raise StorageError(
            f"{path}: the whole field takes {n_bytes / 1e9:.2f} GB, and {free_bytes / 1e9:.2f} GB "
            "are free there. Free some space, choose another disk, or shorten the design."
        )
