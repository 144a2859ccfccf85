"""The settings of the panel of linearity, which are saved with a design."""

from dataclasses import dataclass

from skinsource.specs import fields
from skinsource.specs.spec import SwitchSpec

VELOCITY = SwitchSpec(
    label="In mm/s",
    hint="Tell strengths as the largest velocity of the probe, in place of the amplitude",
)
BANDS = SwitchSpec(
    label="By band",
    hint="Draw and copy outputs in bands of 2 Hz, those at 50, 100, 200 and 400 Hz, in place of "
    "the RMS over all",
)
EVERY_OUTPUT = SwitchSpec(
    label="All outputs",
    hint="Draw adjusted R² of the worst of all outputs and their median, and copy that of each, in "
    "place of the selected ones",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class LinearitySettings:
    """How outputs are compared with the strengths of inputs.

    Attributes
    ----------
    velocity
        Whether strengths are velocities of the probe, where these are known.
    bands
        Whether outputs are those in bands.
    every_output
        Whether adjusted R² is shown for all outputs, not for the selected ones.
    """

    velocity: bool = fields.switch(False, VELOCITY)
    bands: bool = fields.switch(False, BANDS)
    every_output: bool = fields.switch(False, EVERY_OUTPUT)

    def __post_init__(self) -> None:
        fields.check(self)
