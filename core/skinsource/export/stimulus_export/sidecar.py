"""The sidecar of an exported file: JSON that says what its numbers mean, and nothing else does."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.actuators.actuation import Actuation, Model
from skinsource.actuators.equalising import Equaliser
from skinsource.base.decibels import decibels
from skinsource.base.errors import SkinSourceError, lowered
from skinsource.base.job import Stop, never
from skinsource.design.amplitudes import amplitude_meaning, amplitude_unit
from skinsource.design.comparing import RANGE_BETWEEN_PEOPLE
from skinsource.design.design import Design, Input, View
from skinsource.design.labels import label_of, level_label, scalings_on, signal_label
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.stimulus import FULL_SCALE_UNIT, Stimulus, added_delays_s, channel_of
from skinsource.export.exported_design import versions
from skinsource.export.formats.format import Facts
from skinsource.export.stimulus_export.preparing import PreparedStimulus, actuator_at
from skinsource.limbs.own_limbs import axes_on, drive_unit_known
from skinsource.people.ranges import levels, people_like
from skinsource.specs.models import specs_of


def sidecar_path(path: Path) -> Path:
    """Return the path of the sidecar of a file or folder."""
    return path.with_name(f"{path.name}.json")


#: Errors of `skinsource.resample` within the band are at most these.
_RESAMPLING = {"gain_db": 0.001, "phase_rad": 1e-6, "aliases_db": -115.0}
_UPSTREAM = (
    "Under this scaling an amplitude is a peak on the skin, computed for each input by itself: the "
    "drives have no unit, and strong and weak channels do not keep the ratio that was predicted."
)


def sidecar_of(
    ready: PreparedStimulus,
    facts: Facts,
    *,
    sha256: str | None,
    n_bytes: int,
    confirmed: Sequence[str],
) -> bytes:
    """Return the sidecar of one file, as JSON.

    Parameters
    ----------
    ready
        The export, with this file alone.
    facts
        Facts that the format returned.
    sha256, n_bytes
        Digest of the file, None for a folder; bytes of the file or folder.
    confirmed
        Objections that were confirmed.
    """
    (file,) = ready.files
    stimulus, design = file.stimulus, file.design
    known = drive_unit_known(design.limb, design.limb_digest)
    means = label_of(scalings_on(drive_unit_known=known), design.scaling).sentence
    if design.actuated is not None:
        # Then amplitudes are drives of these, whatever the limb was driven by.
        means = (
            f"An amplitude is {lowered(amplitude_meaning(design))}, in {amplitude_unit(design)}."
        )
    counts = facts.get("clipped_samples", [channel.clipped for channel in file.channels])
    content: dict[str, Any] = {
        "what": "SkinSource stimulus",
        "file": file.name,
        "format": ready.format.name,
        "choices": dict(file.choices),
        "sha256": sha256,
        "bytes": n_bytes,
        **file.about,
        "n_channels": len(stimulus.channels),
        "n_times": file.sent.n_times,
        "duration_s": file.sent.duration_s,
        "lead_in_s": ready.lead_in_s,
        "tail_s": ready.tail_s,
        "channels": [
            {
                "number": overview.channel.number,
                "place": overview.channel.place,
                "title": overview.channel.title,
                "inputs": list(overview.channel.inputs),
                "unit": stimulus.unit if overview.channel.place is not None else "full scale",
                "peak_of_full_scale": overview.peak,
                "rms_of_full_scale": overview.rms,
                "clip_count": clip_count,
                **_wiring(ready, stimulus, row),
            }
            for row, (overview, clip_count) in enumerate(zip(file.channels, counts, strict=True))
        ],
        "rig": None if ready.rig is None else ready.rig.title,
        "actuator": _actuators(ready, stimulus),
        "equaliser": ready.equaliser and _about_model(ready.equaliser),
        "equalised": ready.equalised,
        "inputs": [_about_input(track) for track in design.inputs],
        "gain": ready.gain,
        "meaning": _meaning(ready, stimulus.unit, facts),
        "scaling_means": means,
        "predicted_through": _about_prediction(ready, design.actuated),
        **about_validity(design, file.stop),
        **(about_range(design) if ready.people else {}),
        "clip_count": int(sum(counts)),
        "confirmed": list(confirmed),
        "edges": ready.edges,
        "errors": _errors(stimulus, facts) if ready.format.plays_waveform else {},
        "loses": ready.loses,
        "versions": versions(),
        **{name: value for name, value in facts.items() if name != "clipped_samples"},
    }
    if stimulus.scaling == "upstream":
        content["note"] = _UPSTREAM
    return (json.dumps(content, ensure_ascii=False, indent=2, allow_nan=False) + "\n").encode()


def about_validity(design: Design, stop: Stop = never) -> dict[str, Any]:
    """Return the note on the limb, and the conditions of the measurement with state and sentence.

    Both are empty where the limb is not installed: a stimulus can be exported without it.
    """
    try:
        results = new_graph().evaluate(
            {"limb_data", "validity"}, sources(design, View()), stop=stop
        )
    except SkinSourceError:
        return {"limb_note": None, "validity": []}
    view = View(axes=axes_on(design.limb, View().axes))
    of_levels = f" Levels: {level_label(view.span)}, {signal_label(view.axes, view.method)}."
    conditions = [
        {
            "condition": finding.name,
            "state": finding.state,
            "sentence": f"{finding.sentence}{of_levels * bool(finding.outputs)}",
        }
        for finding in results["validity"]
    ]
    return {"limb_note": results["limb_data"].note or None, "validity": conditions}


def about_range(design: Design) -> dict[str, Any]:
    """Return what levels to expect of people who were not measured.

    Raises
    ------
    InvalidInputError
        The limb is no published one.
    DatasetMissingError
        It is a measured one, and the measured dataset is not installed.
    """
    view = View()
    found = levels(design, view, limbs=people_like(design.limb))
    return {
        "range_between_people": {
            "means": RANGE_BETWEEN_PEOPLE,
            "people": list(found.names),
            "levels": f"{level_label(view.span)}, {signal_label(view.axes, view.method)}",
            "mean_db": found.mean_db.tolist(),
            "low_db": found.low_db.tolist(),
            "high_db": found.high_db.tolist(),
        }
    }


def _wiring(ready: PreparedStimulus, stimulus: Stimulus, row: int) -> dict[str, Any]:
    """Return how a channel is wired; empty where no rig says so, or it drives no actuator."""
    if ready.rig is None or stimulus.channels[row].place is None:
        return {}
    channel = channel_of(stimulus, row, ready.rig)
    return {
        "actuator": channel.actuator,
        "device": channel.device,
        "output": channel.output,
        "full_scale_v": channel.full_scale_v,
        "amplifier_gain": channel.amplifier_gain,
        "polarity": channel.polarity,
        "delay_s": channel.delay_s,
        "delay_added_s": added_delays_s(stimulus, ready.rig)[row],
        "measured_on": channel.measured_on,
    }


def _actuators(ready: PreparedStimulus, stimulus: Stimulus) -> list[dict[str, Any]] | None:
    """Return the actuators that the channels are made for, with all parameters; None: not known."""
    found: dict[tuple[str, Model | None], set[int]] = {}
    for channel in stimulus.channels:
        if channel.place is not None:
            known = actuator_at(channel.place, ready.rig, ready.actuation)
            found.setdefault(known, set()).add(channel.place)
    found.pop(("", None), None)
    return [
        {"name": name, "places": sorted(places), **_about_model(model)}
        for (name, model), places in found.items()
    ] or None


def _about_model(model: Model | Equaliser | None) -> dict[str, Any]:
    """Return kind and numbers of an actuator or equaliser; the kind is None where not known."""
    if model is None:
        return {"kind": None}
    values = {name: getattr(model, name) for name in specs_of(model)}
    return {"kind": type(model).__name__, **values}


def _meaning(ready: PreparedStimulus, unit: str, facts: Facts) -> str:
    """Return what the numbers in the file are."""
    values, scale, drive = ready.format.numbers, "full_scale", "amplitude times gain times waveform"
    if full_scale := facts.get("integer_full_scale"):
        values += f" minus {facts['integer_zero']}," * bool(facts["integer_zero"])
        values += f" divided by {full_scale} and"
    drive += ", in m/s²" if ready.equaliser is not None else ", in the unit"
    if unit == FULL_SCALE_UNIT:
        scale = "full_scale_v and amplifier_gain of the channel, with its polarity,"
        drive = drive.replace("the unit", "V")
    what = "the drive"
    if ready.equaliser is not None:
        what = "volts, by which the actuator follows the drive as far as the equaliser lets it"
    elif not ready.format.plays_waveform:
        what = "amplitudes of sines that are as strong as the drive, up to full scale"
    return f"{values} times {scale} are {what}: {drive}"


def _about_prediction(ready: PreparedStimulus, actuated: Actuation | None) -> Any:
    """Return what the design is predicted through, where that is not what is written for."""
    if actuated is None:
        return None
    equaliser = actuated.equaliser
    places = {channel.place for channel in ready.drives.channels if channel.place is not None}
    if equaliser == ready.equaliser and all(
        actuator_at(place, None, actuated)[1] == actuator_at(place, ready.rig, ready.actuation)[1]
        for place in places
    ):
        return "the same"
    return {
        "rig": actuated.rig or None,
        "actuators": [
            {"place": at.place, "actuator": at.actuator, **_about_model(at.model)}
            for at in actuated.actuators
        ],
        "equaliser": equaliser and _about_model(equaliser),
    }


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
