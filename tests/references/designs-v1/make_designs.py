"""Six design files of format version 1, and in ``expected.json`` what they hold.

They stand for the files that users have.  They can only be made by the code that wrote such
files, as of commit e4ea668 (21 November 2026)::

    git worktree add --detach ../version-1 e4ea668
    PYTHONPATH=../version-1/core python tests/references/designs-v1/make_designs.py

Floats are written in hexadecimal, so that not one bit is lost.  Levels are those of designs on
synthetic limbs, which every installation has; they were made with numpy 2.4 on x86-64.
"""

import dataclasses
import json
from math import pi
from pathlib import Path
from typing import Any

from skinsource.design import Design, Input
from skinsource.design_file import VERSION, DesignFile, save_design
from skinsource.quantities import new_graph, sources
from skinsource.view import View
from skinsource.waveforms import Impulse, Noise, Tap, Tone

START = DesignFile(design=Design(limb="synthetic-1", inputs=(Input(location=7, waveform=Tone()),)))
EVERY_KIND = DesignFile(
    design=Design(
        limb="synthetic-2",
        inputs=(
            Input(
                location=1,
                waveform=Tone(
                    frequency_hz=123.456789, phase_rad=-pi / 3, duration_s=0.1, window="hanning"
                ),
                amplitude=-0.1,
            ),
            Input(location=20, waveform=Tap(), onset_s=1 / 3, colour=4),
            Input(location=13, waveform=Impulse(), amplitude=1e-3, onset_s=0.05, colour=2),
            Input(
                location=13,
                waveform=Noise(seed=2**31 - 1, duration_s=0.3, window="none"),
                amplitude=0.7,
                onset_s=0.123,
                colour=1,
            ),
        ),
        scaling="relative",
    ),
    view=View(
        axes="xz",
        method="soc",
        outputs=(72, 1, 61, 33),
        selected_input=2,
        map_style="sensors",
        sensors_shown=False,
        map_range_db=(-61.25, -0.1),
        traces_layout="stacked",
        spectra_layout="stacked",
        log_frequency=True,
        log_magnitude=False,
        delay_removed=True,
        time_range_s=(-0.05, 0.3),
        frequency_range_hz=(25.0, 600.0),
    ),
    layout=b"\x00\xff\xfe arrangement \xe2\x86\x92 \xc3\xa4\xc3\xb6\xc3\xbc \x00" * 40,
)
MUTED_AND_SOLO = DesignFile(
    design=Design(
        limb="synthetic-3",
        inputs=(
            Input(location=5, waveform=Tone(frequency_hz=60.0), solo=True, colour=7),
            Input(location=6, waveform=Noise(seed=3), muted=True, colour=5),
            Input(location=5, waveform=Tap(), muted=True, solo=True, colour=6),
            Input(location=9, waveform=Tone(phase_rad=2 * pi), solo=True, onset_s=0.01, colour=0),
        ),
        scaling="probe",
    ),
    view=View(axes="z", method="mag", outputs=(), selected_input=None, map_range_db=(-80.0, 20.0)),
)
MANY_INPUTS = DesignFile(
    design=Design(
        limb="synthetic-4",
        inputs=tuple(
            Input(
                location=1 + (7 * k) % 20,
                waveform=(
                    Tone(frequency_hz=25.0 + 575.0 * k / 99, duration_s=0.02 + k / 1000),
                    Noise(seed=k, duration_s=0.01 + k / 500, window="hanning"),
                    Tap(),
                    Impulse(),
                )[k % 4],
                amplitude=0.1 + k / 7,
                onset_s=k * 0.0031,
                muted=k % 11 == 10,
                colour=99 - k,
            )
            for k in range(100)
        ),
    ),
    view=View(axes="xyz", method="rms", outputs=(29, 52, 44), selected_input=99),
    layout=bytes(range(256)),
)
NOTHING = DesignFile(
    design=Design(limb="measured-4"), view=View(selected_input=None, outputs=(54,))
)
EXTREMES = DesignFile(
    design=Design(
        limb="measured-1",
        inputs=(
            Input(
                location=2,
                waveform=Tone(
                    frequency_hz=649.0, phase_rad=-2 * pi, duration_s=600.0, window="none"
                ),
                amplitude=-1000.0,
                onset_s=600.0,
                colour=2**31 - 1,
            ),
            Input(
                location=3,
                waveform=Tone(frequency_hz=1.0, duration_s=0.001, phase_rad=-0.0),
                amplitude=5e-324,
                onset_s=5e-324,
                colour=1000,
            ),
            Input(location=4, waveform=Noise(duration_s=0.01), amplitude=-0.0, colour=0),
        ),
        scaling="relative",
    ),
    view=View(
        axes="y",
        outputs=tuple(range(72, 0, -1)),
        selected_input=1,
        map_range_db=(-1e9, 1e9),
        time_range_s=(-5e-324, 5e-324),
        frequency_range_hz=(0.1, 0.30000000000000004),
    ),
    layout=b"\n",
)
FILES = {
    "start": START,
    "every-kind": EVERY_KIND,
    "muted-and-solo": MUTED_AND_SOLO,
    "many-inputs": MANY_INPUTS,
    "nothing": NOTHING,
    "extremes": EXTREMES,
}


def plain(value: Any) -> Any:
    """Value for JSON: floats in hexadecimal, recipes with their kind."""
    if dataclasses.is_dataclass(value):
        fields = {f.name: plain(getattr(value, f.name)) for f in dataclasses.fields(value)}
        return {"kind": type(value).__name__, **fields}
    if isinstance(value, tuple):
        return [plain(part) for part in value]
    if isinstance(value, bytes):
        return value.hex()
    return value.hex() if isinstance(value, float) else value


def levels_db(content: DesignFile) -> list[str] | None:
    """Level of each output, hexadecimal; None where the limb is not part of the installation."""
    if not content.design.limb.startswith("synthetic"):
        return None
    found = new_graph().evaluate({"output_levels_db"}, sources(content.design, content.view))
    return [float(level).hex() for level in found["output_levels_db"]]


def main() -> None:
    """Write the files and what is expected of them."""
    if VERSION != 1:
        raise SystemExit(f"This code writes version {VERSION}; take that of commit e4ea668.")
    folder = Path(__file__).parent
    for name, content in FILES.items():
        save_design(folder / f"{name}.skinsource", content)
    expected = {
        name: {**plain(content), "output_levels_db": levels_db(content)}
        for name, content in FILES.items()
    }
    text = json.dumps(expected, indent=1)
    (folder / "expected.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
