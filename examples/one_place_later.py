"""Two fingertips play the same tone, one of them later: it cancels, and adds up again."""

import numpy as np

import skinsource as ss

limb = ss.available_limbs()[0]  # measured-1 where the dataset is installed
tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)  # a period is 10 ms
design = ss.Design(limb=limb, inputs=[ss.track(7, tone), ss.track(8, tone)])

delays_ms = (0.0, 2.5, 5.0, 7.5, 10.0)
# Clips are numbered through the design: the second one is that of the second track.
results = [ss.result(design.with_clip(2, onset_s=delay_ms / 1000)) for delay_ms in delays_ms]

most = np.ptp([result.values for result in results], axis=0).argmax()
output = results[0].axes["n_outputs"][most]
for delay_ms, result in zip(delays_ms, results, strict=True):
    level_db = result.values[most]
    print(f"{limb}, {delay_ms:4.1f} ms later: {level_db:6.1f} dB re 1 m/s² at output {output}")

# A picture needs the extra "plot".
difference = results[2] - results[0]
difference.plot_map(title="Half a period later", outputs=[output]).savefig("half_a_period.png")
