"""What a design asks of an actuator that is looked at: its volts, current, motion and warmth."""

from skinsource.actuator_demand.demand import LONGEST_S, Demand, demand_of, drive_at, strongest
from skinsource.actuator_demand.settings import MEASURED, ActuatorSettings, actuator_spec
from skinsource.actuator_demand.settings_of_actuation import actuation_of, settings_through

__all__ = [
    "LONGEST_S",
    "MEASURED",
    "ActuatorSettings",
    "Demand",
    "actuation_of",
    "actuator_spec",
    "demand_of",
    "drive_at",
    "settings_through",
    "strongest",
]
