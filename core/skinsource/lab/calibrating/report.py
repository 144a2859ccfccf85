"""The report of a calibrated person: what a reviewer asks, as JSON, as a page, and what was played.

Levels are those that were measured; predicted ones stand beside them.
"""

from __future__ import annotations

import hashlib
import json
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from textwrap import wrap
from typing import Any

import numpy as np

from skinsource.base.arguments import checking
from skinsource.base.errors import MissingExtraError
from skinsource.base.files import FilePath, make_folder, write_bytes
from skinsource.engine.stimulus import stimulus_of
from skinsource.export import plot
from skinsource.export.exported_design import versions
from skinsource.export.stimulus_export.export import export_stimulus
from skinsource.lab.calibrating.calibration import RULES, SWEEP_S, SWEPT_HZ
from skinsource.lab.calibrating.verification import Verification
from skinsource.people.partial_file import digest_of, save_partial
from skinsource.perception.validity import fastest_probe

_LEVELS = "RMS along z over the loudest 100 ms, dB re 1 m/s²"
_LETTERS = 118


@checking
def save_report(folder: FilePath, verification: Verification) -> dict[str, Any]:
    """Write all about a calibrated person into a folder, and return what ``report.json`` says.

    Beside it lie ``report.pdf`` (with the extra ``plot``), the partial limb ``person.h5``, and of
    all that was played the sound, with a sidecar.  What was not measured yet is
    missing: the report then says "not verified".

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    """
    place = Path(folder)
    make_folder(place)
    found = verification.found
    save_partial(place / "person.h5", found.partial)
    for name, design in verification.designs.items():
        path = place / f"{name.replace(' ', '-')}.wav"
        export_stimulus(design, path, rig=found.rig, confirmed=True)
    files = sorted(path for path in place.iterdir() if not path.name.startswith("report."))
    about = _about(verification) | {
        "files": {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in files}
    }
    text = json.dumps(about, ensure_ascii=False, indent=2, allow_nan=False)
    write_bytes(place / "report.json", f"{text}\n".encode())
    with suppress(MissingExtraError):
        write_bytes(place / "report.pdf", plot.figure_content(_page(about), "pdf"))
    return about


def _about(verification: Verification) -> dict[str, Any]:
    found, focus = verification.found, verification.focus
    designs = {}
    for name, design in verification.designs.items():
        sent = stimulus_of(design)
        designs[name] = {
            "peak_m_per_s2": float(np.abs(sent.samples).max()),
            "peak_m_per_s": fastest_probe(sent.samples, sent.sample_rate_hz),
            "places": [channel.place for channel in sent.channels],
        }
    return {
        "what": "SkinSource calibration of a person",
        "state": verification.state,
        "sitting": asdict(found.sitting),
        "measured_on": found.measured_on,
        "rig": f"{found.rig.title}. {found.rig.note}".strip(),
        "sweeps": {"band_hz": SWEPT_HZ, "duration_s": SWEEP_S, "of_each_input": 2},
        "rules_of_exclusion": RULES,
        "moved": found.moved,
        "noise_m_per_s2": found.noise_m_per_s2,
        "latency_s": found.latency_s,
        "inputs": [
            {name: value for name, value in vars(row).items() if name != "response"}
            for row in found.rows
        ],
        "sha256_of_partial_limb": digest_of(found.partial),
        "focus": {
            "target": focus.target,
            "inputs": focus.inputs,
            "band_hz": (focus.frequencies_hz[0], focus.frequencies_hz[-1]),
            "beta": float(np.median(focus.beta)),
            "median_effort_db": float(np.median(focus.effort_db)),
            "other_people": verification.expected["focus"].names,
        },
        "played": designs,
        "levels": _LEVELS,
        "checks": [_known(asdict(check)) for check in verification.checks],
        "versions": versions(),
    }


def _known(values: dict[str, Any]) -> dict[str, Any]:
    return {name: None if value != value else value for name, value in values.items()}


def _page(about: dict[str, Any]) -> Any:
    """Return a page that says the same."""
    title, lines = about["what"], []
    for name, value in about.items():
        rows = value if isinstance(value, list) else [value]
        for row in rows:
            text = f"{name.replace('_', ' ')}: {_words(row)}"
            lines += wrap(text, _LETTERS, subsequent_indent="    ")
    with plot.style():
        figure = plot.new_figure(210.0, 297.0)
        figure.text(0.08, 0.97, title, fontsize=12, va="top", parse_math=False)
        size = min(6.5, 600.0 / len(lines))
        text = "\n".join(lines[1:])
        figure.text(
            0.08, 0.945, text, fontsize=size, va="top", family="monospace", parse_math=False
        )
    return figure


def _words(value: Any) -> str:
    """Return a value as words, numbers with their first four digits."""
    if isinstance(value, dict):
        known = {name: each for name, each in value.items() if each not in (None, "", ())}
        return ", ".join(f"{name.replace('_', ' ')} {_words(each)}" for name, each in known.items())
    if isinstance(value, tuple):
        return "; ".join(map(_words, value))
    return f"{value:.4g}" if isinstance(value, float) else f"{value}"
