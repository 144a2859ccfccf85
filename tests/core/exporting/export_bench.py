"""Exports, what they go through, and what was written."""

import csv
import json

import soundfile

import skinsource as ss


def commented(path):
    """Lines about the content, names of the columns, and rows of texts of a table."""
    lines = path.read_text("utf-8").splitlines()
    about = [line.removeprefix("# ") for line in lines if line.startswith("#")]
    names, *rows = csv.reader(line for line in lines if not line.startswith("#"))
    return about, names, rows


def sidecar(path):
    return json.loads(path.with_name(f"{path.name}.json").read_text(encoding="utf-8"))


def exported(design, path, **options):
    return ss.export_stimulus(design, path, "wav", 8000, options=ss.StimulusOptions(**options))


def actuation(model, equaliser=None, **changes):
    """An actuator at all places."""
    at = ss.ActuatorAt(actuator="mine", model=model)
    return ss.Actuation(actuators=(at,), equaliser=equaliser, **changes)


def read(path):
    return soundfile.read(path, always_2d=True)[0].T
