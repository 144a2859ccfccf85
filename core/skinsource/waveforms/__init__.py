"""Recipes of what one actuator plays.

A waveform is a frozen dataclass with fields from `skinsource.fields`, a ``title``, and a method
``samples(sample_rate_hz)`` that returns the drive, (n,), of peak 1.  To add one: write a file
beside these, and name its class in `KINDS`.
"""

from skinsource.waveforms.impulse import Impulse
from skinsource.waveforms.noise import Noise
from skinsource.waveforms.tap import Tap
from skinsource.waveforms.tone import Tone

Waveform = Tone | Tap | Impulse | Noise

#: Every kind of waveform, in the order in which a user meets them.
KINDS: tuple[type[Waveform], ...] = (Tone, Tap, Impulse, Noise)

__all__ = ["KINDS", "Impulse", "Noise", "Tap", "Tone", "Waveform"]
