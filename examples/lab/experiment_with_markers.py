"""Play two stimuli in random order at known times, with a trigger output and LSL markers.

python experiment_with_markers.py            needs the extras audio and lsl, and a sound card
"""

import time

import numpy as np

import skinsource as ss


def stimulus(frequency_hz: float) -> ss.Design:
    """Return a tone at the tip of the index finger."""
    tone = ss.waveforms.Tone(frequency_hz=frequency_hz, duration_s=0.2)
    return ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone, amplitude=0.5),))


markers = ss.Markers("Vibrations")
trials = [(1, 60.0), (2, 250.0)] * 2
for code, frequency_hz in np.random.default_rng(1).permutation(trials):
    with ss.Player(stimulus(frequency_hz), trigger_output=2, began=markers) as player:
        playback = player.play(at=time.monotonic() + 0.3, clock="monotonic", code=int(code))
        playback.wait()
        print(
            f"{frequency_hz:g} Hz, onset {playback.onset_is}, {playback.late_s * 1e3:.1f} ms late"
        )
