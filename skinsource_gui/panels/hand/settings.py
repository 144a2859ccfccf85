"""The settings of the hand panel."""

from dataclasses import dataclass

from skinsource.specs import fields
from skinsource.specs.spec import SwitchSpec

#: Name of the panel, under which a view keeps its settings.
HAND = "hand"


@dataclass(frozen=True, slots=True, kw_only=True)
class HandSettings(fields.CheckedModel):
    """How the hand is seen.

    Attributes
    ----------
    mirrored
        Whether the palm is seen through the hand, so that it lines up with the back on the map.
    """

    mirrored: bool = fields.switch(
        False, SwitchSpec(label="Mirror", hint="Palm seen through the hand, as on the map")
    )
