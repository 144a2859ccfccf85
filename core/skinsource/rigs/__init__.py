"""The rig: what is wired to what, how strong it is, and what it may not be driven beyond.

A file of its own beside designs, made by hand or from measurements.  Limits stand in it, and in
nothing that a design holds: no design can loosen them.
"""

from skinsource.rigs.channel import RigChannel
from skinsource.rigs.checking import RigBreach, rig_breaches, strictest
from skinsource.rigs.margins import Margin, highest_gain
from skinsource.rigs.rig import Rig
from skinsource.rigs.rig_file import SUFFIX, open_rig, save_rig
from skinsource.rigs.sending import calibration_words, samples_for, volts_of

__all__ = [
    "SUFFIX",
    "Margin",
    "Rig",
    "RigBreach",
    "RigChannel",
    "calibration_words",
    "highest_gain",
    "open_rig",
    "rig_breaches",
    "samples_for",
    "save_rig",
    "strictest",
    "volts_of",
]
