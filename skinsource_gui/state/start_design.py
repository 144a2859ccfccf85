"""What the first window shows."""

from skinsource.design.design import Design, track
from skinsource.design.waveforms import Tone


def start_design(limb: str) -> Design:
    """Design of the first window: a 100 Hz tone on the pad of digit II (input 7)."""
    return Design(limb=limb, inputs=(track(7, Tone(frequency_hz=100.0)),))
