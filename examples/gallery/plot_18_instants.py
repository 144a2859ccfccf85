"""
How does the wave look at one instant?
======================================

``film`` writes the moving skin as a video. A single frame is the signed acceleration normal to the
skin at one instant, which diverging colours show: red moves out, blue moves in.
"""

import matplotlib.pyplot as plt

import skinsource as ss

tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)
design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone),))
view = ss.View(axes="z", outputs=tuple(range(1, 73)))
trace = ss.result(design, "selected_traces", view=view)
figure, places = plt.subplots(1, 4, figsize=(11, 5))
for later_ms, ax in zip((0.0, 2.5, 5.0, 7.5), places, strict=True):
    instant = abs(trace.axes["n_times"] - (0.15 + later_ms / 1e3)).argmin()
    frame = trace.values[:, instant]
    ss.plot.map(
        frame,
        limb="synthetic-1",
        colours="diverging",
        range_db=(-0.2, 0.2),
        title=f"{later_ms:.1f} ms",
        ax=ax,
    )
