"""What only the traces look at."""

from dataclasses import dataclass

from skinsource.specs import fields
from skinsource.specs.fields import ChoiceSpec, SwitchSpec

LAYOUT = ChoiceSpec(
    label="Layout",
    options=(("overlaid", "Overlaid"), ("stacked", "Stacked")),
    hint="All curves over each other, or each in its own row",
)
RELATIVE = SwitchSpec(
    label="Each to its peak",
    hint="Draw each curve relative to its own peak: shapes are seen where all others would be flat",
)

FITTED = SwitchSpec(
    label="Fit to what is seen",
    hint="Zoomed in, the range of values is that of the part in sight, not of the whole: what is "
    "weak there is no flat line",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class TracesSettings:
    """How traces are drawn.

    Attributes
    ----------
    layout
        ``"overlaid"`` or ``"stacked"``.
    relative
        Whether each is drawn relative to its own peak.
    fitted
        Whether values fit the part of time that is seen.
    """

    layout: str = fields.choice("overlaid", LAYOUT)
    relative: bool = fields.switch(False, RELATIVE)
    fitted: bool = fields.switch(False, FITTED)

    def __post_init__(self) -> None:
        fields.check(self)
