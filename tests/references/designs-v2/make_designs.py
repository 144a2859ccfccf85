"""Five design files of format version 2, and in ``expected.json`` what they hold.

They stand for the files that users have.  They can only be made by the code that wrote such
files, as of commit 375e76b (22 November 2026)::

    git worktree add --detach ../version-2 375e76b
    PYTHONPATH=../version-2/core python tests/references/designs-v2/make_designs.py

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

EVERY_KIND = DesignFile(
    design=Design(
        limb="synthetic-2",
        inputs=(
            Input(
                location=1,
                waveform=Tone(
                    frequency_hz=333.25, phase_rad=-0.1, duration_s=0.0997, window="hanning"
                ),
                amplitude=-0.7,
                solo=True,
                colour=3,
                id=5,
            ),
            Input(location=20, waveform=Tap(), onset_s=1 / 3, colour=4, solo=True, id=2),
            Input(location=13, waveform=Impulse(), amplitude=1e-3, onset_s=0.05, id=9),
            Input(
                location=20,
                waveform=Noise(seed=2**31 - 1, duration_s=0.3, window="none"),
                onset_s=0.1234567,
                colour=2**31 - 1,
                solo=True,
            ),
            Input(location=7, waveform=Tap(), muted=True, onset_s=0.0004, solo=True, colour=1),
        ),
        scaling="probe",
        title="Every kind",
        author="Häuser",
        notes="Two lines,\nof which this is one.",
        licence="CC-BY-4.0",
    ),
    view=View(
        axes="z",
        method="soc",
        span="loudest",
        outputs=(72, 1, 29),
        selected_inputs=(2, 5),
        delay_removed=True,
        time_range_s=(-0.05, 1 / 3),
        panels=(("skin", (("map_range_db", (-60.0, 0.1)),)), ("unknown", (("a", ("b", 1)),))),
    ),
    layout=bytes(range(256)),
)
#: Onsets in sums of binary fractions, at and beside half samples.
ONSETS = DesignFile(
    design=Design(
        limb="synthetic-1",
        inputs=tuple(
            Input(
                location=1 + k % 20,
                waveform=Tone(frequency_hz=40.0 + 17.3 * k, duration_s=0.05 + 0.003 * k),
                amplitude=(-1) ** k * (0.1 + 0.07 * k),
                onset_s=onset_s,
                colour=k,
            )
            for k, onset_s in enumerate(
                (0.5 / 1300, 0.50000001 / 1300, 0.4999 / 1300, 0.35, 0.1 + 0.2, 1.5 / 1300, 0.0077)
            )
        ),
    ),
    view=View(selected_inputs=(3, 1, 7)),
)
EXTREMES = DesignFile(
    design=Design(
        limb="somebody's own limb",
        inputs=(
            Input(
                location=10_000,
                waveform=Tone(frequency_hz=100_000.0, duration_s=600.0, phase_rad=2 * pi),
                amplitude=1000.0,
                onset_s=600.0,
                id=2**31 - 1,
            ),
            Input(location=3, amplitude=-0.0, onset_s=5e-324, waveform=Noise(duration_s=0.01)),
        ),
        scaling="relative",
    ),
    view=View(selected_inputs=(), outputs=(), time_range_s=(-1e300, 1e300)),
)
FILES = {
    "start": DesignFile(
        design=Design(limb="synthetic-1", inputs=(Input(location=7, waveform=Tone()),))
    ),
    "every-kind": EVERY_KIND,
    "onsets": ONSETS,
    "nothing": DesignFile(design=Design(limb="synthetic-4", scaling="probe")),
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
    if VERSION != 2:
        raise SystemExit(f"This code writes version {VERSION}; take that of commit 375e76b.")
    folder = Path(__file__).parent
    for name, content in FILES.items():
        path = folder / f"{name}.skinsource"
        save_design(path, content.design, content.view, layout=content.layout)
    expected = {
        name: {**plain(content), "output_levels_db": levels_db(content)}
        for name, content in FILES.items()
    }
    text = json.dumps(expected, indent=1)
    (folder / "expected.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
