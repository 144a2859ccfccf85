"""
What does an equaliser do for my actuator?
==========================================

A resonant actuator is strong at its resonance and weak elsewhere. The equaliser filters the drive,
so that the actuator follows it, as far as the boost allows.
"""

import matplotlib.pyplot as plt
import numpy as np

import skinsource as ss

model = ss.actuators.load("example-resonant")
frequency_hz = np.geomspace(20.0, 1000.0, 300)
inverse = ss.equalising.RegularisedInverse(boost_db=20.0)
curves = ss.equalising.curves(inverse, model, frequency_hz)

figure, ax = plt.subplots(figsize=(6.5, 3.8))
ax.semilogx(frequency_hz, curves.before_db, label="actuator alone")
ax.semilogx(frequency_hz, curves.filter_db, "--", label="equaliser")
ax.semilogx(frequency_hz, curves.after_db, label="actuator behind the equaliser")
ax.set(xlabel="frequency (Hz)", ylabel="dB", ylim=(-60, 40))
ax.legend()
resonance_hz, quality = ss.equalising.resonance_of(model)
print(f"resonance at {resonance_hz:.0f} Hz, quality {quality:.1f}")
