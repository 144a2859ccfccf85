"""A rig is measured: a sweep on one output, and an accelerometer on an input of the sound card.

Nothing of sounddevice is imported before somebody measures.
"""

from skinsource.rig_measuring.bench import measurable
from skinsource.rig_measuring.channel_measurement import ChannelMeasurement, kept
from skinsource.rig_measuring.inputs import InputDevice, input_devices
from skinsource.rig_measuring.one_channel import measure
from skinsource.rig_measuring.setup import MeasuringSetup

__all__ = [
    "ChannelMeasurement",
    "InputDevice",
    "MeasuringSetup",
    "input_devices",
    "kept",
    "measurable",
    "measure",
]
