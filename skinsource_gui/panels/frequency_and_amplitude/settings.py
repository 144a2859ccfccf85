"""The settings of the panel of frequency and amplitude, which are saved with a design."""

from dataclasses import dataclass

from skinsource.specs import fields
from skinsource.specs.spec import ChoiceSpec

ALL, FREQUENCY, AMPLITUDE, ONSET = "all", "frequency", "amplitude", "onset"
CONTROL = ChoiceSpec(
    label="Turn",
    options=(
        (ALL, "All"),
        (FREQUENCY, "Frequency"),
        (AMPLITUDE, "Amplitude"),
        (ONSET, "Onset"),
    ),
    hint="What this scene is about: the one number that is shown and turned; saved with the design",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ControlSettings:
    """Which number is changed in front of an audience.

    Attributes
    ----------
    control
        `ALL`, or the one number that is shown.
    """

    control: str = fields.choice(ALL, CONTROL)

    def __post_init__(self) -> None:
        fields.check(self)
