"""A 100 Hz tone on the pad of digit II: levels on the skin, as numbers and as a picture."""

import skinsource as ss

limb = ss.load_limb(ss.available_limbs()[0])  # measured-1 where the dataset is installed
acceleration = ss.predict(limb, [ss.sinusoid(100.0, duration_s=0.2)], locations=[7])
projected = ss.project_axes(acceleration, axes="xyz", method="mag")  # (72 outputs, n_times), m/s²
levels_db = ss.decibels(ss.rms(projected))
heatmap_db = ss.surface_operator(limb).interpolate(levels_db)  # (rows, columns), 1 mm, NaN outside
# A picture needs the extra "plot".
ss.plot.map(levels_db, limb=limb, outputs=(29, 52)).savefig("first_map.png")

print(f"{limb}: loudest output {levels_db.argmax() + 1} with {levels_db.max():.1f} dB re 1 m/s²")
print(f"map of {heatmap_db.shape[0]} x {heatmap_db.shape[1]} mm")
for output in (29, 52):
    print(f"output {output}: peak {projected[output - 1].max():.4f} m/s²")
