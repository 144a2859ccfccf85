"""The design, the view and the arrangement that the tests save."""

from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone

DESIGN = Design(
    limb="measured-1",
    inputs=(
        track(location=7, waveform=Tone(frequency_hz=123.456), amplitude=-0.1, solo=True, id=5),
        track(location=20, waveform=Noise(seed=9, window="hanning"), onset_s=0.1, colour=3),
        track(location=1, waveform=Tap(), muted=True, colour=1),
    ),
    scaling="relative",
    title="Größe → 触覚",
    author="Somebody",
    notes="First line\nsecond line",
    licence="CC0",
)
VIEW = View(
    outputs=(72, 1), selected_inputs=(5,), panels=(("skin", (("map_range_db", (-60.5, -10.0)),)),)
)
LAYOUT = b"\0arrangement\0\xff\0"
