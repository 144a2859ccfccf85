"""
Which drives play my own waveform on the skin?
==============================================

Output 30 is to do a burst of 100 Hz. ``reproduce`` finds what the inputs must play, so that the
skin there does just that, and says how far it is from what was wanted.
"""

import matplotlib.pyplot as plt
import numpy as np

import skinsource as ss

wanted = ss.sinusoid(100.0, 0.1, window_name="hanning")
found = ss.inverse.reproduce("synthetic-1", {30: wanted}, quiet=[1, 10, 19])
design = found.design()
view = ss.View(axes="z", outputs=(30,))
trace = ss.result(design, "selected_traces", view=view)

figure, ax = plt.subplots(figsize=(7, 3))
ax.plot(np.arange(wanted.size) / 1300 + found.delay_s, wanted, lw=4, alpha=0.4, label="wanted")
ax.plot(trace.axes["n_times"], trace.values[0], label="predicted at output 30")
ax.set(xlabel="time (s)", ylabel="m/s²")
ax.legend()
print(f"error {found.nmse_db[30]:.1f} dB re what was wanted")
