"""Waveforms: what one actuator plays.

A waveform is a frozen dataclass with fields from `skinsource.specs.fields`, and everything that
`Waveform` names.  To add one, write its class in a module of this package and name it in `COMMON`
or `MORE`.
"""

from skinsource.design.waveform import Waveform
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

#: The eight kinds that a menu of waveforms shows at once, in its order.
COMMON: tuple[type[Waveform], ...] = (
    Tone,
    Chirp,
    Noise,
    Tap,
    Impulse,
    Gabor,
    WaveletTrain,
    Formula,
)
#: All other kinds, which the menu shows under "More".
MORE: tuple[type[Waveform], ...] = (
    Ricker,
    Morlet,
    Chirplet,
    CentredTap,
    Glide,
    DampedSine,
    Square,
    Saw,
    Triangle,
    PulseTrain,
    AmplitudeModulated,
    FrequencyModulated,
    Drawn,
    Recording,
    Layers,
)
#: Every kind of waveform.
KINDS: tuple[type[Waveform], ...] = (*COMMON, *MORE)


def kinds() -> tuple[type[Waveform], ...]:
    """Return every kind of waveform; a function, so that tests can add kinds.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(len(ss.waveforms.kinds()))
    23
    """
    return KINDS


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
