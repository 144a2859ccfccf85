"""Calibrating a person: sweeps of all actuators, and a sensor at one place of the skin."""

from skinsource.lab.calibrating.calibration import Calibration, Measured, Sitting, calibrate
from skinsource.lab.calibrating.stand_in import StandIn
from skinsource.lab.calibrating.station import CardStation, Station

__all__ = [
    "Calibration",
    "CardStation",
    "Measured",
    "Sitting",
    "StandIn",
    "Station",
    "calibrate",
]
