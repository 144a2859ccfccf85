"""The sidecar of an exported file: JSON that says what its numbers mean."""

import json
from collections.abc import Sequence
from typing import Any

import numpy as np
import scipy

from skinsource.actuators.actuation import Actuation
from skinsource.base.decibels import decibels
from skinsource.base.errors import SkinSourceError
from skinsource.design.design import Design, Input
from skinsource.design.labels import label_of, scalings_on
from skinsource.design.view import View
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.stimulus import Stimulus
from skinsource.export.formats.format import Facts, Outgoing, about
from skinsource.export.stimulus_export.options import about_channels, about_equaliser, edges_text
from skinsource.export.stimulus_export.preparing import (
    PreparedStimulus,
    clipped_samples,
    equalised_of,
    loses_of,
)
from skinsource.limbs.own_limbs import drive_unit_known
from skinsource.version import __version__


def about_validity(design: Design) -> dict[str, Any]:
    """Return the note on the limb, and the conditions of the measurement with state and sentence.

    Both are empty where the limb is not installed: a stimulus can be exported without it.
    """
    try:
        results = new_graph().evaluate({"limb_data", "validity"}, sources(design, View()))
    except SkinSourceError:
        return {"limb_note": None, "validity": []}
    conditions = [
        {"condition": finding.name, "state": finding.state, "sentence": finding.sentence}
        for finding in results["validity"]
    ]
    return {"limb_note": results["limb_data"].note or None, "validity": conditions}


#: Errors of `skinsource.resample` within the band are at most these.
_RESAMPLING = {"gain_db": 0.001, "phase_rad": 1e-6, "aliases_db": -115.0}
_MEANING = (
    "samples times full_scale are the drive: amplitude times gain times waveform, in the unit"
)
_UPSTREAM = (
    "Under this scaling an amplitude is a peak on the skin, computed for each input by itself: the "
    "drives have no unit, and strong and weak channels do not keep the ratio that was predicted."
)


def sidecar_of(
    ready: PreparedStimulus,
    outgoing: Outgoing,
    facts: Facts,
    *,
    sha256: str | None,
    n_bytes: int,
    confirmed: Sequence[str],
) -> bytes:
    """Return the sidecar of one file, as JSON.

    Parameters
    ----------
    ready, outgoing
        The whole export, and the content of this file.
    facts
        Facts that the format returned.
    sha256, n_bytes
        Digest of the file, None for a folder; bytes of the file or folder.
    confirmed
        Objections that were confirmed.
    """
    stimulus = outgoing.stimulus
    counts = facts.get("clipped_samples")
    if counts is None:
        counts = (clipped_samples(stimulus) * ready.format.to_device).tolist()
    content: dict[str, Any] = {
        "what": "SkinSource stimulus",
        "file": outgoing.name,
        "format": ready.format.name,
        "choices": dict(outgoing.choices),
        "sha256": sha256,
        "bytes": n_bytes,
        **about(outgoing),
        "n_channels": len(stimulus.channels),
        "n_times": stimulus.n_times,
        "duration_s": stimulus.duration_s,
        **_about_rig(ready, stimulus, _channels(stimulus, counts)),
        "equalised": equalised_of(ready),
        "inputs": [_about_input(track) for track in outgoing.design.inputs],
        "gain": ready.gain,
        "meaning": _MEANING,
        "scaling_means": _scaling_sentence(outgoing.design),
        "predicted_through": _about_prediction(outgoing.design.actuated),
        **about_validity(outgoing.design),
        "clip_count": int(sum(counts)),
        "confirmed": list(confirmed),
        "edges": edges_text([stimulus], ready.cut),
        "errors": _errors(stimulus, facts),
        "loses": loses_of(ready, outgoing),
        "versions": versions(),
        **{name: value for name, value in facts.items() if name != "clipped_samples"},
    }
    if stimulus.scaling == "upstream":
        content["note"] = _UPSTREAM
    return (json.dumps(content, ensure_ascii=False, indent=2, allow_nan=False) + "\n").encode()


def _about_rig(
    ready: PreparedStimulus, stimulus: Stimulus, channels: list[dict[str, Any]]
) -> dict[str, Any]:
    """Return the channels with their wiring, the rig, the actuators and the equaliser."""
    wiring = about_channels(stimulus, ready.rig) if ready.rig is not None else []
    for channel, wires in zip(channels, wiring, strict=False):
        channel.update(wires)
    actuators = [wires.get("actuator") for wires in wiring]
    if ready.rig is None and ready.equaliser is not None and ready.actuation is not None:
        actuators = [
            None if channel.place is None else ready.actuation.at(channel.place).actuator
            for channel in stimulus.channels
        ]
    return {
        "channels": channels,
        "rig": None if ready.rig is None else ready.rig.title,
        "actuator": actuators or None,
        "equaliser": about_equaliser(ready.equaliser),
    }


def _scaling_sentence(design: Design) -> str:
    # Predicted through actuators, amplitudes are drives of these, whatever the limb was driven by.
    known = design.actuated is not None or drive_unit_known(design.limb, design.limb_digest)
    return label_of(scalings_on(drive_unit_known=known), design.scaling).sentence


def _about_prediction(actuated: Actuation | None) -> dict[str, Any] | None:
    """Return the actuators and the equaliser that the design is predicted through."""
    if actuated is None:
        return None
    return {
        "rig": actuated.rig or None,
        "actuators": [
            {"place": actuator.place, "actuator": actuator.actuator, "model": actuator.model.title}
            for actuator in actuated.actuators
        ],
        "equaliser": about_equaliser(actuated.equaliser),
    }


def _channels(stimulus: Stimulus, counts: Sequence[int]) -> list[dict[str, Any]]:
    described = []
    for channel, samples, count in zip(stimulus.channels, stimulus.samples, counts, strict=True):
        peak = float(np.abs(samples).max(initial=0.0))
        described.append(
            {
                "number": channel.number,
                "place": channel.place,
                "title": channel.title,
                "inputs": list(channel.inputs),
                "unit": stimulus.unit if channel.place is not None else "full scale",
                "peak_of_full_scale": peak,
                "rms_of_full_scale": float(np.sqrt(np.mean(samples**2))),
                "clip_count": int(count),
            }
        )
    return described


def _about_input(track: Input) -> dict[str, Any]:
    return {
        "number": track.id,
        "place": track.location,
        "amplitude": track.amplitude,
        "gain_curve": [list(point) for point in track.gain_curve],
        "clips": [
            {"number": clip.id, "onset_s": clip.onset_s, "gain": clip.gain, "muted": clip.muted}
            for clip in track.clips
        ],
    }


def _errors(stimulus: Stimulus, facts: Facts) -> dict[str, Any]:
    """Return bounds of the difference between the written and the predicted drive."""
    errors: dict[str, Any] = {"band_hz": list(stimulus.band_hz)}
    if stimulus.sample_rate_hz != stimulus.own_rate_hz:
        errors["resampling_at_most"] = dict(_RESAMPLING)
        errors["edges"] = (
            "what sounds at the first or last sample rings there for up to 0.1 s, and what rings "
            "outside is cut off"
        )
    rounding = facts.get("largest_rounding_error")
    if rounding is not None:
        errors["rounding_of_full_scale"] = rounding
        errors["rounding_db"] = float(decibels(np.array([rounding]))[0]) if rounding else None
    return errors


def versions() -> dict[str, str]:
    """Return the versions of this program and of its numerical libraries."""
    return {"skinsource": __version__, "numpy": np.__version__, "scipy": scipy.__version__}
