"""Models of actuators: from a voltage to the motion of what touches the skin.

>>> from skinsource.actuators import VoiceCoil
>>> coil = VoiceCoil(8.0, 8e-4, 0.8, 1e-3, 0.07, 1200.0)
>>> motion = coil.simulate([1.0, 1.0, 1.0], 48000.0)
>>> motion.acceleration.shape
(3,)
"""

from skinsource.actuators.actuator import Actuator
from skinsource.actuators.motion import ActuatorMotion
from skinsource.actuators.piezo import Piezo
from skinsource.actuators.recoil_voice_coil import RecoilVoiceCoil
from skinsource.actuators.voice_coil import VoiceCoil

#: Every kind, in the order in which a user meets them.
KINDS: tuple[type[Actuator], ...] = (VoiceCoil, RecoilVoiceCoil, Piezo)

__all__ = ["KINDS", "Actuator", "ActuatorMotion", "Piezo", "RecoilVoiceCoil", "VoiceCoil"]
