"""Traces, levels, windows and the map as CSV, the map as PNG, the whole field as an archive.

A table has comment lines, one header line, then numbers that read back exactly.  The archive is
written piece by piece: the field of a long design does not fit into memory.
"""

import math
import struct
import zlib
from collections.abc import Iterable, Iterator, Sequence
from itertools import zip_longest
from pathlib import Path
from typing import IO, Any, BinaryIO
from zipfile import ZIP_STORED, ZipFile, ZipInfo

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from skinsource.base.conventions import ALL_AXES, Floats
from skinsource.base.decibels import levels_for_tables
from skinsource.base.errors import counted
from skinsource.base.files import check_free_space
from skinsource.base.job import Stop, stop_if
from skinsource.export.exported_design import (
    PIECE_SAMPLES,
    Export,
    ExportedDesign,
    about,
    about_axes,
    about_levels,
    output_file,
)
from skinsource.limbs.extent import Extent
from skinsource.limbs.locations import output_name
from skinsource.perception.validity import number_ranges as judging_listed
from skinsource.signals.map_range import MAP_RANGE_DB

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
                    ",".join([*map(exact_text, row), *more])
                    for row, more in zip_longest(piece, quoted, fillvalue=())
                ]
            )

    def _write(self, lines: list[str]) -> None:
        self._file.write(("\n".join(lines) + "\n").encode())


def _quoted(text: str) -> str:
    return '"' + text.replace('"', '""') + '"'


def exact_text(value: float) -> str:
    """Return the shortest digits that read back as the same number."""
    return str(int(value)) if value.is_integer() and abs(value) < 2**53 else repr(value)


def write_traces(path: Path, exported: ExportedDesign) -> None:
    """Write the traces of the selected outputs: times in s, then m/s²."""
    view = exported.view
    checked = exported.holdable(view.outputs, view.axes)
    shift = "removed from" if view.delay_removed else "contained in"
    what = "the traces" if checked == view.outputs else f"the traces of {_listed(checked)}"
    error_line = exported.error_line(what, checked)
    lines = [
        *about(
            exported,
            about_axes(exported),
            f"pre-trigger delay of {exported.limb.pre_trigger_delay_s * 1e3:g} ms: {shift} the "
            "times",
            about_levels(exported),
        ),
        error_line,
    ]
    header = ["time_s", *(f"output_{output}_m_per_s2" for output in view.outputs)]
    time_s = exported.value("response_time_s")
    with output_file(path, exported.stop) as file:
        table = CsvTable(file, lines, header, exported.stop)
        done = 0
        for block in _trace_blocks(exported):
            end = done + block.shape[-1]
            table.add(np.vstack((time_s[done:end], block)).T)
            done = end
            exported.progress(done, exported.n_times, "Writing")


def write_levels(path: Path, exported: ExportedDesign) -> None:
    """Write the RMS of each output, in m/s² and in dB re 1 m/s², side and place.

    An output that is silent has an RMS of 0 and no level: ``nan``.
    """
    results = exported.values({"output_rms", "output_levels_db"})
    error_line = exported.loudest_error_line(results["output_rms"])
    levels = about_levels(exported)
    lines = [*about(exported, about_axes(exported), levels), error_line]
    header = ["output", "rms_m_per_s2", "level_db_re_1_m_per_s2", "side", "place"]
    levels_db = levels_for_tables(results["output_levels_db"])
    rows = np.vstack((exported.all_outputs, results["output_rms"], levels_db)).T
    texts = [_side_and_place(output, exported.design.limb) for output in exported.all_outputs]
    write_table(path, exported, lines, header, rows, texts)


def write_table(
    path: Path,
    exported: ExportedDesign,
    about: Sequence[str],
    header: Sequence[str],
    rows: Floats,
    texts: Sequence[Sequence[str]] = (),
) -> None:
    """Write a whole table, see `CsvTable`."""
    with output_file(path, exported.stop) as file:
        CsvTable(file, about, header, exported.stop).add(rows, texts)
        exported.progress(1, 1, "Writing")


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


def write_windows(path: Path, exported: ExportedDesign) -> None:
    """Write a row for each window: its times, its extent, the RMS of all outputs.

    Times are those of the stimulus, from its begin on; a window begins as much later in the
    response as the pre-trigger delay is long.  The extent of silence is ``nan``.
    """
    results = exported.values(
        {"windows", "rms_of_windows", "extents_of_windows", "windows_in_noise"}
    )
    windows, rms = results["windows"], results["rms_of_windows"]
    error_line = exported.loudest_error_line(rms.max(axis=0, initial=0.0))
    lines = about(
        exported,
        about_axes(exported),
        f"windows: {windows.window_samples} samples each, the first from sample "
        f"{windows.first_sample} of the response on",
        "extent: over the outputs with a place on the map, from the nearest input that is heard",
        *_about_noise(results["windows_in_noise"]),
    )
    bounds_s = windows.bounds_s(exported.sample_rate_hz)
    header, rows = windows_table(bounds_s, results["extents_of_windows"], rms)
    write_table(path, exported, [*lines, error_line], header, rows)


