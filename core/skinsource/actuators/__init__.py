"""Models of actuators: from a voltage to the motion of what touches the skin.

>>> from skinsource.actuators import VoiceCoil
>>> coil = VoiceCoil(8.0, 8e-4, 0.8, 1e-3, 0.07, 1200.0)
>>> motion = coil.simulate([1.0, 1.0, 1.0], 48000.0)
>>> motion.acceleration.shape
(3,)

To add a kind: write a file beside these, and name its class in `actuator_profile.KINDS`.
"""

from skinsource.actuators.actuator import Actuator
from skinsource.actuators.actuator_profile import KINDS, MODEL, ActuatorProfile, Model
from skinsource.actuators.fitting import fit, misfit_db
from skinsource.actuators.limits import Limits, Thermal
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.motion import ActuatorMotion
from skinsource.actuators.piezo import Piezo
from skinsource.actuators.prediction import Breach, Prediction, breaches, predicted
from skinsource.actuators.recoil_voice_coil import RecoilVoiceCoil
from skinsource.actuators.response_shape import ResponseShape
from skinsource.actuators.shelf import load, load_shape, names, profile, shape_names
from skinsource.actuators.voice_coil import VoiceCoil

__all__ = [
    "KINDS",
    "MODEL",
    "Actuator",
    "ActuatorMotion",
    "ActuatorProfile",
    "Breach",
    "Limits",
    "MeasuredResponse",
    "Model",
    "Piezo",
    "Prediction",
    "RecoilVoiceCoil",
    "ResponseShape",
    "Thermal",
    "VoiceCoil",
    "breaches",
    "fit",
    "load",
    "load_shape",
    "misfit_db",
    "names",
    "predicted",
    "profile",
    "shape_names",
]
