"""Recipes of what one actuator plays.

A waveform is a frozen dataclass with fields from `skinsource.fields`, and everything that
`Waveform` names.  To add one: write a file beside these, and name its class in `KINDS`.
"""

from skinsource.waveforms.amplitude_modulated import AmplitudeModulated
from skinsource.waveforms.chirp import Chirp
from skinsource.waveforms.damped_sine import DampedSine
from skinsource.waveforms.drawn import Drawn
from skinsource.waveforms.frequency_modulated import FrequencyModulated
from skinsource.waveforms.impulse import Impulse
from skinsource.waveforms.noise import Noise
from skinsource.waveforms.pulse_train import PulseTrain
from skinsource.waveforms.recording import Recording
from skinsource.waveforms.saw import Saw
from skinsource.waveforms.square import Square
from skinsource.waveforms.tap import Tap
from skinsource.waveforms.tone import Tone
from skinsource.waveforms.triangle import Triangle
from skinsource.waveforms.waveform import Waveform

#: Every kind of waveform, in the order in which a user meets them.
KINDS: tuple[type[Waveform], ...] = (
    Tone,
    Tap,
    Impulse,
    Noise,
    Chirp,
    DampedSine,
    Square,
    Saw,
    Triangle,
    PulseTrain,
    AmplitudeModulated,
    FrequencyModulated,
    Drawn,
    Recording,
)


def kinds() -> tuple[type[Waveform], ...]:
    """Every kind of waveform that there is now; whoever needs them asks when he does."""
    return KINDS


__all__ = [
    "KINDS",
    "AmplitudeModulated",
    "Chirp",
    "DampedSine",
    "Drawn",
    "FrequencyModulated",
    "Impulse",
    "Noise",
    "PulseTrain",
    "Recording",
    "Saw",
    "Square",
    "Tap",
    "Tone",
    "Triangle",
    "Waveform",
    "kinds",
]
