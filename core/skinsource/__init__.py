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

from typing import TYPE_CHECKING

from skinsource.decibels import decibels  # its module has the same name
from skinsource.errors import SkinSourceError
from skinsource.late import late_names
from skinsource.version import __version__

if TYPE_CHECKING:
    from skinsource import (
        actuators,
        edits,
        effects,
        equalising,
        matching,
        measuring,
        motions,
        perception,
        plot,
        recordings,
        rig_measuring,
        rigs,
        scenes,
        sweeps,
        waveforms,
    )
    from skinsource.analysis import Extent, extent, windowed_rms
    from skinsource.catalogue import available_limbs, load_limb
    from skinsource.chain import Actuation, ActuatorAt, actuation_of_rig
    from skinsource.clips import Clip, Marker
    from skinsource.design import Design, Input, track
    from skinsource.design_file import open_design, save_design
    from skinsource.evaluation import evaluate
    from skinsource.limb import Limb, LimbMap
    from skinsource.projection import project_axes
    from skinsource.resampling import resample
    from skinsource.response import predict
    from skinsource.rigs import open_rig, save_rig
    from skinsource.signals import impulse, sinusoid, tap, white_noise, window
    from skinsource.spectra import magnitude_spectrum, peak_hold_spectrum, rms
    from skinsource.stimulus import Stimulus, stimulus_of
    from skinsource.stimulus_export import StimulusOptions, export_stimulus
    from skinsource.stimulus_formats import export_formats
    from skinsource.surface import SurfaceOperator, surface_operator
    from skinsource.sweeps import sweep
    from skinsource.view import View
else:
    __getattr__, __dir__ = late_names(
        __name__,
        {
            "analysis": "Extent extent windowed_rms",
            "catalogue": "available_limbs load_limb",
            "chain": "Actuation ActuatorAt actuation_of_rig",
            "clips": "Clip Marker",
            "design": "Design Input track",
            "design_file": "open_design save_design",
            "evaluation": "evaluate",
            "limb": "Limb LimbMap",
            "projection": "project_axes",
            "resampling": "resample",
            "response": "predict",
            "rigs": "open_rig save_rig",
            "signals": "impulse sinusoid tap white_noise window",
            "spectra": "magnitude_spectrum peak_hold_spectrum rms",
            "stimulus": "Stimulus stimulus_of",
            "stimulus_export": "StimulusOptions export_stimulus",
            "stimulus_formats": "export_formats",
            "surface": "SurfaceOperator surface_operator",
            "sweeps": "sweep",
            "view": "View",
        },
        packages=(
            "actuators",
            "edits",
            "effects",
            "equalising",
            "matching",
            "measuring",
            "motions",
            "perception",
            "plot",
            "recordings",
            "rig_measuring",
            "rigs",
            "scenes",
            "sweeps",
            "waveforms",
        ),
    )

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
    "rig_measuring",
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
