"""The settings of the Compare panel, which are saved with a design."""

from dataclasses import dataclass

from skinsource.design.comparing import MOST_SIDE_BY_SIDE, related_limbs
from skinsource.specs import fields
from skinsource.specs.spec import ChoiceSpec, SwitchSpec, TextSpec

OF = ChoiceSpec(
    label="Of",
    options=(("snapshots", "Snapshots"), ("limbs", "Limbs"), ("axes", "Axes")),
    hint="Snapshots of this design, and designs of files; the present design on several limbs; or "
    "the present design along each axis of the sensors",
)
SHOWN = ChoiceSpec(
    label="Shown",
    options=(
        ("levels", "Levels"),
        ("difference", "Difference"),
        ("mean", "Mean, spread"),
    ),
    hint="The levels of each, in the same colours; how much louder each of the others is than the "
    "one in the window; or the mean of all and their standard deviation",
)
OWN_MAXIMUM = SwitchSpec(
    label="Each to its maximum",
    hint="Draw the levels of each map relative to its own loudest output: how far each reaches is "
    "seen where the others are louder",
)
LIMBS = TextSpec(label="Limbs", longest=200, one_line=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class CompareSettings:
    """What is compared, and how.

    Attributes
    ----------
    of
        ``"snapshots"``, ``"limbs"`` or ``"axes"``.
    shown
        ``"levels"``, ``"difference"`` or ``"mean"``; of axes always the levels.
    own_maximum
        Whether the levels of each are drawn relative to its own loudest output.
    limbs
        Names of the chosen limbs with spaces between; empty: those that are related to the one of
        the design, see `skinsource.design.comparing.related_limbs`.
    """

    of: str = fields.choice("snapshots", OF)
    shown: str = fields.choice("levels", SHOWN)
    own_maximum: bool = fields.switch(False, OWN_MAXIMUM)
    limbs: str = fields.text("", LIMBS)

    def __post_init__(self) -> None:
        fields.check(self)

    def chosen(self, limb: str) -> tuple[str, ...]:
        """Return the names of the limbs that are shown while a design is on ``limb``."""
        if not self.limbs.strip():
            return related_limbs(limb)
        return tuple(dict.fromkeys(self.limbs.split()))[:MOST_SIDE_BY_SIDE]
