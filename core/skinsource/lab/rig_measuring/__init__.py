"""Measuring a rig: sweeps on one output, and an accelerometer on an input of the sound card.

sounddevice is imported only when devices are listed or used.
"""

from skinsource.lab.rig_measuring.duplex import InputDevice, input_devices
from skinsource.lab.rig_measuring.loopback import Loopback, loopback
from skinsource.lab.rig_measuring.measurement import (
    ChannelMeasurement,
    MeasuringSetup,
    kept,
    measurable,
    measure,
)
from skinsource.lab.rig_measuring.wiring import WiringCheck, save_wiring_check, wiring_check

__all__ = [
    "ChannelMeasurement",
    "InputDevice",
    "Loopback",
    "MeasuringSetup",
    "WiringCheck",
    "input_devices",
    "kept",
    "loopback",
    "measurable",
    "measure",
    "save_wiring_check",
    "wiring_check",
]
