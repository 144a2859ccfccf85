"""Models of actuators: from a voltage to the motion of what touches the skin.

>>> from skinsource.actuators import VoiceCoil
>>> coil = VoiceCoil(8.0, 8e-4, 0.8, 1e-3, 0.07, 1200.0)
>>> motion = coil.simulate([1.0, 1.0, 1.0], 48000.0)
>>> motion.acceleration.shape
(3,)

To add a kind: write its class in `models`, and name it in `catalog.KINDS`.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
