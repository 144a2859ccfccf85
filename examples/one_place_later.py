"""Two fingertips play the same, one of them a little later: what the skin between them does."""

import skinsource as ss

limb = ss.available_limbs()[0]  # measured-1 where the dataset is installed
train = ss.waveforms.WaveletTrain()  # five wavelets, one after the other
tap = ss.Clip(waveform=ss.waveforms.Tap(), onset_s=0.3, gain=0.5)
first = ss.Input(location=7, clips=(ss.Clip(waveform=train), tap))
design = ss.Design(limb=limb, inputs=(first, ss.track(10, train)))

for delay_ms in (0.0, 0.3, 1.0, 3.0, 10.0):
    # Clips are numbered through the design: the third one is that of the second track.
    later = design.with_clip(3, onset_s=delay_ms / 1000)
    levels_db = ss.evaluate(later, "output_levels_db")["output_levels_db"]
    print(f"{limb}, {delay_ms:4.1f} ms later: {levels_db[33 - 1]:6.2f} dB re 1 m/s² at output 33")
