"""The map of levels as a table and as a PNG picture, written without a window and matplotlib."""

import struct
import zlib
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from skinsource.base.arrays import Floats
from skinsource.base.decibels import levels_for_tables
from skinsource.export.exported_design import (
    Export,
    ExportedDesign,
    about,
    about_axes,
    describe_levels,
    output_file,
)
from skinsource.export.tables import write_table
from skinsource.signals.map_range import MAP_RANGE_DB

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
    levels = f"{describe_levels(exported.view.span)}, in dB re 1 m/s²"
    return results, [*about(exported, about_axes(exported), levels), error_line]


def picture_of(levels_db: Floats, top_db: float) -> NDArray[np.uint8]:
    """Return the colours of a map, (magnified rows, magnified columns, 3), its highest row first.

    Parameters
    ----------
    levels_db : (rows, columns)
        NaN outside the outline, which is white.
    top_db
        Level of the lightest colour.
    """
    inside = np.isfinite(levels_db)
    share = np.clip((np.where(inside, levels_db, top_db) - top_db) / MAP_RANGE_DB + 1.0, 0.0, 1.0)
    at = np.linspace(0.0, 1.0, len(_ANCHORS))
    colours = np.stack([np.interp(share, at, channel) for channel in _ANCHORS.T], axis=-1)
    pixels = np.where(inside[..., None], np.rint(colours), _OUTSIDE_VALUE).astype(np.uint8)
    return pixels[::-1].repeat(_MAGNIFICATION, axis=0).repeat(_MAGNIFICATION, axis=1)


export_map, export_map_picture = Export(write_map), Export(write_map_picture)
