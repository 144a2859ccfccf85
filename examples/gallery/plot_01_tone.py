"""
Where does a tone go?
=====================

A tone of 100 Hz plays on the pad of digit II. The map shows the level of each output, in dB re
1 m/s², and what lies between the outputs is interpolated.
"""

import skinsource as ss

tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)
design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone),))
levels = ss.result(design)

loudest = levels.values.argmax()
print(f"loudest: output {loudest + 1}, {levels.values[loudest]:.1f} dB re 1 m/s²")
figure = levels.plot_map(outputs=(loudest + 1, 52))
