"""The report of a calibrated person: what a reviewer asks, as JSON, as a page, and what was played.

Levels are those that were measured; predicted ones stand beside them.
"""

from __future__ import annotations

import hashlib
import json
from contextlib import suppress
from dataclasses import asdict
from math import isnan
from pathlib import Path
from textwrap import fill
from typing import Any

import numpy as np

from skinsource.base.arguments import checking
from skinsource.base.errors import MissingExtraError
from skinsource.base.files import FilePath, make_folder, write_bytes
from skinsource.engine.stimulus import stimulus_of
from skinsource.export import plot
from skinsource.export.exported_design import versions
from skinsource.export.stimulus_export.export import export_stimulus
from skinsource.export.stimulus_export.sidecar import sidecar_path
from skinsource.export.wiring import draw_table, new_page
from skinsource.lab.calibrating.calibration import RULES, SWEEP_S, SWEPT_HZ
from skinsource.lab.calibrating.verification import Check, Verification
from skinsource.people.partial_file import digest_of, save_partial
from skinsource.perception.validity import fastest_probe

_LEVELS = "RMS along z over the loudest 100 ms, dB re 1 m/s²"
_LETTERS = 115
_NOTED = "contact", "mounting", "sensor", "posture"
_LEVEL_COLUMNS = "Output", "Played", "Measured", "Predicted", "Range", "NMSE, dB", "Delay, ms"
_INPUT_COLUMNS = "Place", "Coherent", "Accepted"


@checking
def save_report(folder: FilePath, verification: Verification) -> dict[str, Any]:
    """Write all about a calibrated person into a folder, and return what ``report.json`` says.

    Beside it lie ``report.pdf`` (with the extra ``plot``), the partial limb ``person.h5``, and of
    all that was played the sound, with a sidecar.  What was not measured yet is missing: the report
    then says "not verified".

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.

    Examples
    --------
    >>> import skinsource as ss
    >>> from skinsource.lab.calibrating import Sitting, StandIn, begin_verifying
    >>> from skinsource.lab.calibrating import calibrate, save_report
    >>> station = StandIn(inputs=(7, 12))
    >>> found = calibrate(Sitting(person="p07", like=station.like, output=9), station)
    >>> focus = ss.people.focus(found.partial, 9, others=station.others)
    >>> tone = ss.waveforms.Tone()
    >>> plan = begin_verifying(found, focus, tone, others=station.others)
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     print(save_report(folder, plan)["state"])
    not verified
    """
    place = Path(folder)
    make_folder(place)
    found = verification.found
    files = [place / "person.h5"]
    save_partial(files[0], found.partial)
    for name, design in verification.designs.items():
        path = place / f"{name.replace(' ', '-')}.wav"
        export_stimulus(design, path, rig=found.rig, confirmed=True)
        files += [path, sidecar_path(path)]
    about = _about(verification) | {
        "files": {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in files}
    }
    text = json.dumps(about, ensure_ascii=False, indent=2, allow_nan=False)
    write_bytes(place / "report.json", f"{text}\n".encode())
    with suppress(MissingExtraError):
        write_bytes(place / "report.pdf", plot.figure_content(_page(about, verification), "pdf"))
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
        "verdict": verification.words,
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


def _page(about: dict[str, Any], verification: Verification) -> Any:
    """Return a page that says the same."""
    sitting, focus = verification.found.sitting, about["focus"]
    left_out = [f"place {row.place}" for row in verification.found.rows if row.failures]
    sentences = (
        about["verdict"],
        f"Measured on {about['measured_on']} with {about['rig']}",
        f"Noise of the sensor: {about['noise_m_per_s2']:.2g} m/s² RMS.",
        *(f"{name.capitalize()}: {getattr(sitting, name) or 'not noted'}." for name in _NOTED),
        f"Each input swept twice from {SWEPT_HZ[0]:g} to {SWEPT_HZ[1]:g} Hz in {SWEEP_S:g} s, at "
        f"{1e3 * sitting.speed_m_per_s:g} mm/s.",
        f"An input is left out unless {'; '.join(RULES)}. Left out: "
        f"{', '.join(left_out) or 'none'}.",
        f"Solved from {focus['band_hz'][0]:.0f} to {focus['band_hz'][1]:.0f} Hz, beta "
        f"{focus['beta']:g}, effort {focus['median_effort_db']:.1f} dB (median). Quiet places are "
        f"those of {', '.join(focus['other_people'])}.",
        f"Levels are {_LEVELS}. Away from the target the mean of other people is predicted, and "
        "the range between them.",
        f"SHA-256 of person.h5: {about['files']['person.h5']}. "
        f"{', '.join(f'{name} {version}' for name, version in about['versions'].items())}.",
    )
    text = "\n".join(fill(sentence, _LETTERS) for sentence in sentences)
    with plot.style():
        figure = new_page(f"Output {sitting.output} of {sitting.person}: {about['state']}")
        figure.text(0.08, 0.94, text, fontsize=8, va="top", parse_math=False)
        inputs = [
            (f"{row.place}", f"{100 * row.coherent:.0f} %", " ".join(row.failures) or "accepted")
            for row in verification.found.rows
        ]
        draw_table(figure.add_axes((0.08, 0.04, 0.84, 0.46)), _INPUT_COLUMNS, inputs)
        if verification.checks:
            levels = [_level_row(check) for check in verification.checks]
            draw_table(figure.add_axes((0.08, 0.52, 0.84, 0.2)), _LEVEL_COLUMNS, levels)
    return figure


def _level_row(check: Check) -> tuple[str, ...]:
    levels = f"{check.measured_db:z.1f}", f"{check.predicted_db:z.1f}"
    rest = f"{check.low_db:.1f} to {check.high_db:.1f}", "", ""
    if isnan(check.low_db):
        rest = "", f"{check.nmse_db:.1f}", f"{1e3 * check.delay_s:z.2f}"
    numbers = (text.replace("-", "\u2212") for text in (*levels, *rest))
    return f"{check.output}", check.played, *numbers
