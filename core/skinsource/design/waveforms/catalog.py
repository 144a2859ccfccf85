"""Every kind of waveform, in the order of the menu."""

from skinsource.design.waveform import Waveform, register_kinds
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
from skinsource.design.waveforms.wavelet_train import WaveletTrain
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
    """Return every kind of waveform; a function, so that tests can add kinds."""
    return KINDS


register_kinds(kinds)
