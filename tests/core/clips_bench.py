"""What the tests of clips share."""

import numpy as np

from skinsource.design.clips import Clip
from skinsource.design.effects.playing import played
from skinsource.design.signal_path import placed_signal_path


def total(*clips: Clip, rate_hz: float = 1300.0, n_times: int = 5000) -> np.ndarray:
    """What clips play together, from time 0 on, by the chain of their track."""
    first, chain = placed_signal_path(clips, (), rate_hz)
    samples = np.zeros(n_times)
    for part in chain.parts:
        piece = played(part.waveform, part.effects, rate_hz, part.shift_s)
        samples[first + part.start :][: piece.size] += part.gain * piece
    return samples
