"""An actuator of each kind, with parameters of ordinary ones."""

import skinsource as ss

COIL = ss.actuators.VoiceCoil(8.0, 8e-4, 0.8, 1e-3, 0.07, 1209.0)
RECOIL = ss.actuators.RecoilVoiceCoil(4.0, 5e-4, 1.5, 4e-3, 0.5, 1280.0, 1.1e-2, 700.0, 1.0)
PIEZO = ss.actuators.Piezo(1e-7, 1e-2, 1e-3, 0.1, 2000.0)
