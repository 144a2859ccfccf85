"""What the parameters of actuators may be."""

from skinsource.fields import SMALLEST, NumberSpec


def positive(label: str, unit: str, hint: str = "") -> NumberSpec:
    """A parameter above 0."""
    return NumberSpec(
        label=label, unit=unit, minimum=SMALLEST, step=0.02, logarithmic=True, hint=hint
    )


def not_negative(label: str, unit: str, hint: str = "") -> NumberSpec:
    """A parameter of 0 or more."""
    return NumberSpec(label=label, unit=unit, minimum=0.0, step=0.02, logarithmic=True, hint=hint)


RESISTANCE = positive("Resistance", "Ω", "Of the coil")
INDUCTANCE = positive("Inductance", "H", "Of the coil")
FORCE_FACTOR = not_negative("Force factor", "N/A", "Force for each ampere, and volts for each m/s")
MOVING_MASS = positive("Moving mass", "kg")
DAMPING = not_negative("Damping", "N s/m", "Of the suspension")
STIFFNESS = not_negative("Stiffness", "N/m", "Of the suspension")
SKIN_STIFFNESS = not_negative("Skin stiffness", "N/m", "Of the skin at the contact; 0 in air")
SKIN_DAMPING = not_negative("Skin damping", "N s/m", "Of the skin at the contact; 0 in air")
