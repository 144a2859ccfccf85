"""What the panel of the actuator keeps in a design."""

import skinsource as ss
from skinsource.engine.actuator_demand import ActuatorSettings


def test_settings_of_another_studio_do_no_harm():
    odd = ActuatorSettings(actuator="no such", parameters=(("no_field", 1.0),))
    assert odd.model == ss.actuators.load("example-voice-coil")
    worse = ActuatorSettings(parameters=(("resistance_ohm", -1.0),))
    assert worse.model.resistance_ohm == 4.0
    assert ActuatorSettings(parameters=("x",)).model is not None
