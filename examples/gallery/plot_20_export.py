"""
What will the sound card get?
=============================

An export writes a channel for each place, and a sidecar that says what its numbers mean. Read back,
the file holds the drive, scaled by the full scale that the sidecar states.
"""

import json
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import soundfile

import skinsource as ss

tones = [
    ss.track(7, ss.waveforms.Tone(100.0)),
    ss.track(12, ss.waveforms.Tone(200.0), onset_s=0.05),
]
design = ss.Design(limb="synthetic-1", inputs=tuple(tones))
ss.export_stimulus(design, "drive.wav", rate_hz=48000)

samples, rate_hz = soundfile.read("drive.wav")
sidecar = json.loads(Path("drive.wav.json").read_text("utf-8"))
figure, ax = plt.subplots(figsize=(7, 3))
ax.plot(np.arange(len(samples)) / rate_hz, samples)
ax.set(xlabel="time (s)", ylabel="sample")
print({key: sidecar[key] for key in ("rate_hz", "n_channels", "full_scale", "unit")})
