"""Every kind of waveform, in the order of the menu."""

from skinsource.synthesis.kind_registry import tell_kinds
from skinsource.synthesis.waveform import Waveform
from skinsource.waveforms.amplitude_modulated import AmplitudeModulated
from skinsource.waveforms.centred_tap import CentredTap
from skinsource.waveforms.chirp import Chirp
from skinsource.waveforms.chirplet import Chirplet
from skinsource.waveforms.damped_sine import DampedSine
from skinsource.waveforms.drawn import Drawn
from skinsource.waveforms.formula import Formula
from skinsource.waveforms.frequency_modulated import FrequencyModulated
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

#: The eight kinds that a menu of waveforms shows at once, in the order in which a user meets them.
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
#: All others, which it shows under "More".
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
    """Every kind of waveform that there is now; whoever needs them asks when he does."""
    return KINDS


tell_kinds(kinds)
