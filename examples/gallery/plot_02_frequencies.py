"""
Which frequencies travel farther?
=================================

The same tone plays four times on the pad of digit II, at 50, 100, 200 and 400 Hz. All maps have one
scale. The number is the distance within which 90 % of the energy stays: low frequencies travel.
"""

import matplotlib.pyplot as plt

import skinsource as ss

figure, places = plt.subplots(1, 4, figsize=(11, 5))
for frequency_hz, ax in zip((50.0, 100.0, 200.0, 400.0), places, strict=True):
    tone = ss.waveforms.Tone(frequency_hz=frequency_hz, duration_s=0.2)
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone),))
    ss.plot.map(design, range_db=(-50.0, 0.0), title=f"{frequency_hz:.0f} Hz", ax=ax)
    reach = ss.extent(ss.result(design, "output_rms").values, "synthetic-1", 7)
    print(f"{frequency_hz:3.0f} Hz: 90 % within {reach.d90_mm:.0f} mm")
