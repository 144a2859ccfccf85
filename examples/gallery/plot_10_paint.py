"""
Can two fingers be strong and the finger between them quiet?
============================================================

``paint`` takes outputs that are to be strong and outputs that are to be quiet. Here digits II and
IV are strong, and digit III between them is quiet.
"""

import skinsource as ss

strong, quiet = {28: 1.0, 11: 1.0}, {19: 1.0, 20: 1.0, 21: 1.0, 22: 1.0}
found = ss.inverse.paint("synthetic-1", strong, quiet, frequencies_hz=[100.0])
design = found.design(ss.waveforms.Tone(frequency_hz=100.0), level=0.3, band_hz=(90.0, 110.0))
levels = ss.result(design, view=ss.View(axes="z", span="loudest"))
figure = levels.plot_map(outputs=(*strong, *quiet))

for output in (*strong, *quiet):
    print(f"output {output}: {levels.values[output - 1]:.1f} dB re 1 m/s²")
