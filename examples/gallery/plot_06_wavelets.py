"""
How do I give wavelets of different frequencies the same energy?
================================================================

A wavelet train plays wavelets of rising frequency, one after another. Balanced by *none*,
all have the same peak, so low ones carry more energy. Balanced by *energy*, all carry the same.
"""

import matplotlib.pyplot as plt
import numpy as np

import skinsource as ss

figure, rows = plt.subplots(2, 1, figsize=(7, 4), sharex=True, layout="constrained")
for equalise, ax in zip(("none", "energy"), rows, strict=True):
    train = ss.waveforms.WaveletTrain(equalise=equalise)
    samples = train.samples(8000)
    ax.plot(np.arange(samples.size) / 8000, samples)
    ax.set(title=f"balance by {equalise}", ylabel="drive")
rows[1].set_xlabel("time (s)")
print("frequencies in Hz:", *train.frequencies_hz)
