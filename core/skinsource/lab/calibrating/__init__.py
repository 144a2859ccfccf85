"""Calibrating a person: sweeps of all actuators, and a sensor at one place of the skin."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
