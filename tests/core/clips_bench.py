"""What the tests of edits of clips share: a design of four tracks, and what it plays."""

import numpy as np
from hypothesis import strategies as st

from skinsource.design.clips import Clip, Marker
from skinsource.design.design import Design, Input, track
from skinsource.design.effects.playing import played
from skinsource.design.signal_path import placed_signal_path
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone

RATE_HZ = 1300.0
TONE = Tone(frequency_hz=77.0, duration_s=0.2)
#: Two clips on each of two tracks, one on a third, none on a fourth.
DESIGN = Design(
    limb="synthetic-1",
    inputs=(
        Input(
            location=7,
            clips=(
                Clip(waveform=TONE, onset_s=0.1),
                Clip(waveform=Noise(seed=1), onset_s=0.25, gain=-0.5, label="wind"),
            ),
        ),
        Input(
            location=2,
            clips=(Clip(waveform=Tap()), Clip(waveform=TONE, onset_s=0.5, muted=True)),
            colour=1,
            gain_curve=((0.0, 1.0), (1.0, 0.0)),
        ),
        track(11, Tone(duration_s=0.4), onset_s=0.3, colour=2, amplitude=0.25),
        Input(location=12, colour=3),
    ),
    markers=(Marker(time_s=0.05, name="first"), Marker(time_s=0.4), Marker(time_s=0.9)),
    loop_s=(0.1, 0.6),
)
VIEW = View(selected_inputs=(1,), selected_clips=(2,))
times = st.integers(0, 700).map(lambda k: k / 1000)
some_ids = st.lists(st.integers(1, 5), min_size=1, max_size=5, unique=True).map(tuple)


def total(design: Design, place: int) -> np.ndarray:
    """What a track plays from time 0 on, without its curve."""
    first, chain = placed_signal_path(design.inputs[place].clips, (), RATE_HZ)
    samples = np.zeros(5000)
    for part in chain.parts:
        piece = played(part.waveform, part.effects, RATE_HZ, part.shift_s)
        samples[first + part.start :][: piece.size] += part.gain * piece
    return samples


def onsets(design: Design) -> list[float]:
    return [clip.onset_s for clip in design.clips]


def tracks(design: Design) -> list[list[int]]:
    return [[clip.id for clip in track.clips] for track in design.inputs]
