"""Recipes of what one actuator plays.

A waveform is a frozen dataclass with fields from `skinsource.fields`, and everything that
`Waveform` names.  To add one: write a file beside these, and name its class in `KINDS`.
"""

from skinsource.waveforms.impulse import Impulse
from skinsource.waveforms.noise import Noise
from skinsource.waveforms.tap import Tap
from skinsource.waveforms.tone import Tone
from skinsource.waveforms.waveform import Waveform

#: Every kind of waveform, in the order in which a user meets them.
KINDS: tuple[type[Waveform], ...] = (Tone, Tap, Impulse, Noise)


def kinds() -> tuple[type[Waveform], ...]:
    """Every kind of waveform that there is now; whoever needs them asks when he does."""
    return KINDS


__all__ = ["KINDS", "Impulse", "Noise", "Tap", "Tone", "Waveform", "kinds"]
