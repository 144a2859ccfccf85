"""The settings of the Compare panel, which are saved with a design."""

from dataclasses import dataclass

from skinsource.design.comparing import MOST_SIDE_BY_SIDE, related_limbs
from skinsource.specs import fields
from skinsource.specs.numbers import ListSpec, NumberSpec
from skinsource.specs.spec import SwitchSpec, TextSpec
from skinsource_gui.qt.resources import choice_of

#: Shown in slow motion, and as what to expect of somebody else.
MOTION, RANGE = "motion", "range"
OF = choice_of("compared")
SHOWN = choice_of("shown_of_compared")
OWN_MAXIMUM = SwitchSpec(label="Own maximum", hint="Draw each map relative to its loudest output")
LIMBS = TextSpec(label="Limbs", longest=200, one_line=True)
FREQUENCIES = ListSpec(
    label="Frequencies beside its own",
    of=NumberSpec(label="Frequency", unit="Hz", minimum=1.0, maximum=1e5),
    most=MOST_SIDE_BY_SIDE - 1,
    hint="Frequencies beside that of the design",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class CompareSettings(fields.CheckedModel):
    """What is compared, and how.

    Attributes
    ----------
    of
        ``"snapshots"``, ``"limbs"``, ``"axes"``, ``"frequencies"`` or ``"windows"``.
    shown
        ``"levels"``, ``"difference"``, ``"mean"``, of limbs `RANGE`, or `MOTION`; of axes the first
        or last.
    own_maximum
        Whether the levels of each are drawn relative to its own loudest output.
    limbs
        Names of the chosen limbs with spaces between; empty: those that are related to the one of
        the design, see `skinsource.design.comparing.related_limbs`.
    frequencies_hz
        At which frequencies a design is shown beside its own one; equal ones count once.
    """

    of: str = fields.choice("snapshots", OF)
    shown: str = fields.choice("levels", SHOWN)
    own_maximum: bool = fields.switch(False, OWN_MAXIMUM)
    limbs: str = fields.text("", LIMBS)
    frequencies_hz: tuple[float, ...] = fields.field(FREQUENCIES, (50.0, 100.0, 200.0, 400.0))

    def chosen(self, limb: str) -> tuple[str, ...]:
        """Return the names of the limbs that are shown while a design is on ``limb``."""
        if not self.limbs.strip():
            return related_limbs(limb)
        return tuple(dict.fromkeys(self.limbs.split()))[:MOST_SIDE_BY_SIDE]
