"""Headless library of SkinSource studio: stimuli in, skin vibration out.

>>> import skinsource as ss
>>> limb = ss.load_limb("synthetic-1")
>>> tone = ss.sinusoid(100.0, 0.1)
>>> acceleration = ss.predict(limb, [tone], [7])
>>> acceleration.shape
(72, 3, 651)
"""

from skinsource.catalogue import available_limbs, load_limb
from skinsource.decibels import decibels
from skinsource.errors import SkinSourceError
from skinsource.limb import Limb, LimbMap
from skinsource.projection import project_axes
from skinsource.response import predict
from skinsource.signals import impulse, sinusoid, tap, white_noise, window
from skinsource.spectra import magnitude_spectrum, rms
from skinsource.surface import SurfaceOperator, surface_operator
from skinsource.version import __version__

__all__ = [
    "Limb",
    "LimbMap",
    "SkinSourceError",
    "SurfaceOperator",
    "__version__",
    "available_limbs",
    "decibels",
    "impulse",
    "load_limb",
    "magnitude_spectrum",
    "predict",
    "project_axes",
    "rms",
    "sinusoid",
    "surface_operator",
    "tap",
    "white_noise",
    "window",
]
