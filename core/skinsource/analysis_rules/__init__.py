"""Rules from traces and responses to what panels of analysis show, and what they depend on."""

from typing import Any

from skinsource.actuator_demand import ActuatorSettings
from skinsource.analysis.settings import SpectrogramSettings
from skinsource.analysis_rules.actuator_rules import RULES as ACTUATOR_RULES
from skinsource.analysis_rules.axis_rules import RULES as AXIS_RULES
from skinsource.analysis_rules.noise_rules import RULES as NOISE_RULES
from skinsource.analysis_rules.output_rules import RULES as OUTPUT_RULES
from skinsource.analysis_rules.perception_rules import RULES as PERCEPTION_RULES
from skinsource.analysis_rules.validity_rules import RULES as VALIDITY_RULES
from skinsource.analysis_rules.wave_rules import RULES as WAVE_RULES
from skinsource.analysis_rules.window_noise_rules import RULES as WINDOW_NOISE_RULES
from skinsource.panel_settings import settings_of
from skinsource.perception.settings import PerceptionSettings
from skinsource.view import View

RULES = (
    *NOISE_RULES,
    *WINDOW_NOISE_RULES,
    *OUTPUT_RULES,
    *AXIS_RULES,
    *WAVE_RULES,
    *VALIDITY_RULES,
    *PERCEPTION_RULES,
    *ACTUATOR_RULES,
)


def choices_of(view: View) -> dict[str, Any]:
    """What of a view only these rules start from, by name."""
    return {
        "spectrogram_settings": settings_of(view, "spectrogram", SpectrogramSettings),
        "actuator_settings": settings_of(view, "actuator", ActuatorSettings),
        "perception_settings": settings_of(view, "perception", PerceptionSettings),
    }
