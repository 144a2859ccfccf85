"""
How far do many stimuli reach?
==============================

A sweep predicts metrics for all combinations of frequency and place, on all cores. Its table has a
row for each stimulus.
"""

import matplotlib.pyplot as plt
import numpy as np

import skinsource as ss

design = ss.Design(limb="synthetic-1", inputs=(ss.track(7),))
places, frequencies_hz = (7, 13, 18), (50.0, 100.0, 200.0, 400.0)
table = ss.sweep(design, {"location": places, "frequency_hz": frequencies_hz}, processes=1)

reach_mm = np.reshape(table.column("d90_mm"), (len(places), -1))
figure, ax = plt.subplots(figsize=(6, 3.5))
for place, reach in zip(places, reach_mm, strict=True):
    ax.semilogx(frequencies_hz, reach, marker="o", label=ss.locations.input_name(place).name)
ax.set(xlabel="frequency (Hz)", ylabel="90 % of the energy within (mm)", xticks=frequencies_hz)
ax.legend()
for place, reach in zip(places, reach_mm, strict=True):
    print(f"place {place}:", ", ".join(f"{each:.0f} mm" for each in reach))
