"""Recipes of what one actuator plays.

A waveform is a frozen dataclass with fields from `skinsource.fields`, and everything that
`Waveform` names.  To add one: write a file beside these, and name its class in `COMMON` or `MORE`
(`every_kind`).
"""

from skinsource.synthesis.waveform import Waveform
from skinsource.waveforms.amplitude_modulated import AmplitudeModulated
from skinsource.waveforms.centred_tap import CentredTap
from skinsource.waveforms.chirp import Chirp
from skinsource.waveforms.chirplet import Chirplet
from skinsource.waveforms.damped_sine import DampedSine
from skinsource.waveforms.drawn import Drawn
from skinsource.waveforms.every_kind import COMMON, KINDS, MORE, kinds
from skinsource.waveforms.formula import Formula
from skinsource.waveforms.frequency_modulated import FrequencyModulated
from skinsource.waveforms.frequency_sweep import frequency_sweep
from skinsource.waveforms.gabor import Gabor
from skinsource.waveforms.glide import Glide
from skinsource.waveforms.impulse import Impulse
from skinsource.waveforms.layers import Layers
from skinsource.waveforms.morlet import Morlet
from skinsource.waveforms.noise import Noise
from skinsource.waveforms.pulse_train import PulseTrain
from skinsource.waveforms.recording import Recording
from skinsource.waveforms.ricker import Ricker
from skinsource.waveforms.saw import Saw
from skinsource.waveforms.square import Square
from skinsource.waveforms.tap import Tap
from skinsource.waveforms.tone import Tone
from skinsource.waveforms.triangle import Triangle
from skinsource.waveforms.wavelet_train import WaveletTrain

__all__ = [
    "COMMON",
    "KINDS",
    "MORE",
    "AmplitudeModulated",
    "CentredTap",
    "Chirp",
    "Chirplet",
    "DampedSine",
    "Drawn",
    "Formula",
    "FrequencyModulated",
    "Gabor",
    "Glide",
    "Impulse",
    "Layers",
    "Morlet",
    "Noise",
    "PulseTrain",
    "Recording",
    "Ricker",
    "Saw",
    "Square",
    "Tap",
    "Tone",
    "Triangle",
    "Waveform",
    "WaveletTrain",
    "frequency_sweep",
    "kinds",
]
