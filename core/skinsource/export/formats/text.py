"""Text formats: CSV as a table or as waveform generators read it, and headers in C."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.job import Stop, stop_if
from skinsource.base.quoting import sentence
from skinsource.base.work import counted
from skinsource.export.exported_design import steadily_written
from skinsource.export.formats.format import SAMPLES, Facts, Outgoing, StimulusFormat, channel_names
from skinsource.specs.spec import ChoiceSpec
from skinsource.version import __version__

LAYOUT = "layout"
_BLOCK = 4096
_MOST_KEYSIGHT = 4
# Layouts that begin with the times.
_TIMED_LAYOUTS = ("table", "pwl")
# Seventeen digits, most numbers below 1, and a separator; a zero has two bytes.
_BYTES_OF_NUMBER = 21


def number(value: float) -> str:
    """Return seventeen significant digits, which read back as the same number."""
    return f"{value:.17g}"


def write_csv(outgoing: Outgoing, path: Path) -> Facts:
    """Write the file."""
    layout = outgoing.choices[LAYOUT]
    n_channels = len(outgoing.stimulus.channels)
    most = {"keysight": _MOST_KEYSIGHT, "pwl": 1}.get(layout)
    if most is not None and n_channels > most:
        raise InvalidInputError(
            f"The layout {layout} holds at most {counted(most, 'channel')}, found "
            f"{n_channels}. Choose the layout table, or one file per input."
        )
    names = [f"{name}_of_full_scale" for name in channel_names(outgoing.stimulus)]
    columns = {
        "table": ["time_s", *names],
        "keysight": [f"Y{number}" for number in range(1, n_channels + 1)],
    }.get(layout, [])
    timed = layout in _TIMED_LAYOUTS
    with steadily_written(path) as file:
        if layout == "keysight":
            file.write(f"SampleRate = {outgoing.rate_hz}\n".encode())
        if columns:
            file.write((",".join(columns) + "\n").encode())
        for rows in _rows(outgoing, timed=timed):
            file.write(("\n".join(",".join(map(number, row)) for row in rows) + "\n").encode())
    return {"samples": "float64", "columns": columns}


def _rows(outgoing: Outgoing, *, timed: bool) -> Iterator[list[list[float]]]:
    """Yield rows, some thousand at a time: the time, if ``timed``, and a value for each channel."""
    stimulus = outgoing.stimulus
    for start in range(0, stimulus.n_times, _BLOCK):
        stop_if(outgoing.stop)
        part: Floats = stimulus.samples[:, start : start + _BLOCK]
        if timed:
            time_s = np.arange(start, start + part.shape[1]) / stimulus.sample_rate_hz
            part = np.vstack((time_s, part))
        yield part.T.tolist()
        outgoing.progress(start + part.shape[1], stimulus.n_times, "Writing")


CSV = StimulusFormat(
    name="csv",
    title="CSV",
    suffix=".csv",
    hint="A table of times and channels, or what waveform generators read",
    write=write_csv,
    bytes_of=lambda n_channels, n_times, choices: (
        _BYTES_OF_NUMBER * (n_channels + (choices[LAYOUT] in _TIMED_LAYOUTS)) * n_times
    ),
    rate_hz=None,
    to_device=False,
    choices={
        LAYOUT: ChoiceSpec(
            label="Layout",
            options=(
                ("table", "Table with times and names"),
                ("plain", "Numbers only, one column per channel"),
                ("keysight", "Keysight M8190 series"),
                ("pwl", "Time and value, one channel"),
            ),
            hint="A table says what its columns are; generators and simulators want less",
        )
    },
)


#: Bytes of one value.
BYTES = {"int8_t": 1, "uint8_t": 1, "int16_t": 2, "uint16_t": 2}
_PER_LINE = 12
_C_TEXT_BLOCK = _PER_LINE * 1024
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
    comment: Sequence[str],
    defines: Mapping[str, str],
    kind: str,
    arrays: Mapping[str, NDArray[np.integer]],
    stop: Stop,
) -> int:
    """Write a header that compiles as C99 and as C++; return the bytes of its arrays.

    Parameters
    ----------
    path, outgoing
        The file; the stimulus that it is made from.
    comment
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
        *(f"   {ascii_of(line)}" for line in comment),
        f"   {ascii_of(outgoing.calibration)} */",
        f"#ifndef {guard}",
        f"#define {guard}",
        "",
        *_MACROS,
        *(f"#define {name} {value}" for name, value in defines.items()),
        f"#define STIM_N {n_times}UL",
        f"#define STIM_CH {len(arrays)}",
        *(
            f"/* channel {channel.number}: {ascii_of(channel.title)} */"
            for channel in outgoing.stimulus.channels
        ),
    ]
    with steadily_written(path) as file:
        file.write(("\n".join(lines) + "\n").encode("ascii"))
        for name, values in arrays.items():
            line = f"\nstatic const {kind} {name}[STIM_N] PROGMEM STIM_UNUSED = {{\n"
            file.write(line.encode("ascii"))
            for start in range(0, values.size, _C_TEXT_BLOCK):
                stop_if(stop)
                text = "\n".join(_lines(values[start : start + _C_TEXT_BLOCK].tolist()))
                file.write((text + "\n").encode("ascii"))
            file.write(b"};\n")
        file.write(b"\n#endif\n")
    return n_bytes


