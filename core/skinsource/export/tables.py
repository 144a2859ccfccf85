"""Traces, levels and windows as CSV, and the whole field as an archive of arrays.

A table has comment lines, one header line, then numbers that read back exactly.  The archive is
written piece by piece: the field of a long design does not fit into memory.
"""

import math
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import zip_longest
from pathlib import Path
from typing import IO, BinaryIO
from zipfile import ZIP_STORED, ZipFile, ZipInfo

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from skinsource.base.arrays import Floats
from skinsource.base.decibels import levels_for_tables
from skinsource.base.errors import StorageError
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.base.measurement_conditions import ALL_AXES
from skinsource.base.work import counted
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.export.exported_design import (
    PIECE_SAMPLES,
    ExportedDesign,
    about_axes,
    about_design,
    about_error,
    about_levels,
    about_method,
    check_accuracy,
    checked_error_line,
    listed,
    output_file,
)
from skinsource.limbs.extent import Extent
from skinsource.limbs.locations import output_name
from skinsource.perception.validity import number_ranges as judging_listed

# Writing so many cells takes a few milliseconds.
_CELLS_PER_PIECE = 8192


class CsvTable:
    """Writes a table, some rows at a time.

    Parameters
    ----------
    file
        The file to write to; it stays open.
    about
        Comment lines.
    header
        Names of the columns.
    stop
        Asked now and then; once true, `Stopped` is raised.
    """

    def __init__(
        self, file: BinaryIO, about: Sequence[str], header: Sequence[str], stop: Stop
    ) -> None:
        self._file, self._stop = file, stop
        self._write([*(f"# {line}" for line in about), ",".join(header)])

    def add(self, rows: Floats, texts: Sequence[Sequence[str]] = ()) -> None:
        """Write ``rows``, (n_rows, n_columns), each followed by its ``texts``, if there are any."""
        step = max(_CELLS_PER_PIECE // max(rows.shape[1], 1), 1)
        for first in range(0, len(rows), step):
            stop_if(self._stop)
            piece = rows[first : first + step].tolist()
            quoted = [list(map(_quoted, row)) for row in texts[first : first + step]]
            self._write(
                [
                    ",".join([*map(_exact, row), *more])
                    for row, more in zip_longest(piece, quoted, fillvalue=())
                ]
            )

    def _write(self, lines: list[str]) -> None:
        self._file.write(("\n".join(lines) + "\n").encode())


def _quoted(text: str) -> str:
    return '"' + text.replace('"', '""') + '"'


def _exact(value: float) -> str:
    # The shortest digits that read back as the same number.
    return str(int(value)) if value.is_integer() and abs(value) < 2**53 else repr(value)


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
        The design, and axes, method and outputs of the traces.
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
    check_accuracy(error, largest_error)
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
    results = exported.values({"output_rms", "output_levels_db"})
    error_line = checked_error_line(exported, results["output_rms"], largest_error)
    about = [
        *about_design(exported),
        about_axes(exported),
        about_levels(exported),
        *about_method(exported),
        error_line,
    ]
    header = ["output", "rms_m_per_s2", "level_db_re_1_m_per_s2", "side", "place"]
    with output_file(path, stop) as file:
        table = CsvTable(file, about, header, stop)
        levels_db = levels_for_tables(results["output_levels_db"])
        table.add(
            np.vstack((exported.all_outputs, results["output_rms"], levels_db)).T,
            [_side_and_place(output, exported.design.limb) for output in exported.all_outputs],
        )
        progress(1, 1, "Writing")


def _side_and_place(output: int, limb: str) -> tuple[str, str]:
    """Return side and place of an output; no side where a limb has outputs of its own."""
    name = output_name(output, limb)
    return {"volar": "palm", "dorsal": "back"}.get(name.kind, ""), name.name


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


#: Fields of `Extent`, in the order of their columns in tables.
EXTENT_COLUMNS = (
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
    results = exported.values(
        {"windows", "rms_of_windows", "extents_of_windows", "windows_in_noise"}
    )
    windows, rms = results["windows"], results["rms_of_windows"]
    error_line = checked_error_line(exported, rms.max(axis=0, initial=0.0), largest_error)
    about = [
        *about_design(exported),
        about_axes(exported),
        f"windows: {windows.window_samples} samples each, the first from sample "
        f"{windows.first_sample} of the response on",
        "extent: over the outputs with a place on the map, from the nearest input that is heard",
        *_about_noise(results["windows_in_noise"]),
        *about_method(exported),
        error_line,
    ]
    header = ["from_s", "to_s", *EXTENT_COLUMNS]
    header += [f"output_{number}_rms_m_per_s2" for number in exported.all_outputs]
    bounds = windows.bounds_s(exported.sample_rate_hz)
    rows = [
        [*span, *extent_values(extent), *values]
        for span, extent, values in zip(
            bounds, results["extents_of_windows"], rms.tolist(), strict=True
        )
    ]
    with output_file(path, stop) as file:
        table = CsvTable(file, about, header, stop)
        table.add(np.array(rows).reshape(-1, len(header)))
        progress(1, 1, "Writing")


def _about_noise(in_noise: Sequence[bool]) -> list[str]:
    noisy = [number for number, is_noisy in enumerate(in_noise, start=1) if is_noisy]
    if not noisy:
        return []
    windows = f"{'window' if len(noisy) == 1 else 'windows'} {judging_listed(noisy)}"
    return [f"validity, windows: CAUTION: {windows}: mostly noise, and so is the extent"]


def extent_values(extent: Extent | None) -> list[float]:
    """Return the values of an extent by `EXTENT_COLUMNS`; NaN where nothing moves."""
    if extent is None:
        return [math.nan] * len(EXTENT_COLUMNS)
    return [getattr(extent, name) for name in EXTENT_COLUMNS]


# A fixed date: the same content gives the same bytes, whenever it is written.
_NO_DATE = (1980, 1, 1, 0, 0, 0)


class GrowingArray:
    """A float64 array that grows along time, its last axis.

    It is stored column by column ("Fortran order"): samples of one time follow each other in the
    file, so that it can be written time by time, and is read as (..., n_times).
    """

    def __init__(self, member: IO[bytes], shape: tuple[int, ...]) -> None:
        self._member, self._shape = member, shape
        self.n_times = 0
        npy.write_array_header_2_0(member, {"descr": "<f8", "fortran_order": True, "shape": shape})

    def add(self, block: Floats) -> None:
        """Write the samples that follow, (..., n)."""
        self._member.write(np.ascontiguousarray(block.T, dtype="<f8").data)
        self.n_times += block.shape[-1]

    def finish(self) -> None:
        """Raise `ValueError` unless all times were written."""
        if self.n_times != self._shape[-1]:
            raise ValueError(f"{self.n_times} times were written, expected {self._shape[-1]}")


class NpzArchive:
    """An archive that ``numpy.load`` reads, written without compression and date.

    Parameters
    ----------
    file
        The file to write to; it stays open.
    """

    def __init__(self, file: BinaryIO) -> None:
        self._zip = ZipFile(file, "w", ZIP_STORED, allowZip64=True)

    def __enter__(self) -> "NpzArchive":
        return self

    def __exit__(self, *_: object) -> None:
        self._zip.close()

    def put(self, name: str, array: NDArray[np.generic]) -> None:
        """Write a whole array."""
        with self._member(name) as member:
            npy.write_array(member, array, version=(2, 0), allow_pickle=False)

    @contextmanager
    def growing(self, name: str, shape: tuple[int, ...]) -> Iterator[GrowingArray]:
        """Give an array of ``shape`` to write time by time."""
        with self._member(name) as member:
            array = GrowingArray(member, shape)
            yield array
            array.finish()

    def _member(self, name: str) -> IO[bytes]:
        return self._zip.open(ZipInfo(f"{name}.npy", _NO_DATE), "w", force_zip64=True)


# Headers, the text and the table of contents take less.
_HEADER_BYTES = 2**20


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
    # The written samples themselves are checked, of a long field those of some outputs.
    selected = view.outputs if exported.streamed is not None else ()
    checked = exported.holdable(selected or exported.all_outputs, ALL_AXES)
    rows = [output - 1 for output in checked]
    written = np.empty((len(checked), *shape[1:]))
    with output_file(path, stop) as file:
        _check_free_space(path, math.prod(shape) * np.dtype(np.float64).itemsize)
        with NpzArchive(file) as archive:
            archive.put("sample_rate_hz", np.array(exported.sample_rate_hz))
            with archive.growing("acceleration_m_per_s2", shape) as array:
                for block in exported.field_blocks():
                    stop_if(stop)
                    written[..., array.n_times : array.n_times + block.shape[-1]] = block[rows]
                    array.add(block)
            error = exported.error_of(written, checked)
            check_accuracy(error, largest_error)
            what = (
                "the field"
                if checked == exported.all_outputs
                else f"the field at {listed(checked)}"
            )
            about = [*_about_field(exported), about_error(error, what)]
            archive.put("about", np.array("\n".join(about)))


def _about_field(exported: ExportedDesign) -> list[str]:
    return [
        *about_design(exported),
        f"acceleration_m_per_s2: {counted(exported.limb.n_outputs, 'output')}, "
        f"{counted(exported.limb.n_axes, 'axis', 'axes')} ({', '.join(exported.limb.axes)}), "
        f"{counted(exported.n_times, 'time')}, in m/s²",
        f"times: sample k at {_first_sample_text(exported)}k / {exported.sample_rate_hz:g} s; "
        f"pre-trigger delay of {exported.limb.pre_trigger_delay_s * 1e3:g} ms: contained in the "
        "times",
        about_levels(exported),
        *about_method(exported),
    ]


def _first_sample_text(exported: ExportedDesign) -> str:
    """Return the time before sample k: responses through actuators may begin before time 0."""
    first_s = float(exported.value("response_time_s")[0]) if exported.design.actuated else 0.0
    return f"{first_s:.9g} s + " if first_s else ""


def _check_free_space(path: Path, n_bytes: int) -> None:
    free_bytes = shutil.disk_usage(path.resolve().parent).free
    if free_bytes < n_bytes + _HEADER_BYTES:
        raise StorageError(
            f"{path}: the whole field takes {n_bytes / 1e9:.2f} GB, and {free_bytes / 1e9:.2f} GB "
            "are free there. Free some space, choose another disk, or shorten the design."
        )
