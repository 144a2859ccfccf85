"""Headless library of SkinSource studio: stimuli in, skin vibration out.

>>> import skinsource as ss
>>> limb = ss.load_limb("synthetic-1")
>>> tone = ss.sinusoid(100.0, 0.1)
>>> acceleration = ss.predict(limb, [tone], [7])
>>> acceleration.shape
(72, 3, 651)

Or with a design, as the studio has it and saves it:

>>> one = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
>>> design = ss.Design(limb="synthetic-1", inputs=(one,))
>>> ss.evaluate(design, "output_levels_db")["output_levels_db"].shape
(72,)
"""

import importlib
from typing import TYPE_CHECKING

from skinsource import edits, effects, motions, waveforms
from skinsource.analysis import Extent, extent, windowed_rms
from skinsource.catalogue import available_limbs, load_limb
from skinsource.chain import Actuation, ActuatorAt, actuation_of_rig
from skinsource.clips import Clip, Marker
from skinsource.decibels import decibels
from skinsource.design import Design, Input, track
from skinsource.design_file import open_design, save_design
from skinsource.errors import SkinSourceError
from skinsource.evaluation import evaluate
from skinsource.limb import Limb, LimbMap
from skinsource.projection import project_axes
from skinsource.quoting import quoted
from skinsource.resampling import resample
from skinsource.response import predict
from skinsource.signals import impulse, sinusoid, tap, white_noise, window
from skinsource.spectra import magnitude_spectrum, peak_hold_spectrum, rms
from skinsource.surface import SurfaceOperator, surface_operator
from skinsource.version import __version__
from skinsource.view import View

if TYPE_CHECKING:
    from skinsource import (
        actuators,
        equalising,
        matching,
        measuring,
        perception,
        plot,
        recordings,
        rigs,
        scenes,
        sweeps,
    )
    from skinsource.rigs import open_rig, save_rig
    from skinsource.stimulus import Stimulus, stimulus_of
    from skinsource.stimulus_export import StimulusOptions, export_stimulus
    from skinsource.stimulus_formats import export_formats
    from skinsource.sweeps import sweep

__all__ = [
    "Actuation",
    "ActuatorAt",
    "Clip",
    "Design",
    "Extent",
    "Input",
    "Limb",
    "LimbMap",
    "Marker",
    "SkinSourceError",
    "Stimulus",
    "StimulusOptions",
    "SurfaceOperator",
    "View",
    "__version__",
    "actuation_of_rig",
    "actuators",
    "available_limbs",
    "decibels",
    "edits",
    "effects",
    "equalising",
    "evaluate",
    "export_formats",
    "export_stimulus",
    "extent",
    "impulse",
    "load_limb",
    "magnitude_spectrum",
    "matching",
    "measuring",
    "motions",
    "open_design",
    "open_rig",
    "peak_hold_spectrum",
    "perception",
    "plot",
    "predict",
    "project_axes",
    "recordings",
    "resample",
    "rigs",
    "rms",
    "save_design",
    "save_rig",
    "scenes",
    "sinusoid",
    "stimulus_of",
    "surface_operator",
    "sweep",
    "sweeps",
    "tap",
    "track",
    "waveforms",
    "white_noise",
    "window",
    "windowed_rms",
]


# What few scripts need is imported when it is first asked for: packages, and names of theirs.
_PACKAGES = (
    "actuators",
    "equalising",
    "matching",
    "measuring",
    "perception",
    "plot",
    "recordings",
    "rig_measuring",
    "rigs",
    "scenes",
    "sweeps",
)
_NAMES = {
    "Stimulus": "stimulus",
    "StimulusOptions": "stimulus_export",
    "export_formats": "stimulus_formats",
    "export_stimulus": "stimulus_export",
    "open_rig": "rigs",
    "save_rig": "rigs",
    "stimulus_of": "stimulus",
    "sweep": "sweeps",
}


def __getattr__(name: str) -> object:
    if name in _PACKAGES:
        return importlib.import_module(f"skinsource.{name}")
    if name in _NAMES:
        return getattr(importlib.import_module(f"skinsource.{_NAMES[name]}"), name)
    raise AttributeError(f"module 'skinsource' has no attribute {quoted(name)}")
