"""Drives that make an actuator move as a design says: inverse filters, bounded and checked.

A drive in m/s² becomes a voltage that makes the contactor accelerate so, within a band and as far
as a limited boost reaches.

>>> from skinsource import actuators, equalising
>>> coil = actuators.load("example-voice-coil")
>>> curves = equalising.curves(equalising.RegularisedInverse(), coil, [100.0, 200.0])
>>> bool(abs(curves.after_db).max() < 0.1)
True
"""

from skinsource.equalising.applying import equalised
from skinsource.equalising.band import followed_band
from skinsource.equalising.equaliser import Equaliser
from skinsource.equalising.every_kind import EQUALISERS
from skinsource.equalising.pole_pair import PolePairReplacement, resonance_of
from skinsource.equalising.regularised_inverse import RegularisedInverse
from skinsource.equalising.response_curves import EqualiserCurves, curves
from skinsource.equalising.velocity_of_drive import NetVelocity, net_velocity

__all__ = [
    "EQUALISERS",
    "Equaliser",
    "EqualiserCurves",
    "NetVelocity",
    "PolePairReplacement",
    "RegularisedInverse",
    "curves",
    "equalised",
    "followed_band",
    "net_velocity",
    "resonance_of",
]
