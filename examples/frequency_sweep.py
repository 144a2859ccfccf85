"""At which frequency does digit II move most?  One input of a design is changed step by step."""

import numpy as np

import skinsource as ss

limb = ss.available_limbs()[0]  # measured-1 where the dataset is installed
tap = ss.track(location=13, waveform=ss.waveforms.Tap(), amplitude=0.1)
tone = ss.track(location=7, waveform=ss.waveforms.Tone(frequency_hz=100.0))
# Equal drives: amplitudes are of the actuator, not of the skin.
design = ss.Design(limb=limb, inputs=(tap, tone), scaling="relative")

frequencies_hz = np.arange(50.0, 401.0, 50.0)
levels_db = []
for frequency_hz in frequencies_hz:
    # Only what follows from the changed input is computed again.
    step = design.with_clip(2, waveform=ss.waveforms.Tone(frequency_hz=float(frequency_hz)))
    values = ss.evaluate(step, "output_levels_db", view=ss.View(span="loudest"))
    levels_db.append(values["output_levels_db"][29 - 1])

for frequency_hz, level_db in zip(frequencies_hz, levels_db, strict=True):
    print(f"{limb}, output 29: {frequency_hz:3.0f} Hz {level_db:6.1f} dB re 1 m/s²")
best = ss.waveforms.Tone(frequency_hz=float(frequencies_hz[np.argmax(levels_db)]))
print(f"most at {best.frequency_hz:.0f} Hz")
