"""Rules from drives to what they ask of the actuator that is looked at."""

from dataclasses import replace

from skinsource.actuator_demand import (
    ActuatorSettings,
    Demand,
    actuation_of,
    demand_of,
    settings_through,
)
from skinsource.chain import Actuation
from skinsource.limb import Band
from skinsource.rendering.placed import Placed


def actuator_looked_at(
    actuator_settings: ActuatorSettings, actuation: Actuation | None
) -> ActuatorSettings:
    """Actuator and equaliser, and what an amplitude of 1 is; not how they are drawn."""
    found = settings_through(actuator_settings, actuation)
    if actuation is not None and actuation == actuation_of(found):
        # Amplitudes are what the contactor, or the coil, gets.
        found = replace(found, strength_m_per_s2=1.0, volts=1.0)
    usual = ActuatorSettings()
    return replace(found, picture=usual.picture, layout=usual.layout, zoom=None)


def actuator_demand(
    sampled_voices: tuple[Placed, ...],
    selected_input: int | None,
    sample_rate_hz: float,
    band_hz: Band | None,
    actuator_looked_at: ActuatorSettings,
) -> Demand:
    """What the place of the selected input asks of the actuator."""
    return demand_of(actuator_looked_at, sampled_voices, selected_input, sample_rate_hz, band_hz)


RULES = (actuator_looked_at, actuator_demand)
