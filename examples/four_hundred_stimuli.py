"""Four hundred stimuli: frequencies, places and amplitudes, in blocks of trials for two people."""

import numpy as np

import skinsource as ss

design = ss.Design(limb=ss.available_limbs()[0], inputs=(ss.track(7),))
vary = {
    "location": range(1, 21),
    "amplitude": [0.5, 2.0],
    "frequency_hz": np.geomspace(50.0, 400.0, 10).round(1),
}
order = ss.sweeps.Order(kind="random", participants=2, seed=1)
table = ss.sweep(design, vary, out="four_hundred_stimuli", order=order)
farthest = np.argmax(table.column("mean_distance_mm"))
print(f"{design.limb}: of {len(table)} stimuli, {table.rows[farthest][:4]} reaches farthest")
