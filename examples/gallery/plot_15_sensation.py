"""
Will people feel it?
====================

The threshold of the skin, left, depends on frequency. The sensation level, right, says how far a
vibration is above the threshold of the skin where it arrives, in dB: below 0 it is not felt.
"""

import matplotlib.pyplot as plt
import numpy as np

import skinsource as ss

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 5), layout="constrained")
frequency_hz = np.geomspace(25.0, 600.0, 200)
left.loglog(frequency_hz, ss.perception.threshold_rms(frequency_hz))
left.set(xlabel="frequency (Hz)", ylabel="threshold on the palm (m/s² RMS)")

tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.3)
design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone, amplitude=10.0),))
felt_db = ss.result(design, "sensation_db").values
ss.plot.map(felt_db, limb="synthetic-1", range_db=(0.0, 40.0), title="100 Hz, 10 m/s²", ax=right)
print(f"{(felt_db > 0).sum()} of {felt_db.size} outputs are above threshold")