def _lines(values: list[int]) -> Iterator[str]:
    for start in range(0, len(values), _PER_LINE):
        yield " ".join(f"{value}," for value in values[start : start + _PER_LINE])


def ascii_of(text: str) -> str:
    """Return ``text`` in ASCII for a comment in C."""
    return text.replace("²", "^2").encode("ascii", "replace").decode().replace("*/", "* /")


def write_c_header(outgoing: Outgoing, path: Path) -> Facts:
    """Write the file."""
    kind = outgoing.choices[SAMPLES]
    quantised, facts = outgoing.integers(kind)
    stimulus, rate_hz = outgoing.stimulus, outgoing.rate_hz
    names = [f"stim_{name}" for name in channel_names(stimulus)]
    n_bytes = write_header(
        path,
        outgoing,
        comment=[
            sentence(
                f"1.0 of full scale is {quantised.full_scale} above {quantised.kind.zero}; it "
                f"stands for {outgoing.full_scale!r} {stimulus.unit}"
            )
        ],
        defines={
            "STIM_FS_HZ": f"{rate_hz}UL" if isinstance(rate_hz, int) else f"{rate_hz}",
            "STIM_FULL_SCALE": f"{quantised.full_scale}",
            "STIM_ZERO": f"{quantised.kind.zero}",
        },
        kind=f"{kind}_t",
        arrays=dict(zip(names, quantised.values, strict=True)),
        stop=outgoing.stop,
    )
    return {**facts, "array_bytes": n_bytes, "arrays": names}


def _loses(choices: Mapping[str, str]) -> str:
    bits = 8 * BYTES[f"{choices[SAMPLES]}_t"]
    rounding_db = 20.0 * np.log10(2.0**bits - 2.0)
    return (
        f"{bits} bits: each sample is rounded, by at most {rounding_db:.0f} dB below full scale. "
        "What lies above 0.46 of the rate is left out."
    )


C_HEADER = StimulusFormat(
    name="c-header",
    title="C header",
    suffix=".h",
    hint="Arrays for a microcontroller; the bytes are those of the arrays in its memory",
    write=write_c_header,
    bytes_of=lambda n_channels, n_times, choices: (
        n_channels * n_times * BYTES[f"{choices[SAMPLES]}_t"]
    ),
    rounds=lambda _: True,
    rate_hz=8000,
    choices={
        SAMPLES: ChoiceSpec(
            label="Samples",
            options=(
                ("int16", "16 bit, with sign"),
                ("int8", "8 bit, with sign"),
                ("uint8", "8 bit, without sign"),
            ),
            hint="What the converter takes; without a sign, 128 is silence",
        )
    },
    loses=_loses,
)
