"""What an amplitude means."""

from skinsource.chain.actuation import Actuation
from skinsource.scaling.response_scaling import Scaling

_MEANINGS: dict[Scaling, str] = {
    "upstream": "The highest acceleration on any one axis that all clips together cause",
    "relative": "A factor: 1 is the measuring pulse",
    "probe": "Acceleration of the probe, within about 3 dB",
}


def amplitude_unit(scaling: Scaling, actuated: Actuation | None = None) -> str:
    """Unit of an input's amplitude: m/s², V at an actuator, or × for a plain factor."""
    if actuated is not None and actuated.equaliser is None:
        return "V"
    return "×" if scaling == "relative" else "m/s²"


def amplitude_meaning(scaling: Scaling, actuated: Actuation | None = None) -> str:
    """What an input's amplitude is, in words."""
    if actuated is None:
        return _MEANINGS[scaling]
    volts = actuated.equaliser is None
    return "Voltage at the actuator" if volts else "Acceleration of the contactor"
