"""Text formats: CSV as a table or as waveform generators read it, and headers in C."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource.base.assets import data_folder
from skinsource.base.errors import InvalidInputError, counted, sentence
from skinsource.base.job import stop_if
from skinsource.export.formats.format import SAMPLES, Choices, Facts, StimulusFile, StimulusFormat
from skinsource.signals.quantising import KINDS
from skinsource.specs.spec import ChoiceSpec
from skinsource.version import __version__

LAYOUT = "layout"
_BLOCK = 4096
# Most channels of a layout.
_MOST_CHANNELS = {"keysight": 4, "pwl": 1}
# Layouts that begin with the times.
_TIMED_LAYOUTS = ("table", "pwl")
# Seventeen digits, most numbers below 1, and a separator; a zero has two bytes.
_BYTES_OF_NUMBER = 21


def rows_text(values: NDArray[np.float64], separator: str) -> bytes:
    """Return (n_columns, n_rows) as lines; seventeen digits read back as the same number."""
    rows = (separator.join(f"{value:.17g}" for value in row) for row in values.T.tolist())
    return ("\n".join(rows) + "\n").encode()


class Csv(StimulusFormat):
    """CSV, as a table or as what waveform generators read."""

    name = "csv"
    title = "CSV"
    suffix = ".csv"
    hint = "A table of times and channels, or what waveform generators read"
    rate_hz = None
    to_device = False
    choices: ClassVar = {
        LAYOUT: ChoiceSpec(
            label="Layout",
            options=(
                ("table", "Table with times and names"),
                ("plain", "Numbers only, one column per channel"),
                ("keysight", "Keysight M8190 series"),
                ("pwl", "Time and value, one channel"),
            ),
            hint="Tables name their columns; generators and simulators read numbers only",
        )
    }

    def write(self, file: StimulusFile, path: Path) -> Facts:
        """Write the file."""
        layout, stimulus = file.choices[LAYOUT], file.stimulus
        n_channels = len(stimulus.channels)
        most = _MOST_CHANNELS.get(layout, n_channels)
        if n_channels > most:
            raise InvalidInputError(
                f"The layout {layout} holds at most {counted(most, 'channel')}, found "
                f"{n_channels}. Choose the layout table, or one file per input."
            )
        columns = []
        if layout == "table":
            columns = ["time_s", *(f"{name}_of_full_scale" for name in file.channel_names)]
        elif layout == "keysight":
            columns = [f"Y{number}" for number in range(1, n_channels + 1)]
        with path.open("w+b") as output:
            if layout == "keysight":
                output.write(f"SampleRate = {file.rate_hz}\n".encode())
            if columns:
                output.write((",".join(columns) + "\n").encode())
            for times in file.blocks(_BLOCK):
                values = stimulus.samples[:, times]
                if layout in _TIMED_LAYOUTS:
                    time_s = np.arange(times.start, times.stop) / stimulus.sample_rate_hz
                    values = np.vstack((time_s, values))
                output.write(rows_text(values, ","))
        return {"samples": "float64", "columns": columns}

    def n_bytes(self, n_channels: int, n_times: int, choices: Choices) -> int:
        """Return about how many bytes it takes."""
        return _BYTES_OF_NUMBER * (n_channels + (choices[LAYOUT] in _TIMED_LAYOUTS)) * n_times


#: Bytes of one value.
BYTES = {"int8_t": 1, "uint8_t": 1, "int16_t": 2, "uint16_t": 2}
_PER_LINE = 12
_C_TEXT_BLOCK = _PER_LINE * 1024


def write_header(
    path: Path,
    file: StimulusFile,
    values: NDArray[np.integer],
    kind: str,
    comment: Sequence[str],
    defines: Mapping[str, object],
) -> Facts:
    """Write a header that compiles as C99 and as C++; return its arrays, and their bytes.

    Parameters
    ----------
    path, file
        The path; the content that it is made from.
    values : (n_channels, n_times)
        Values of each channel.
    kind
        Type of the values: ``"int16_t"``.
    comment
        Lines of the comment at its top.
    defines
        Constants, by name.
    """
    n_bytes, (n_channels, n_times) = values.size * BYTES[kind], values.shape
    names = [f"stim_{name}" for name in file.channel_names]
    guard = f"STIM_{file.digest[:16].upper()}_H"
    lines = [
        f"/* {n_bytes} bytes: {n_channels} x {n_times} values of {kind}.",
        f"   SkinSource studio {__version__}; design SHA-256 {file.digest}.",
        *(f"   {ascii_of(line)}" for line in comment),
        f"   {ascii_of(file.calibration)} */",
        f"#ifndef {guard}",
        f"#define {guard}",
        "",
        (data_folder() / "header-macros.h").read_text("utf-8"),
        *(f"#define {name} {value}" for name, value in defines.items()),
        f"#define STIM_N {n_times}UL",
        f"#define STIM_CH {n_channels}",
        *(
            f"/* channel {channel.number}: {ascii_of(channel.title)} */"
            for channel in file.stimulus.channels
        ),
    ]
    with path.open("w+b") as output:
        output.write(("\n".join(lines) + "\n").encode("ascii"))
        for name, row in zip(names, values, strict=True):
            output.write(
                f"\nstatic const {kind} {name}[STIM_N] PROGMEM STIM_UNUSED = {{\n".encode("ascii")
            )
            for start in range(0, n_times, _C_TEXT_BLOCK):
                stop_if(file.stop)
                output.write(_array_text(row[start : start + _C_TEXT_BLOCK].tolist()))
            output.write(b"};\n")
        output.write(b"\n#endif\n")
    return {"array_bytes": n_bytes, "arrays": names}


def _array_text(values: list[int]) -> bytes:
    lines = (
        " ".join(f"{value}," for value in values[start : start + _PER_LINE])
        for start in range(0, len(values), _PER_LINE)
    )
    return ("\n".join(lines) + "\n").encode("ascii")


def ascii_of(text: str) -> str:
    """Return ``text`` in ASCII for a comment in C."""
    return text.replace("²", "^2").encode("ascii", "replace").decode().replace("*/", "* /")


def rounding_of(kind: str) -> str:
    """Return a sentence on how much samples are rounded to a kind of whole numbers."""
    bits = KINDS[kind].bits
    most_db = 20.0 * np.log10(2.0**bits - 2.0)
    return f"{bits} bits: each sample is rounded, by at most {most_db:.0f} dB below full scale."


class CHeader(StimulusFormat):
    """Arrays in C."""

    name = "c-header"
    title = "C header"
    suffix = ".h"
    hint = "Arrays for a microcontroller; the bytes are those of the arrays in its memory"
    rate_hz = 8000
    choices: ClassVar = {
        SAMPLES: ChoiceSpec(
            label="Samples",
            options=(
                ("int16", "16 bit, with sign"),
                ("int8", "8 bit, with sign"),
                ("uint8", "8 bit, without sign"),
            ),
            hint="Type that the converter needs; without a sign, 128 is silence",
        )
    }

    def write(self, file: StimulusFile, path: Path) -> Facts:
        """Write the file."""
        kind, rate_hz = file.choices[SAMPLES], file.rate_hz
        quantised, facts = file.integers(kind)
        meaning = sentence(
            f"1.0 of full scale is {quantised.full_scale} above {quantised.kind.zero}; it "
            f"stands for {file.full_scale!r} {file.stimulus.unit}"
        )
        defines = {
            "STIM_FS_HZ": f"{rate_hz}UL" if isinstance(rate_hz, int) else rate_hz,
            "STIM_FULL_SCALE": quantised.full_scale,
            "STIM_ZERO": quantised.kind.zero,
        }
        header = write_header(path, file, quantised.values, f"{kind}_t", [meaning], defines)
        return {**facts, **header}

    def n_bytes(self, n_channels: int, n_times: int, choices: Choices) -> int:
        """Return about how many bytes it takes."""
        return n_channels * n_times * BYTES[f"{choices[SAMPLES]}_t"]

    def rounds(self, choices: Choices) -> bool:
        """Return whether whole numbers are written."""
        return True

    def loses(self, choices: Choices) -> str:
        """Return a sentence on what is not in the file."""
        return f"{rounding_of(choices[SAMPLES])} What lies above 0.46 of the rate is left out."