def windows_table(
    bounds_s: Iterable[tuple[float, float]], extents: Iterable[Extent | None], rms: Floats
) -> tuple[list[str], Floats]:
    """Return names of columns and a row for each window: its times, its extent, all RMS.

    Parameters
    ----------
    bounds_s, extents
        Begin and end of each window; how far it reaches, None where nothing moves.
    rms : (n_windows, n_outputs)
        In m/s².
    """
    outputs = [f"output_{number}_rms_m_per_s2" for number in range(1, rms.shape[1] + 1)]
    header = ["from_s", "to_s", *EXTENT_COLUMNS, *outputs]
    rows = [
        [*span, *extent_values(extent), *values]
        for span, extent, values in zip(bounds_s, extents, rms.tolist(), strict=True)
    ]
    return header, np.array(rows).reshape(-1, len(header))


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

    def put_blocks(self, name: str, shape: tuple[int, ...], blocks: Iterable[Floats]) -> None:
        """Write an array of float64 time by time, from blocks (..., n) that follow each other.

        It is stored column by column ("Fortran order"), so that samples of one time follow each
        other in the file, and is read as ``shape``, (..., n_times).
        """
        head = {"descr": "<f8", "fortran_order": True, "shape": shape}
        with self._member(name) as member:
            npy.write_array_header_2_0(member, head)
            for block in blocks:
                member.write(np.ascontiguousarray(block.T, dtype="<f8").data)

    def _member(self, name: str) -> IO[bytes]:
        return self._zip.open(ZipInfo(f"{name}.npy", _NO_DATE), "w", force_zip64=True)


# Headers, the text and the table of contents take less.
_HEADER_BYTES = 2**20


def write_field(path: Path, exported: ExportedDesign) -> None:
    """Write the acceleration of all outputs on all axes, block by block.

    ``numpy.load`` reads the file.  It holds ``acceleration_m_per_s2`` (n_outputs, n_axes, n_times;
    float64, time 0 first, the pre-trigger delay contained), ``sample_rate_hz``, and ``about``, a
    text.  Silence is exactly 0.

    Raises
    ------
    StorageError
        The disk has too little room.
    """
    limb = exported.limb
    shape = limb.n_outputs, limb.n_axes, exported.n_times
    # The written samples themselves are checked, of a long field those of some outputs.
    selected = exported.view.outputs if exported.streamed is not None else ()
    checked = exported.holdable(selected or exported.all_outputs, ALL_AXES)
    rows = [output - 1 for output in checked]
    written = np.empty((len(checked), *shape[1:]))

    def blocks() -> Iterator[Floats]:
        done = 0
        for block in exported.field_blocks():
            stop_if(exported.stop)
            written[..., done : done + block.shape[-1]] = block[rows]
            done += block.shape[-1]
            yield block

    with output_file(path, exported.stop) as file:
        n_bytes = math.prod(shape) * np.dtype(np.float64).itemsize + _HEADER_BYTES
        advice = "Free some space, choose another disk, or shorten the design."
        check_free_space(path, n_bytes, "the whole field", advice)
        with NpzArchive(file) as archive:
            archive.put("sample_rate_hz", np.array(exported.sample_rate_hz))
            archive.put_blocks("acceleration_m_per_s2", shape, blocks())
            whole = checked == exported.all_outputs
            error_line = exported.error_line(
                "the field" if whole else f"the field at {_listed(checked)}",
                checked,
                ALL_AXES,
                axis_traces=written,
            )
            lines = about(
                exported,
                f"acceleration_m_per_s2: {counted(limb.n_outputs, 'output')}, "
                f"{counted(limb.n_axes, 'axis', 'axes')} ({', '.join(limb.axes)}), "
                f"{counted(exported.n_times, 'time')}, in m/s²",
                f"times: sample k at {_first_sample_text(exported)}k / "
                f"{exported.sample_rate_hz:g} s; pre-trigger delay of "
                f"{limb.pre_trigger_delay_s * 1e3:g} ms: contained in the times",
                about_levels(exported),
            )
            archive.put("about", np.array("\n".join([*lines, error_line])))


def _first_sample_text(exported: ExportedDesign) -> str:
    """Return the time before sample k: responses through actuators may begin before time 0."""
    first_s = float(exported.value("response_time_s")[0]) if exported.design.actuated else 0.0
    return f"{first_s:.9g} s + " if first_s else ""


def _listed(outputs: tuple[int, ...]) -> str:
    return f"outputs {', '.join(map(str, outputs))}"


export_traces, export_levels = Export(write_traces), Export(write_levels)
export_windows, export_field = Export(write_windows), Export(write_field)


