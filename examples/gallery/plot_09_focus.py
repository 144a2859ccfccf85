"""
Which drives make one spot strong and the rest quiet?
=====================================================

A focus makes output 30, on the back of digit II, strong with 15 inputs. The second map is the best
that one input alone can do. Both have the same level at output 30.
"""

import matplotlib.pyplot as plt

import skinsource as ss

tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)
found = {
    "focus": ss.inverse.focus("synthetic-1", target=30),
    "best single input": ss.inverse.best_single("synthetic-1", target=30),
}
figure, places = plt.subplots(1, 2, figsize=(7, 5))
for (name, drives), ax in zip(found.items(), places, strict=True):
    design = drives.design(tone, level=0.3)
    view = ss.View(axes="z", span="loudest")
    ss.plot.map(design, view=view, range_db=(-50.0, -5.0), outputs=(30,), title=name, ax=ax)
    at_100_hz = abs(drives.frequencies_hz - 100.0).argmin()
    print(f"{name}: target {drives.mean_contrast_db[at_100_hz]:.1f} dB over the mean of the others")
