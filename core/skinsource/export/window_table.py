"""RMS in consecutive windows as CSV."""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from skinsource.analysis import Extent
from skinsource.design import Design
from skinsource.export.csv_table import CsvTable
from skinsource.export.exported_design import ExportedDesign
from skinsource.export.figures import (
    about_axes,
    about_design,
    about_error,
    about_method,
    refuse_if_worse,
)
from skinsource.export.output_file import output_file
from skinsource.job import Progress, Stop, never, silent
from skinsource.validity.judging import listed
from skinsource.view import View

_MEASURES = (
    "mean_distance_mm",
    "d90_mm",
    "share_above_12_db",
    "share_above_20_db",
    "participation",
)


def export_windows(
    path: Path,
    design: Design,
    view: View,
    *,
    progress: Progress = silent,
    stop: Stop = never,
    largest_error: float = math.inf,
) -> None:
    """Compute and write a row for each window: its times, its extent, the RMS of all outputs.

    Times are those of the stimulus, from its begin on; a window begins as much later in the
    response as the pre-trigger delay is long.  The extent of silence is ``nan``.  Parameters and
    errors are those of `export_traces`.
    """
    exported = ExportedDesign(design, view, progress, stop)
    wanted = exported.values(
        {"windows", "rms_of_windows", "extents_of_windows", "windows_in_noise"}
    )
    rms, extents = wanted["rms_of_windows"], wanted["extents_of_windows"]
    loudest = int(np.argmax(rms.max(axis=0, initial=0.0))) + 1
    error = exported.error((loudest,), view.axes)
    refuse_if_worse(error, largest_error)
    windows = wanted["windows"]
    about = [
        *about_design(exported),
        about_axes(exported),
        f"windows: {windows.window_samples} samples each, the first from sample "
        f"{windows.first_sample} of the response on",
        "extent: over the outputs with a place on the map, from the nearest input that is heard",
        *_about_noise(wanted["windows_in_noise"]),
        *about_method(exported),
        about_error(error, f"the traces of output {loudest}, the loudest"),
    ]
    header = ["from_s", "to_s", *_MEASURES]
    header += [f"output_{number}_rms_m_per_s2" for number in exported.all_outputs]
    bounds = windows.bounds_s(exported.sample_rate_hz)
    rows = [
        [*span, *_measures(one), *values]
        for span, one, values in zip(bounds, extents, rms.tolist(), strict=True)
    ]
    with output_file(path, stop) as file:
        table = CsvTable(file, about, header, stop)
        table.add(np.array(rows).reshape(-1, len(header)))
        progress(1, 1, "Writing")


def _about_noise(in_noise: Sequence[bool]) -> list[str]:
    noisy = [number for number, one in enumerate(in_noise, start=1) if one]
    if not noisy:
        return []
    words = f"{'window' if len(noisy) == 1 else 'windows'} {listed(noisy)}"
    return [f"validity, windows: CAUTION: {words}: mostly noise, and so is the extent"]


def _measures(extent: Extent | None) -> list[float]:
    if extent is None:
        return [math.nan] * len(_MEASURES)
    return [getattr(extent, name) for name in _MEASURES]
