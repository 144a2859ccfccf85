"""Rules from traces and responses to what panels of analysis show, and what they depend on."""

from typing import Any

from skinsource.actuator_demand import ActuatorSettings
from skinsource.analysis.settings import SpectrogramSettings
from skinsource.analysis_rules import (
    actuator_rules,
    axis_rules,
    noise_rules,
    output_rules,
    perception_rules,
    validity_rules,
    wave_rules,
    window_noise_rules,
)
from skinsource.panel_settings import settings_of
from skinsource.perception.settings import PerceptionSettings
from skinsource.view import View

_MODULES = (
    noise_rules,
    window_noise_rules,
    output_rules,
    axis_rules,
    wave_rules,
    validity_rules,
    perception_rules,
    actuator_rules,
)
RULES = tuple(rule for module in _MODULES for rule in module.RULES)


def choices_of(view: View) -> dict[str, Any]:
    """What of a view only these rules start from, by name."""
    return {
        "spectrogram_settings": settings_of(view, "spectrogram", SpectrogramSettings),
        "actuator_settings": settings_of(view, "actuator", ActuatorSettings),
        "perception_settings": settings_of(view, "perception", PerceptionSettings),
    }
