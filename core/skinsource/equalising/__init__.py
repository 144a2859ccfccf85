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
from skinsource.equalising.curves import EqualiserCurves, curves
from skinsource.equalising.equaliser import Equaliser
from skinsource.equalising.net_velocity import NetVelocity, net_velocity
from skinsource.equalising.pole_pair import PolePairReplacement, resonance_of
from skinsource.equalising.regularised_inverse import RegularisedInverse

#: Every kind, in the order in which a user meets them.
EQUALISERS: tuple[type[Equaliser], ...] = (RegularisedInverse, PolePairReplacement)

__all__ = [
    "EQUALISERS",
    "Equaliser",
    "EqualiserCurves",
    "NetVelocity",
    "PolePairReplacement",
    "RegularisedInverse",
    "curves",
    "equalised",
    "net_velocity",
    "resonance_of",
]