_SIGNATURE = b"\x89PNG\r\n\x1a\n"
# Bits per channel; red, green, blue; then the only compression and filtering there are, no lacing.
_HEADER = struct.Struct(">IIBBBBB")
_DEPTH, _RGB = 8, 2


def write_png(file: BinaryIO, pixels: NDArray[np.uint8], texts: dict[str, str]) -> None:
    """Write a picture.

    Parameters
    ----------
    pixels : (rows, columns, 3)
        Red, green and blue; the first row is the highest.
    texts
        Texts within the file, by keyword.
    """
    rows, columns, _ = pixels.shape
    # Each row begins with how it is filtered: not at all.
    lines = np.zeros((rows, 1 + 3 * columns), np.uint8)
    lines[:, 1:] = pixels.reshape(rows, -1)
    file.write(_SIGNATURE)
    _write_chunk(file, b"IHDR", _HEADER.pack(columns, rows, _DEPTH, _RGB, 0, 0, 0))
    for keyword, text in texts.items():
        # Keyword, no compression, no language, text.
        _write_chunk(file, b"iTXt", keyword.encode("latin-1") + b"\0\0\0\0\0" + text.encode())
    _write_chunk(file, b"IDAT", zlib.compress(lines.tobytes(), 9))
    _write_chunk(file, b"IEND", b"")


def _write_chunk(file: BinaryIO, kind: bytes, content: bytes) -> None:
    file.write(struct.pack(">I", len(content)))
    file.write(kind + content)
    file.write(struct.pack(">I", zlib.crc32(kind + content)))


# Colours from the lowest level to the highest; lightness rises evenly, so that a print in grey is
# readable too.
_ANCHORS = np.array(
    [[13, 8, 35], [72, 20, 92], [142, 38, 88], [208, 73, 58], [243, 139, 44], [252, 236, 160]]
)
_OUTSIDE_VALUE = 255
# Pixels of the picture, in each direction, for one pixel of the map.
_MAGNIFICATION = 3


def write_map(path: Path, exported: ExportedDesign) -> None:
    """Write the map as a table: a row for each y, from the lowest, in mm; dB re 1 m/s².

    Values outside the outline of the limb, and those of silence, are ``nan``.
    """
    results, lines = _map_content(exported)
    surface = results["surface"]
    header = ["y_mm", *(f"x_{x:g}_mm" for x in surface.x_mm)]
    levels_db = levels_for_tables(results["surface_levels_db"])
    write_table(path, exported, lines, header, np.column_stack((surface.y_mm, levels_db)))


def write_map_picture(path: Path, exported: ExportedDesign) -> None:
    """Write the map as a picture (PNG), with the meaning of its colours as a text.

    Colours go from the loudest output to `MAP_RANGE_DB` below it.
    """
    results, lines = _map_content(exported)
    levels_db = results["surface_levels_db"]
    top_db = float(np.nanmax(levels_db))
    colours = (
        f"colours: {top_db - MAP_RANGE_DB:.1f} (darkest) to {top_db:.1f} (lightest) dB re 1 m/s²"
    )
    pixels = picture_of(levels_db, top_db)
    with output_file(path, exported.stop) as file:
        write_png(file, pixels, {"Description": "\n".join([*lines, colours])})
        exported.progress(1, 1, "Writing")


def _map_content(exported: ExportedDesign) -> tuple[dict[str, Any], list[str]]:
    """Return the quantities of the map, and the lines about them."""
    results = exported.values({"surface", "surface_levels_db", "output_rms"})
    error_line = exported.loudest_error_line(results["output_rms"])
    levels = f"{about_levels(exported)}, in dB re 1 m/s²"
    return results, [*about(exported, about_axes(exported), levels), error_line]


def picture_of(
    levels_db: Floats, top_db: float, magnification: int = _MAGNIFICATION
) -> NDArray[np.uint8]:
    """Return the colours of a map, (magnified rows, magnified columns, 3), its highest row first.

    Parameters
    ----------
    levels_db : (rows, columns)
        NaN outside the outline, which is white.
    top_db
        Level of the lightest colour.
    magnification
        Pixels of the picture, in each direction, for one of the map.
    """
    inside = np.isfinite(levels_db)
    share = np.clip((np.where(inside, levels_db, top_db) - top_db) / MAP_RANGE_DB + 1.0, 0.0, 1.0)
    at = np.linspace(0.0, 1.0, len(_ANCHORS))
    colours = np.stack([np.interp(share, at, channel) for channel in _ANCHORS.T], axis=-1)
    pixels = np.where(inside[..., None], np.rint(colours), _OUTSIDE_VALUE).astype(np.uint8)
    return pixels[::-1].repeat(magnification, axis=0).repeat(magnification, axis=1)


export_map, export_map_picture = Export(write_map), Export(write_map_picture)
