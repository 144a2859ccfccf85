"""A C header: one array of whole numbers per channel, for microcontrollers."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from skinsource.fields import ChoiceSpec
from skinsource.quoting import sentence
from skinsource.stimulus_formats.c_text import BYTES, write_header
from skinsource.stimulus_formats.column_names import channel_names
from skinsource.stimulus_formats.stimulus_format import SAMPLES, Facts, Outgoing, StimulusFormat


def write_c_header(outgoing: Outgoing, path: Path) -> Facts:
    """Write the file."""
    kind = outgoing.choices[SAMPLES]
    found, facts = outgoing.whole_numbers(kind)
    stimulus, rate_hz = outgoing.stimulus, outgoing.rate_hz
    names = [f"stim_{name}" for name in channel_names(stimulus)]
    n_bytes = write_header(
        path,
        outgoing,
        words=[
            sentence(
                f"1.0 of full scale is {found.full_scale} above {found.kind.zero}; it stands for "
                f"{outgoing.full_scale!r} {stimulus.unit}"
            )
        ],
        defines={
            "STIM_FS_HZ": f"{rate_hz}UL" if isinstance(rate_hz, int) else f"{rate_hz}",
            "STIM_FULL_SCALE": f"{found.full_scale}",
            "STIM_ZERO": f"{found.kind.zero}",
        },
        kind=f"{kind}_t",
        arrays=dict(zip(names, found.values, strict=True)),
        stop=outgoing.stop,
    )
    return {**facts, "array_bytes": n_bytes, "arrays": names}


def _bytes_of(n_channels: int, n_times: int, choices: Mapping[str, str]) -> int:
    return n_channels * n_times * BYTES[f"{choices[SAMPLES]}_t"]


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
