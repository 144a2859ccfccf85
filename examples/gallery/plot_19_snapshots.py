"""
Which of my two versions is stronger where?
===========================================

Two versions of a stimulus are compared as differences: a tone on one fingertip, and the same tone
with a second actuator at the base of the finger. One more actuator does not make all of the hand
louder: where waves of both meet out of phase, they cancel.
"""

import matplotlib.pyplot as plt

import skinsource as ss

tone = ss.waveforms.Tone(frequency_hz=150.0, duration_s=0.2)
one = ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone),))
two = ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone), ss.track(12, tone, amplitude=0.5)))
before, after = ss.result(one), ss.result(two)

figure, places = plt.subplots(1, 3, figsize=(9, 5))
for title, shown, ax in zip(
    ("one", "two", "two - one, dB"), (before, after, after - before), places, strict=True
):
    shown.plot_map(title=title, ax=ax)
change_db = (after - before).values
print(
    f"from {change_db.min():.1f} to {change_db.max():.1f} dB; {(change_db < 0).sum()} outputs fall"
)
