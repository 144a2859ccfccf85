"""Headers in C: constants and arrays of whole numbers."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from skinsource.export.output_file import steadily_written
from skinsource.job import Stop, stop_if
from skinsource.stimulus_formats.stimulus_format import Outgoing
from skinsource.version import __version__

#: Of one value.
BYTES = {"int8_t": 1, "uint8_t": 1, "int16_t": 2, "uint16_t": 2}
_PER_LINE = 12
_BLOCK = _PER_LINE * 1024
_MACROS = (
    "#include <stdint.h>",
    "",
    "#ifdef __AVR__",
    "#include <avr/pgmspace.h>",
    "#endif",
    "#ifndef PROGMEM",
    "#define PROGMEM",
    "#endif",
    "#ifdef __GNUC__",
    "#define STIM_UNUSED __attribute__((unused))",
    "#else",
    "#define STIM_UNUSED",
    "#endif",
    "",
)


def write_header(
    path: Path,
    outgoing: Outgoing,
    *,
    words: Sequence[str],
    defines: Mapping[str, str],
    kind: str,
    arrays: Mapping[str, NDArray[np.integer]],
    stop: Stop,
) -> int:
    """Write a header that compiles as C99 and as C++; gives the bytes of its arrays.

    Parameters
    ----------
    path, outgoing
        The file; what it is about.
    words
        Lines of the comment at its top.
    defines
        Constants, by name.
    kind
        Type of the values: ``"int16_t"``.
    arrays
        Values, (n_times,) each, by name; equal lengths.
    stop
        Asked now and then.
    """
    n_bytes = sum(values.size for values in arrays.values()) * BYTES[kind]
    n_times = max(values.size for values in arrays.values())
    guard = f"STIM_{outgoing.digest[:16].upper()}_H"
    lines = [
        f"/* {n_bytes} bytes: {len(arrays)} x {n_times} values of {kind}.",
        f"   SkinSource studio {__version__}; design SHA-256 {outgoing.digest}.",
        *(f"   {ascii_of(line)}" for line in words),
        f"   {ascii_of(outgoing.calibration)} */",
        f"#ifndef {guard}",
        f"#define {guard}",
        "",
        *_MACROS,
        *(f"#define {name} {value}" for name, value in defines.items()),
        f"#define STIM_N {n_times}UL",
        f"#define STIM_CH {len(arrays)}",
        *(
            f"/* channel {one.number}: {ascii_of(one.title)} */"
            for one in outgoing.stimulus.channels
        ),
    ]
    with steadily_written(path) as file:
        file.write(("\n".join(lines) + "\n").encode("ascii"))
        for name, values in arrays.items():
            line = f"\nstatic const {kind} {name}[STIM_N] PROGMEM STIM_UNUSED = {{\n"
            file.write(line.encode("ascii"))
            for start in range(0, values.size, _BLOCK):
                stop_if(stop)
                text = "\n".join(_lines(values[start : start + _BLOCK].tolist()))
                file.write((text + "\n").encode("ascii"))
            file.write(b"};\n")
        file.write(b"\n#endif\n")
    return n_bytes


def _lines(values: list[int]) -> Iterator[str]:
    for start in range(0, len(values), _PER_LINE):
        yield " ".join(f"{value}," for value in values[start : start + _PER_LINE])


def ascii_of(text: str) -> str:
    """Return ``text`` for a comment in C."""
    return text.replace("²", "^2").encode("ascii", "replace").decode().replace("*/", "* /")
