"""A C header: one array of whole numbers per channel, for microcontrollers."""

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from skinsource.export.output_file import steadily_written
from skinsource.fields import ChoiceSpec
from skinsource.job import stop_if
from skinsource.stimulus_formats.column_names import channel_names
from skinsource.stimulus_formats.stimulus_format import SAMPLES, Facts, Outgoing, StimulusFormat
from skinsource.version import __version__

_BYTES = {"int16": 2, "int8": 1, "uint8": 1}
_PER_LINE = 12
_BLOCK = _PER_LINE * 1024


def write_c_header(outgoing: Outgoing, path: Path) -> Facts:
    """Write the file; it compiles as C99 and as C++."""
    kind = outgoing.choices[SAMPLES]
    found, facts = outgoing.whole_numbers(kind)
    names = [f"stim_{name}" for name in channel_names(outgoing.stimulus)]
    n_bytes = found.values.size * _BYTES[kind]
    with steadily_written(path) as file:
        head = _head(outgoing, kind, found.full_scale, found.kind.zero, n_bytes, names)
        file.write(("\n".join(head) + "\n").encode("ascii"))
        for name, values in zip(names, found.values, strict=True):
            line = f"\nstatic const {kind}_t {name}[STIM_N] PROGMEM STIM_UNUSED = {{\n"
            file.write(line.encode("ascii"))
            for start in range(0, values.size, _BLOCK):
                stop_if(outgoing.stop)
                text = "\n".join(_lines(values[start : start + _BLOCK].tolist()))
                file.write((text + "\n").encode("ascii"))
            file.write(b"};\n")
        file.write(b"\n#endif\n")
    return {**facts, "array_bytes": n_bytes, "arrays": names}


def _head(
    outgoing: Outgoing, kind: str, full_scale: int, zero: int, n_bytes: int, names: list[str]
) -> list[str]:
    stimulus = outgoing.stimulus
    guard = "STIM_" + re.sub(r"[^A-Z0-9]", "_", outgoing.digest[:16].upper()) + "_H"
    rate = f"{outgoing.rate_hz}UL" if isinstance(outgoing.rate_hz, int) else f"{outgoing.rate_hz}"
    return [
        f"/* {n_bytes} bytes: {len(names)} x {stimulus.n_times} samples of {kind}.",
        f"   SkinSource studio {__version__}; design SHA-256 {outgoing.digest}.",
        f"   1.0 of full scale is {full_scale} above {zero}; it stands for "
        f"{outgoing.full_scale!r} {_ascii(stimulus.unit)}. Uncalibrated. */",
        f"#ifndef {guard}",
        f"#define {guard}",
        "",
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
        f"#define STIM_FS_HZ {rate}",
        f"#define STIM_N {stimulus.n_times}UL",
        f"#define STIM_CH {len(names)}",
        f"#define STIM_FULL_SCALE {full_scale}",
        f"#define STIM_ZERO {zero}",
        *(f"/* channel {one.number}: {_ascii(one.title)} */" for one in stimulus.channels),
    ]


def _lines(values: list[int]) -> Iterator[str]:
    for start in range(0, len(values), _PER_LINE):
        yield " ".join(f"{value}," for value in values[start : start + _PER_LINE])


def _ascii(text: str) -> str:
    return text.replace("²", "^2").encode("ascii", "replace").decode().replace("*/", "* /")


def _bytes_of(n_channels: int, n_times: int, choices: Mapping[str, str]) -> int:
    return n_channels * n_times * _BYTES[choices[SAMPLES]]


def _loses(choices: Mapping[str, str]) -> str:
    noise_db = -20.0 * np.log10(0.5 / (2 ** (8 * _BYTES[choices[SAMPLES]] - 1)))
    bits = 8 * _BYTES[choices[SAMPLES]]
    return (
        f"{bits} bits: each sample is rounded, by at most {noise_db:.0f} dB below full scale. What "
        "lies above 0.46 of the rate is left out."
    )


C_HEADER = StimulusFormat(
    name="c-header",
    title="C header",
    suffix=".h",
    hint="Arrays for a microcontroller; the bytes are those of the arrays in its memory",
    write=write_c_header,
    bytes_of=_bytes_of,
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
