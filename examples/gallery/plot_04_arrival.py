"""
When does a tap arrive along a digit?
=====================================

A tap on the fingertip runs down digit II and over the back of the hand to the wrist. Each trace is
drawn relative to its own peak, from near to far: the farther, the later and the longer.
"""

from dataclasses import replace

import skinsource as ss

tap = ss.track(7, ss.waveforms.Tap())
design = ss.Design(limb="synthetic-1", inputs=(tap,))
view = ss.View(axes="z", delay_removed=True, time_range_s=(0.0, 0.06))
along = (28, 30, 33, 35, 36)
figure = ss.plot.traces(design, view=view, outputs=along, normalised=True)

traces = ss.result(design, "selected_traces", view=replace(view, outputs=along))
size = abs(traces.values)
begins = (size > 0.1 * size.max(axis=1, keepdims=True)).argmax(axis=1)
for output, begin_s in zip(along, traces.axes["n_times"][begins], strict=True):
    print(f"output {output}: reaches a tenth of its peak at {1e3 * begin_s:.1f} ms")
