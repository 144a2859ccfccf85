"""
Where should I mount three actuators?
=====================================

``place`` tries which three places serve best when any of four fingertip outputs is to be strong.
The loss says how far a layout is behind all places together.
"""

import matplotlib.pyplot as plt

import skinsource as ss

found = ss.inverse.place("synthetic-1", targets=[28, 20, 11, 2], count=3)
best = found.ranked[:8]
figure, ax = plt.subplots(figsize=(6, 3.2), layout="constrained")
names = [", ".join(str(place) for place in layout.inputs) for layout in best]
ax.barh(names[::-1], [layout.loss_db for layout in best][::-1])
ax.set(xlabel="loss against all places (dB)", ylabel="places")

first = best[0]
print("best:", ", ".join(ss.locations.input_name(place).name for place in first.inputs))
there = ss.inverse.layout("synthetic-2", [28, 20, 11, 2], first.inputs)
print(f"loss {first.loss_db:.1f} dB; on another hand {there.loss_db:.1f} dB")
