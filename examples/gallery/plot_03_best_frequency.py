"""
At which frequency does an output move most?
============================================

Only the tone of the second input changes from step to step, so only what follows from it is
computed again. The level is that of output 29, over its loudest 100 ms.
"""

import matplotlib.pyplot as plt
import numpy as np

import skinsource as ss

tap = ss.track(13, ss.waveforms.Tap(), amplitude=0.1)
design = ss.Design(limb="synthetic-1", inputs=(tap, ss.track(7)))
frequencies_hz = np.geomspace(30.0, 500.0, 25)
steps = [
    design.with_clip(2, waveform=ss.waveforms.Tone(frequency_hz=float(f))) for f in frequencies_hz
]
levels_db = [ss.result(step, view=ss.View(span="loudest")).values[29 - 1] for step in steps]

figure, ax = plt.subplots(figsize=(6, 3.5))
ax.semilogx(frequencies_hz, levels_db, marker="o")
ax.set(xlabel="frequency (Hz)", ylabel="level of output 29 (dB re 1 m/s²)")
print(f"most at {frequencies_hz[np.argmax(levels_db)]:.0f} Hz")
