"""Waveforms: what one actuator plays.

A waveform is a frozen dataclass with fields from `skinsource.specs.fields`, and everything that
`Waveform` names.  To add one, write its class in a module of this package and name it in `COMMON`
or `MORE` of `skinsource.design.waveforms.catalog`.
"""

from skinsource.design.waveform import Waveform
from skinsource.design.waveforms.catalog import COMMON, KINDS, MORE, kinds
from skinsource.design.waveforms.periodic import PulseTrain, Saw, Square, Triangle
from skinsource.design.waveforms.pulses import CentredTap, DampedSine, Impulse, Noise, Tap
from skinsource.design.waveforms.samples import Drawn, Formula, Layers, Recording
from skinsource.design.waveforms.tones import (
    AmplitudeModulated,
    Chirp,
    FrequencyModulated,
    Glide,
    Tone,
)
from skinsource.design.waveforms.wavelet_train import WaveletTrain, frequency_sweep
from skinsource.design.waveforms.wavelets import Chirplet, Gabor, Morlet, Ricker

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
