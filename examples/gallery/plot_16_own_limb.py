"""
How do I use responses that I measured myself?
==============================================

A limb is an array of impulse responses and the places of inputs and outputs. Here two inputs and
seven outputs on a line are made up; yours come from your files. ``skinsource limb import`` on the
command line, and File > Own limbs… in the window, import the same file.
"""

import h5py
import numpy as np

import skinsource as ss
from skinsource.__main__ import main

time_s = np.arange(400) / 4000.0
inputs, outputs = (
    np.array([[0.0, 90.0], [0.0, 40.0]]),
    np.array([[0.0, 15.0 * k] for k in range(7)]),
)
distance_mm = np.abs(inputs[:, None, 1] - outputs[None, :, 1])
# Waves that come 1 ms later for each 8 mm, and fade.
later_s = time_s - 0.01 - distance_mm[..., None] / 8000.0
responses = np.exp(-distance_mm / 40.0)[..., None] * np.exp(-((later_s / 0.001) ** 2))
corners = np.array([[-15.0, -20.0], [15.0, -20.0], [12.0, 110.0], [-12.0, 110.0]])

with h5py.File("finger.h5", "w") as file:
    file.attrs.update(format="skinsource limb", format_version=1, name="finger", axes="z")
    file.attrs.update(sample_rate_hz=4000.0, hand_length_mm=180.0)
    file["responses"] = responses[:, :, None, :]  # inputs, outputs, axes, taps
    file["map/outline"], file["map/inputs"], file["map/outputs"] = corners, inputs, outputs

main(["limb", "import", "finger.h5", "--replace"])
tone = ss.waveforms.Tone(frequency_hz=200.0, duration_s=0.05)
design = ss.Design(limb="finger", scaling="relative", inputs=(ss.track(1, tone),))
figure = ss.result(design, view=ss.View(axes="z", outputs=(1, 2))).plot_map(outputs=range(1, 8))
