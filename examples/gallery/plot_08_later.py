"""
What happens if one fingertip plays later?
==========================================

Two fingertips play the same tone of 100 Hz, whose period is 10 ms. If one begins half a period
later, waves that met in phase now meet out of phase. The map shows the difference in dB.
"""

import numpy as np

import skinsource as ss

tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)
together = ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone), ss.track(8, tone)))
# Clips are numbered through the design: the second one is that of the second track.
later = together.with_clip(2, onset_s=0.005)
difference = ss.result(later) - ss.result(together)

most = int(np.abs(difference.values).argmax()) + 1
print(f"output {most} changes by {difference.values[most - 1]:.1f} dB")
figure = difference.plot_map(title="Half a period later", outputs=(most,))
