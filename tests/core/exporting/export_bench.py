"""An export as WAV, and what was written."""

import json

import soundfile

import skinsource as ss


def sidecar(path):
    return json.loads(path.with_name(f"{path.name}.json").read_text(encoding="utf-8"))


def exported(design, path, **options):
    return ss.export_stimulus(design, path, "wav", 8000, options=ss.StimulusOptions(**options))


def read(path):
    return soundfile.read(path, always_2d=True)[0].T
