"""Traces and levels as CSV."""

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from skinsource.arrays import Floats
from skinsource.decibels import in_tables
from skinsource.design import Design
from skinsource.export.csv_table import CsvTable
from skinsource.export.exported_design import PIECE_SAMPLES, ExportedDesign
from skinsource.export.figures import (
    about_axes,
    about_design,
    about_error,
    about_levels,
    about_method,
    listed,
    refuse_if_worse,
)
from skinsource.export.output_file import output_file
from skinsource.job import Progress, Stop, never, silent
from skinsource.locations import output_words
from skinsource.view import View


def export_traces(
    path: Path,
    design: Design,
    view: View,
    *,
    progress: Progress = silent,
    stop: Stop = never,
    largest_error: float = math.inf,
) -> None:
    """Compute and write the traces of the selected outputs: times in s, then m/s².

    Parameters
    ----------
    path
        The table.
    design, view
        What is shown.
    progress
        Called with (done, total, what is being done); a total of 0 while that is not known.
    stop
        Asked now and then; once true, nothing is written.
    largest_error
        Estimated error, relative to the largest sample, above which nothing is written.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    TooInaccurateError
        The error is larger than ``largest_error``.
    Stopped
        ``stop`` said so.
    """
    exported = ExportedDesign(design, view, progress, stop)
    checked = exported.holdable(view.outputs, view.axes)
    error = exported.error(checked, view.axes)
    refuse_if_worse(error, largest_error)
    shift = "removed from" if view.delay_removed else "contained in"
    what = "the traces" if checked == view.outputs else f"the traces of {listed(checked)}"
    about = [
        *about_design(exported),
        about_axes(exported),
        f"pre-trigger delay of {exported.limb.pre_trigger_delay_s * 1e3:g} ms: {shift} the times",
        about_levels(exported),
        *about_method(exported),
        about_error(error, what),
    ]
    header = ["time_s", *(f"output_{output}_m_per_s2" for output in view.outputs)]
    time_s = exported.value("response_time_s")
    with output_file(path, stop) as file:
        table = CsvTable(file, about, header, stop)
        done = 0
        for block in _trace_blocks(exported):
            end = done + block.shape[-1]
            table.add(np.vstack((time_s[done:end], block)).T)
            done = end
            progress(done, exported.n_times, "Writing")


def export_levels(
    path: Path,
    design: Design,
    view: View,
    *,
    progress: Progress = silent,
    stop: Stop = never,
    largest_error: float = math.inf,
) -> None:
    """Compute and write the RMS of each output, in m/s² and in dB re 1 m/s², side and place.

    An output that is silent has an RMS of 0 and no level: ``nan``.  Parameters and errors are those
    of `export_traces`.
    """
    exported = ExportedDesign(design, view, progress, stop)
    wanted = exported.values({"output_rms", "output_levels_db"})
    loudest = int(np.argmax(wanted["output_rms"])) + 1
    error = exported.error((loudest,), view.axes)
    refuse_if_worse(error, largest_error)
    about = [
        *about_design(exported),
        about_axes(exported),
        about_levels(exported),
        *about_method(exported),
        about_error(error, f"the traces of output {loudest}, the loudest"),
    ]
    header = ["output", "rms_m_per_s2", "level_db_re_1_m_per_s2", "side", "place"]
    with output_file(path, stop) as file:
        table = CsvTable(file, about, header, stop)
        levels_db = in_tables(wanted["output_levels_db"])
        table.add(
            np.vstack((exported.all_outputs, wanted["output_rms"], levels_db)).T,
            [_side_and_place(output, exported.design.limb) for output in exported.all_outputs],
        )
        progress(1, 1, "Writing")


def _side_and_place(output: int, limb: str) -> tuple[str, str]:
    """Side and place of an output; no side where a limb has outputs of its own."""
    words = output_words(output, limb)
    return {"volar": "palm", "dorsal": "back"}.get(words.kind, ""), words.name


def _trace_blocks(exported: ExportedDesign) -> Iterator[Floats]:
    """Yield the projected traces piece by piece, (n_selected, n)."""
    outputs = exported.view.outputs
    if outputs == exported.holdable(outputs, exported.view.axes):
        traces = exported.value("selected_traces")
        for first in range(0, exported.n_times, PIECE_SAMPLES):
            yield traces[:, first : first + PIECE_SAMPLES]
        return
    projection = exported.value("selected_projection")
    chosen = np.ix_([output - 1 for output in outputs], projection.axis_numbers)
    for block in exported.field_blocks():
        yield projection.signals(block[chosen])
