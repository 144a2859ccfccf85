"""
How different is it on another person's hand?
=============================================

The same design is predicted for four hands, the short lines. The bars are the range between people:
where the level of a person who was not measured is to be expected. It is no confidence band.
"""

import matplotlib.pyplot as plt
import numpy as np

import skinsource as ss

limbs = [f"synthetic-{number}" for number in range(1, 5)]
tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)
design = ss.Design(limb=limbs[0], inputs=(ss.track(7, tone),))
found = ss.people.levels(design, limbs=limbs)

outputs = np.array([28, 29, 30, 33, 38, 52])
mean_db, half_db = found.mean_db[outputs - 1], (found.high_db - found.low_db)[outputs - 1] / 2
figure, ax = plt.subplots(figsize=(6, 3.5))
ax.errorbar(range(6), mean_db, half_db, fmt="o", capsize=5)
ax.plot(range(6), found.people_db[:, outputs - 1].T, "_", color="grey")
ax.set(xlabel="output", ylabel="level (dB re 1 m/s²)", xticks=range(6), xticklabels=outputs)
print(f"output 52: {mean_db[-1]:.1f} dB re 1 m/s², ±{half_db[-1]:.1f} dB between people")
